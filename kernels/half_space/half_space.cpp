#include "kernels/half_space/half_space.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/error.hpp"

namespace tread::half_space {

namespace {

/// Returns x asinh(y / |x|), zero for x = 0.
double x_asinh(double x, double y) {
  return x == 0 ? 0 : x * std::asinh(y / std::abs(x));
}

/// Integrals of a function over the cells: differences of its double indefinite integral f at the cells'
/// corners.
template <class Corner>
OffsetTable integrated(int reach_x, int reach_y, double dx, double dy, double factor, Corner f) {
  OffsetTable table(reach_x, reach_y);
  const int columns = 2 * reach_x + 2;
  const int rows = 2 * reach_y + 2;
  std::vector<double> corner(std::size_t(columns) * rows);
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i)
      corner[j * columns + i] = f((i - reach_x - 0.5) * dx, (j - reach_y - 0.5) * dy);
  for (int j = 0; j + 1 < rows; ++j)
    for (int i = 0; i + 1 < columns; ++i) {
      const double* c = corner.data() + j * columns + i;
      table.at(i - reach_x, j - reach_y) = factor * (c[columns + 1] - c[columns] - c[1] + c[0]);
    }
  return table;
}

double total(const std::vector<double>& v) {
  return std::accumulate(v.begin(), v.end(), 0.0);
}

/// Mean of v over the cells under pressure.
double mean_on(const std::vector<double>& pressure, const std::vector<double>& v) {
  double sum = 0;
  int cells = 0;
  for (std::size_t k = 0; k < v.size(); ++k)
    if (pressure[k] > 0) {
      sum += v[k];
      ++cells;
    }
  return sum / cells;
}

void check_border(const Grid& grid, const std::vector<double>& pressure) {
  for (int j = 0; j < grid.ny; ++j)
    for (int i = 0; i < grid.nx; ++i)
      if ((i == 0 || j == 0 || i + 1 == grid.nx || j + 1 == grid.ny) && pressure[grid.index(i, j)] > 0)
        throw NumericalError(
            fmt::format("half-space reference: the contact reaches the border of its grid at x = {:.4f}, y = "
                        "{:.4f} m; take a larger grid",
                        grid.x(i), grid.y(j)));
}

}  // namespace

Grid centred_grid(double half_x, double half_y, double cell, bool node) {
  const auto count = [&](double half) {
    return node ? 2 * static_cast<int>(std::ceil(half / cell))
                : 2 * static_cast<int>(std::ceil(half / cell - 0.5)) + 1;
  };
  const int nx = count(half_x);
  const int ny = count(half_y);
  return {nx, ny, cell, cell, -0.5 * (nx - 1) * cell, -0.5 * (ny - 1) * cell};
}

double reach_in_hollow(double semi_axis, double radius, double curvature, double slope, double edge) {
  const double touching = curvature * radius > 0.5 ? edge : 2 * slope * radius;
  return std::max(2 * semi_axis, 1.5 * semi_axis + touching);
}

double interpolated(const Grid& grid, const std::vector<double>& field, double x, double y) {
  const double u = (x - grid.x0) / grid.dx;
  const double v = (y - grid.y0) / grid.dy;
  const int i = static_cast<int>(std::floor(u));
  const int j = static_cast<int>(std::floor(v));
  if (i < 0 || j < 0 || i + 1 >= grid.nx || j + 1 >= grid.ny) return 0;
  const auto at = [&](int di, int dj) { return field[grid.index(i + di, j + dj)]; };
  return std::lerp(std::lerp(at(0, 0), at(1, 0), u - i), std::lerp(at(0, 1), at(1, 1), u - i), v - j);
}

Influence::Influence(const Grid& g, const Material& m) : grid(g), material(m) {
  const double nu = m.poissons_ratio;
  const double both = 1 / (std::numbers::pi * m.shear_modulus());
  const auto table = [&](double factor, auto corner) {
    return integrated(g.nx, g.ny - 1, g.dx, g.dy, factor * both, corner);
  };
  // Integrals of 1/r, x^2/r^3, y^2/r^3 and xy/r^3.
  const auto inverse = [](double x, double y) { return x_asinh(x, y) + x_asinh(y, x); };
  normal = table(1 - nu, inverse);
  xx = table(1, [nu](double x, double y) { return (1 - nu) * x_asinh(x, y) + x_asinh(y, x); });
  yy = table(1, [nu](double x, double y) { return x_asinh(x, y) + (1 - nu) * x_asinh(y, x); });
  xy = table(nu, [](double x, double y) { return -std::hypot(x, y); });
}

