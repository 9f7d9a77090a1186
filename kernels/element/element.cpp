#include "kernels/element/element.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace tread {

namespace {

constexpr int kCorner[8][3] = {{-1, -1, -1}, {-1, 1, -1}, {-1, 1, 1}, {-1, -1, 1},
                               {1, -1, -1},  {1, 1, -1},  {1, 1, 1},  {1, -1, 1}};

double determinant(const Mat3& m) {
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
         m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

/// Trilinear shape function and its derivatives by (xi, eta, zeta).
std::array<double, 4> shape(int node, const std::array<double, 3>& at) {
  std::array<double, 3> f{};
  for (std::size_t k = 0; k < 3; ++k) f[k] = 1 + kCorner[node][k] * at[k];
  const int* s = kCorner[node];
  return {f[0] * f[1] * f[2] / 8, s[0] * f[1] * f[2] / 8, s[1] * f[0] * f[2] / 8, s[2] * f[0] * f[1] / 8};
}

Mat3 jacobian(const HexNodes& nodes, const std::array<double, 3>& at) {
  Mat3 result{};
  for (int node = 0; node < 8; ++node) {
    const auto n = shape(node, at);
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k)
        result[i][k] += nodes[static_cast<std::size_t>(node)][static_cast<int>(i)] * n[k + 1];
  }
  return result;
}

}  // namespace

int mode_value(Mode mode, int node) {
  const int* s = kCorner[node];
  switch (mode) {
    case mode_xi:
      return s[0];
    case mode_eta:
      return s[1];
    case mode_zeta:
      return s[2];
    case mode_h1:
      return s[1] * s[2];
    case mode_h2:
      return s[2] * s[0];
    case mode_h3:
      return s[0] * s[1];
    default:
      return s[0] * s[1] * s[2];
  }
}

ElementGeometry element_geometry(const HexNodes& nodes) {
  ElementGeometry result;
  auto& x = result.position;
  for (int mode = 0; mode < kModes; ++mode)
    for (int node = 0; node < 8; ++node)
      x[static_cast<std::size_t>(mode)] +=
          mode_value(static_cast<Mode>(mode), node) * nodes[static_cast<std::size_t>(node)];

  // The integral of the Jacobian determinant is a sum of triple products of amplitudes. Its derivatives by
  // them are the volume times the mean gradients. [theory.md, Element]
  auto& g = result.gradient;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t k1 = (k + 1) % 3, k2 = (k + 2) % 3, h1 = mode_h1 + k1, h2 = mode_h1 + k2;
    g[k] = cross(x[k1], x[k2]) + 1.0 / 3 * cross(x[h2], x[h1]);
    g[mode_h1 + k] = 1.0 / 3 * (cross(x[k2], x[h1]) + cross(x[h2], x[k1]));
  }
  const double triple =
      dot(x[mode_xi], g[mode_xi]) + dot(x[mode_h1], g[mode_h1]);  // every term holds xi or h1
  result.volume = triple / 64;
  for (Vec3& row : g) row = 1 / triple * row;

  // N_I det J is of degree 3 in each coordinate: two points per direction are exact.
  const double point = 1 / std::sqrt(3.0);
  for (const auto& sign : kCorner) {
    const std::array<double, 3> at = {sign[0] * point, sign[1] * point, sign[2] * point};
    const double weight = determinant(jacobian(nodes, at));
    for (int node = 0; node < 8; ++node)
      result.nodal_volume[static_cast<std::size_t>(node)] += shape(node, at)[0] * weight;
  }
  result.smallest_jacobian = std::numeric_limits<double>::max();
  for (const auto& sign : kCorner) {
    const double corner = determinant(jacobian(nodes, {1.0 * sign[0], 1.0 * sign[1], 1.0 * sign[2]}));
    result.smallest_jacobian = std::min(result.smallest_jacobian, corner / (std::abs(result.volume) / 8));
  }
  return result;
}

HexNodes swept_nodes(const Section& section, int quad, Sweep sweep, double pitch) {
  HexNodes nodes;
  for (std::size_t corner = 0; corner < 4; ++corner) {
    const auto node = static_cast<std::size_t>(section.quads[static_cast<std::size_t>(quad)][corner]);
    const double p = section.p[node];
    const double q = section.q[node];
    if (sweep == Sweep::extruded) {
      nodes[corner] = {-pitch / 2, p, q};
      nodes[corner + 4] = {pitch / 2, p, q};
    } else {
      nodes[corner] = {-q * std::sin(pitch / 2), p, q * std::cos(pitch / 2)};
      nodes[corner + 4] = {q * std::sin(pitch / 2), p, q * std::cos(pitch / 2)};
    }
  }
  return nodes;
}

