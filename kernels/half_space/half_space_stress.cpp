#include "kernels/half_space/half_space_stress.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace tread::half_space {

namespace {

void add(double factor, const Stress& from, Stress& to) {
  to.xx += factor * from.xx;
  to.yy += factor * from.yy;
  to.zz += factor * from.zz;
  to.xy += factor * from.xy;
  to.yz += factor * from.yz;
  to.xz += factor * from.xz;
}

/// Double integrals over X and Y of derivatives of V = 1/R and phi = ln(R + z), R the distance of the points
/// (X, Y, z) and 0. Names give the derivatives. Terms of X or of Y alone, which cancel over a rectangle, are
/// left out.
struct Corner {
  double x, y, z, r;
  double v_x, v_y, v_z, v_xx, v_yy, v_xz, v_yz, v_xy;
  double phi_xx, phi_yy, phi_xy, phi_xyy, phi_xxy;

  Corner(double X, double Y, double depth) : x(X), y(Y), z(depth), r(std::sqrt(X * X + Y * Y + z * z)) {
    const double xz2 = x * x + z * z;
    const double yz2 = y * y + z * z;
    v_x = std::asinh(y / std::sqrt(xz2));
    v_y = std::asinh(x / std::sqrt(yz2));
    v_z = -std::atan2(x * y, z * r);
    v_xx = -x * y / (r * xz2);
    v_yy = -x * y / (r * yz2);
    v_xz = -z * y / (r * xz2);
    v_yz = -z * x / (r * yz2);
    v_xy = 1 / r;
    phi_xx = std::atan2(x * y * (r - z), x * x * r + z * y * y);
    phi_yy = std::atan2(x * y * (r - z), y * y * r + z * x * x);
    phi_xy = std::log(r + z);
    phi_xyy = y / (r * (r + z));
    phi_xxy = x / (r * (r + z));
  }

  /// Stress under unit pressure, times 2 pi.
  Stress pressure(double nu) const {
    const double k = 1 - 2 * nu;
    return {2 * nu * v_z - k * phi_xx - z * v_xx,
            2 * nu * v_z - k * phi_yy - z * v_yy,
            v_z + z * (v_xx + v_yy),
            -k * phi_xy - z * v_xy,
            -z * v_yz,
            -z * v_xz};
  }

  /// Stress under unit traction along x, times 2 pi.
  Stress along_x(double nu) const {
    return {2 * v_x + 2 * nu * y / (r + z) + z * (v_xz + phi_xyy),
            2 * nu * (v_x - y / (r + z)) - z * phi_xyy,
            -z * v_xz,
            v_y - 2 * nu * x / (r + z) - z * phi_xxy,
            -z * v_xy,
            v_z - z * v_xx};
  }

  /// Stress under unit traction along y, times 2 pi.
  Stress along_y(double nu) const {
    return {2 * nu * (v_y - x / (r + z)) - z * phi_xxy,
            2 * v_y + 2 * nu * x / (r + z) + z * (v_yz + phi_xxy),
            -z * v_yz,
            v_x - 2 * nu * y / (r + z) - z * phi_xyy,
            v_z - z * v_yy,
            -z * v_xy};
  }
};

/// Value of a cell field, zero beyond the grid.
double value(const Grid& grid, const std::vector<double>& field, int i, int j) {
  return i < 0 || j < 0 || i >= grid.nx || j >= grid.ny ? 0 : field[grid.index(i, j)];
}

/// Second difference of a cell field at the corner before cell (i, j): the weight of that corner.
double jump(const Grid& grid, const std::vector<double>& field, int i, int j) {
  return value(grid, field, i, j) - value(grid, field, i - 1, j) - value(grid, field, i, j - 1) +
         value(grid, field, i - 1, j - 1);
}

struct Sample {
  double at, weight;
};

/// Gauss points, 4 for each piece of about the size `piece` [m]; the weights add up to 1.
std::vector<Sample> samples(double from, double length, double piece) {
  constexpr std::array<double, 2> point = {0.3399810435848563, 0.8611363115940526};
  constexpr std::array<double, 2> weight = {0.6521451548625461, 0.3478548451374538};
  const int pieces = std::max(1, static_cast<int>(std::lround(length / piece)));
  const double half = 0.5 * length / pieces;
  std::vector<Sample> all;
  for (int k = 0; k < pieces; ++k)
    for (int g = 0; g < 2; ++g)
      for (const double sign : {-1.0, 1.0})
        all.push_back({from + (2 * k + 1 + sign * point[g]) * half, 0.5 * weight[g] / pieces});
  return all;
}

}  // namespace

double von_mises(const Stress& s) {
  const double xy = s.xx - s.yy;
  const double yz = s.yy - s.zz;
  const double zx = s.zz - s.xx;
  return std::sqrt(0.5 * (xy * xy + yz * yz + zx * zx) + 3 * (s.xy * s.xy + s.yz * s.yz + s.xz * s.xz));
}

Stress rail_stress(const SurfaceLoad& load, double x, double y, double z) {
  const Grid& grid = load.grid;
  const double nu = load.poissons_ratio;
  Stress sum;
  for (int j = 0; j <= grid.ny; ++j)
    for (int i = 0; i <= grid.nx; ++i) {
      const double p = jump(grid, load.pressure, i, j);
      const double qx = -jump(grid, load.on_wheel.x, i, j);
      const double qy = -jump(grid, load.on_wheel.y, i, j);
      if (p == 0 && qx == 0 && qy == 0) continue;
      const Corner corner(x - grid.x(i) + 0.5 * grid.dx, y - grid.y(j) + 0.5 * grid.dy, z);
      add(p, corner.pressure(nu), sum);
      add(qx, corner.along_x(nu), sum);
      add(qy, corner.along_y(nu), sum);
    }
  Stress stress;
  add(0.5 / std::numbers::pi, sum, stress);
  return stress;
}

Stress mean_rail_stress(const SurfaceLoad& load, const Box& box) {
  Stress mean;
  for (const Sample& z : samples(box.top, box.height, load.grid.dx))
    for (const Sample& y : samples(box.y - 0.5 * box.width, box.width, load.grid.dy))
      for (const Sample& x : samples(box.x - 0.5 * box.length, box.length, load.grid.dx))
        add(x.weight * y.weight * z.weight, rail_stress(load, x.at, y.at, z.at), mean);
  return mean;
}

double largest_box_stress(const SurfaceLoad& load, const Box& box, double reach) {
  constexpr int kSide = 4;
  double largest = 0;
  for (int i = -kSide; i <= kSide; ++i) {
    Box moved = box;
    moved.x += reach * i / kSide;
    largest = std::max(largest, von_mises(mean_rail_stress(load, moved)));
  }
  return largest;
}

}  // namespace tread::half_space