void apply(const OffsetTable& table, const Grid& grid, const std::vector<double>& load,
           std::vector<double>& sum) {
  for (int js = 0; js < grid.ny; ++js)
    for (int is = 0; is < grid.nx; ++is) {
      const double p = load[grid.index(is, js)];
      if (p == 0) continue;
      for (int j = 0; j < grid.ny; ++j) {
        const double* __restrict c = table.row(j - js) - is;
        double* __restrict u = sum.data() + grid.index(0, j);
        for (int i = 0; i < grid.nx; ++i) u[i] += p * c[i];
      }
    }
}

namespace {

/// Sums over the pressures `p` [Pa] of cells of area `cell` [m2].
NormalContact contact_under(std::vector<double> p, double cell, double approach) {
  NormalContact contact;
  contact.cells = static_cast<int>(std::count_if(p.begin(), p.end(), [](double v) { return v > 0; }));
  contact.area = contact.cells * cell;
  contact.load = total(p) * cell;
  contact.max_pressure = *std::max_element(p.begin(), p.end());
  contact.approach = approach;
  contact.pressure = std::move(p);
  return contact;
}

}  // namespace

NormalContact press(const Influence& influence, const Gap& gap, double load) {
  constexpr double kTolerance = 1e-10;  ///< change of the pressures in one iteration / their sum
  constexpr int kIterations = 500;
  const Grid& grid = influence.grid;
  const int n = grid.size();
  const double cell = grid.dx * grid.dy;
  std::vector<double> h(n), g(n), r(n), t(n, 0.0), p(n, load / (n * cell));
  for (int j = 0; j < grid.ny; ++j)
    for (int i = 0; i < grid.nx; ++i) h[grid.index(i, j)] = gap(grid.x(i), grid.y(j));

  double level = 0;
  double last_norm = 1;
  bool conjugate = false;
  double change = 1;
  for (int iteration = 0; change > kTolerance; ++iteration) {
    if (iteration == kIterations)
      throw NumericalError("half-space reference: the normal contact does not converge; check the gap");
    g = h;
    apply(influence.normal, grid, p, g);
    level = mean_on(p, g);
    double norm = 0;
    for (int k = 0; k < n; ++k) {
      g[k] -= level;
      if (p[k] > 0) norm += g[k] * g[k];
    }
    for (int k = 0; k < n; ++k) t[k] = p[k] > 0 ? g[k] + (conjugate ? norm / last_norm * t[k] : 0) : 0;
    last_norm = norm;
    std::fill(r.begin(), r.end(), 0);
    apply(influence.normal, grid, t, r);
    const double mean = mean_on(p, r);
    double along = 0;
    double curvature = 0;
    for (int k = 0; k < n; ++k)
      if (p[k] > 0) {
        along += g[k] * t[k];
        curvature += (r[k] - mean) * t[k];
      }
    const double step = curvature > 0 ? along / curvature : 0;

    const std::vector<double> before = p;
    for (int k = 0; k < n; ++k) p[k] = std::max(0.0, p[k] - step * t[k]);
    conjugate = true;
    for (int k = 0; k < n; ++k)
      if (p[k] == 0 && g[k] < 0) {
        p[k] = -step * g[k];
        conjugate = false;
      }
    const double scale = load / (total(p) * cell);
    change = 0;
    for (int k = 0; k < n; ++k) {
      p[k] *= scale;
      change += std::abs(p[k] - before[k]) * cell / load;
    }
  }
  check_border(grid, p);
  return contact_under(std::move(p), cell, level);
}

Gap quadratic_gap(double radius_x, double radius_y) {
  return [=](double x, double y) { return x * x / (2 * radius_x) + y * y / (2 * radius_y); };
}

}  // namespace tread::half_space