namespace {

/// P^T C P for a sparse P: the result's row r is the sum over k < terms of row(r, k), a row of C and its
/// weight.
template <class Row>
HourglassMatrix combined(const HourglassMatrix& c, std::size_t terms, const Row& row) {
  HourglassMatrix result{};
  for (std::size_t r = 0; r < 12; ++r)
    for (std::size_t s = 0; s < 12; ++s)
      for (std::size_t i = 0; i < terms; ++i)
        for (std::size_t j = 0; j < terms; ++j) {
          const auto [from_r, weight_r] = row(r, i);
          const auto [from_s, weight_s] = row(s, j);
          result[r][s] += weight_r * c[from_r][from_s] * weight_s;
        }
  return result;
}

}  // namespace

HourglassMatrix hourglass_matrix(const HexNodes& swept, double volume, const Material& material) {
  // Polar decomposition of the centre Jacobian: x stands alone, the rotation about it has a closed form.
  const Mat3 map = jacobian(swept, {0, 0, 0});
  const double length = std::hypot(map[1][1] + map[2][2], map[2][1] - map[1][2]);
  const double c = (map[1][1] + map[2][2]) / length;
  const double s = (map[2][1] - map[1][2]) / length;
  const std::array<double, 3> half = {map[0][0], c * map[1][1] + s * map[2][1],
                                      c * map[2][2] - s * map[1][2]};
  const auto h = [&](std::size_t i, std::size_t j) { return volume / (3 * half[i] * half[j]); };

  // Local matrix; the 1/64 turns amplitudes that are sums of eight values into means.
  HourglassMatrix local{};
  const auto index = [](std::size_t i, std::size_t alpha) { return 4 * i + alpha; };
  const auto add = [&](std::size_t a, std::size_t b, double value) {
    local[a][b] += value / 64;
    if (a != b) local[b][a] += value / 64;
  };
  const double mu = material.shear_modulus();
  const double e = material.youngs_modulus;
  const double nu = material.poissons_ratio;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const std::size_t k = (i + 2) % 3;
    add(index(i, i), index(i, i), mu * (h(j, j) + h(k, k)));
    add(index(i, i), index(j, j), mu * h(i, j));
    const double plate = e / (1 - nu * nu);  // bending in the plane (i, j), normal k
    add(index(i, j), index(i, j), plate * h(i, i));
    add(index(j, i), index(j, i), plate * h(j, j));
    add(index(i, j), index(j, i), plate * nu * h(i, j));
    add(index(i, 3), index(i, 3), e * h(i, i) / 3);
  }

  // q' = R^T q, hence C = R C' R^T for the components of every mode.
  const double turn[3][3] = {{1, 0, 0}, {0, c, -s}, {0, s, c}};
  return combined(local, 3, [&](std::size_t row, std::size_t i) {
    return std::pair{index(i, row % 4), turn[row / 4][i]};
  });
}

namespace {

/// Values by the modes s02, s13 or d02, d13.
struct ByDiagonals {
  Vec3 along02, along13;
};

ByDiagonals by_diagonals(const Vec3& difference, const Vec3& sum, double scale) {
  return {scale * (sum + difference), scale * (sum - difference)};
}

/// C over gap, d02, d13 and h4 in place of h1 = gap / gap_by_h1, h2 = d02 + d13, h3 = d02 - d13 and h4.
HourglassMatrix in_kernel_modes(const HourglassMatrix& c, double gap_by_h1) {
  const double from[4][4] = {{1 / gap_by_h1, 0, 0, 0}, {0, 1, 1, 0}, {0, 1, -1, 0}, {0, 0, 0, 1}};
  return combined(c, 4, [&](std::size_t row, std::size_t m) {
    return std::pair{row / 4 * 4 + m, from[m][row % 4]};
  });
}

/// `matrix`: in the kernels' modes.
template <class Real>
HourglassConstants<Real> hourglass_constants(const HourglassMatrix& matrix) {
  enum : std::size_t { x1, x2, x3, x4, y1, y2, y3, y4, z1, z2, z3, z4 };
  const auto entry = [&](std::size_t row, std::size_t column) {
    return static_cast<Real>(matrix[row][column]);
  };
  HourglassConstants<Real> h;
  constexpr std::size_t kEven[4] = {x2, x3, y1, z1};
  constexpr std::size_t kOdd[5] = {x1, y2, z2, y3, z3};
  for (std::size_t k = 0; k < 4; ++k) h.even_diagonal[k] = entry(kEven[k], kEven[k]);
  h.x2_x3 = entry(x2, x3);
  h.x2_y1 = entry(x2, y1);
  h.x2_z1 = entry(x2, z1);
  h.x3_y1 = entry(x3, y1);
  h.x3_z1 = entry(x3, z1);
  h.y1_z1 = entry(y1, z1);
  h.x4 = entry(x4, x4);
  std::size_t upper = 0;
  for (std::size_t row = 0; row < 5; ++row) {
    h.odd_diagonal[row] = entry(kOdd[row], kOdd[row]);
    for (std::size_t column = row + 1; column < 5; ++column)
      h.odd_upper[upper++] = entry(kOdd[row], kOdd[column]);
  }
  h.y4 = entry(y4, y4);
  h.z4 = entry(z4, z4);
  h.y4_z4 = entry(y4, z4);
  return h;
}

}  // namespace

template <class Real>
SweptConstants<Real> swept_constants(const ElementGeometry& geometry, const HourglassMatrix& hourglass,
                                     const Material& material) {
  SweptConstants<Real> c{};
  const auto real = [](double value) { return static_cast<Real>(value); };
  const auto& x = geometry.position;
  const auto& g = geometry.gradient;
  const ByDiagonals x_s = by_diagonals(x[mode_eta], x[mode_zeta], 0.5);
  const ByDiagonals x_d = by_diagonals(x[mode_h3], x[mode_h2], 0.5);
  ByDiagonals g_s = by_diagonals(g[mode_eta], g[mode_zeta], 1);
  const ByDiagonals g_d = by_diagonals(g[mode_h3], g[mode_h2], 1);

  // The gap is h1 / 2 + (crossing[0] - 1/2) s02 - (crossing[1] - 1/2) s13 and zero for linear fields.
  const auto cross_x = [](const Vec3& a, const Vec3& b) { return a.y * b.z - a.z * b.y; };
  const double area = cross_x(x_s.along02, x_s.along13);
  const double off02 = -cross_x(x[mode_h1], x_s.along13) / (2 * area);
  const double off13 = -cross_x(x[mode_h1], x_s.along02) / (2 * area);
  g_s.along02 -= 2 * off02 * g[mode_h1];
  g_s.along13 += 2 * off13 * g[mode_h1];
  const double gap_by_h1 = 0.5 / (1 - dot(x[mode_h1], g[mode_h1]));
  c.crossing[0] = real(0.5 + off02);
  c.crossing[1] = real(0.5 + off13);
  c.gap_by_h1 = real(gap_by_h1);

  const auto set = [&](Real* to, std::initializer_list<double> values) {
    std::transform(values.begin(), values.end(), to, real);
  };
  set(c.gradient_x, {g[mode_xi].x, g_d.along02.x, g_d.along13.x});
  set(c.gradient_y, {g_s.along02.y, g_s.along13.y, 2 * g[mode_h1].y});
  set(c.gradient_z, {g_s.along02.z, g_s.along13.z, 2 * g[mode_h1].z});
  set(c.position_x, {x[mode_xi].x, x_d.along02.x, x_d.along13.x, x[mode_h4].x});
  set(c.position_y, {x_s.along02.y, x_s.along13.y, x[mode_h1].y});
  set(c.position_z, {x_s.along02.z, x_s.along13.z, x[mode_h1].z});
  c.inverse_volume = real(1 / geometry.volume);
  c.lambda = real(material.lame_lambda() * geometry.volume);
  c.mu = real(material.shear_modulus() * geometry.volume);

  c.hourglass = hourglass_constants<Real>(in_kernel_modes(hourglass, gap_by_h1));
  return c;
}

template SweptConstants<double> swept_constants(const ElementGeometry&, const HourglassMatrix&,
                                                const Material&);
template SweptConstants<float> swept_constants(const ElementGeometry&, const HourglassMatrix&,
                                               const Material&);

}  // namespace tread
