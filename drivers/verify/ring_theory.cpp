#include "drivers/verify/ring_theory.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/error.hpp"

namespace tread {

namespace {

/// A Bessel function of k r and its derivative by r.
struct Radial {
  double value, slope;
};

Radial radial(bool second_kind, int n, double k, double r) {
  const auto bessel = [&](int order) {
    // J_-1 = -J_1 and Y_-1 = -Y_1
    const double sign = order < 0 ? -1 : 1;
    const double m = std::abs(order);
    return sign * (second_kind ? std::cyl_neumann(m, k * r) : std::cyl_bessel_j(m, k * r));
  };
  return {bessel(n), 0.5 * k * (bessel(n - 1) - bessel(n + 1))};
}

using Matrix4 = std::array<std::array<double, 4>, 4>;  // rows

/// Determinant of the matrix with its columns scaled to a largest value of 1, by elimination with row pivots.
double scaled_determinant(Matrix4 m) {
  for (std::size_t column = 0; column < 4; ++column) {
    double largest = 0;
    for (const auto& row : m) largest = std::max(largest, std::abs(row[column]));
    for (auto& row : m) row[column] /= largest;
  }
  double product = 1;
  for (std::size_t k = 0; k < 4; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < 4; ++i)
      if (std::abs(m[i][k]) > std::abs(m[pivot][k])) pivot = i;
    if (pivot != k) {
      std::swap(m[k], m[pivot]);
      product = -product;
    }
    product *= m[k][k];
    if (product == 0) return 0;
    for (std::size_t i = k + 1; i < 4; ++i) {
      const double share = m[i][k] / m[k][k];
      for (std::size_t j = k; j < 4; ++j) m[i][j] -= share * m[k][j];
    }
  }
  return product;
}

/// Determinant of the four tractions that the four potentials leave on the cylinders. The displacements of f
/// cos(n t), g sin(n t) are u_r = f' + n g / r, u_t = -n f / r - g'.
double determinant(const PlaneRing& ring, int n, double omega) {
  const double nu = ring.poissons_ratio;
  const double mu = ring.youngs_modulus / (2 * (1 + nu));
  const double lambda = 2 * mu * nu / (1 - 2 * nu);
  const double alpha = omega / std::sqrt((lambda + 2 * mu) / ring.density);
  const double beta = omega / std::sqrt(mu / ring.density);
  Matrix4 tractions{};
  const std::array radii = {ring.inner, ring.outer};
  for (std::size_t i = 0; i < 2; ++i) {
    const double r = radii[i];
    const double nn = static_cast<double>(n) * n / (r * r);
    auto& normal = tractions[2 * i];
    auto& shear = tractions[2 * i + 1];
    for (std::size_t kind = 0; kind < 2; ++kind) {
      const Radial f = radial(kind == 1, n, alpha, r);
      const Radial g = radial(kind == 1, n, beta, r);
      normal[kind] =
          -lambda * alpha * alpha * f.value + 2 * mu * ((nn - alpha * alpha) * f.value - f.slope / r);
      normal[2 + kind] = 2 * mu * n * (g.slope / r - g.value / (r * r));
      shear[kind] = -2 * mu * n * (f.slope / r - f.value / (r * r));
      shear[2 + kind] = mu * (2 * g.slope / r + (beta * beta - 2 * nn) * g.value);
    }
  }
  return scaled_determinant(tractions);
}

}  // namespace

double thin_ring_frequency(const PlaneRing& ring, int waves) {
  const double modulus = ring.youngs_modulus / (1 - ring.poissons_ratio * ring.poissons_ratio);
  const double thickness = ring.outer - ring.inner;
  const double radius = 0.5 * (ring.outer + ring.inner);
  const double n2 = static_cast<double>(waves) * waves;
  const double omega2 = modulus * thickness * thickness / (12 * ring.density * std::pow(radius, 4)) * n2 *
                        (n2 - 1) * (n2 - 1) / (n2 + 1);
  return std::sqrt(omega2) / (2 * std::numbers::pi);
}

double exact_ring_frequency(const PlaneRing& ring, int waves) {
  // Shear and rotary inertia lower the thin ring's frequency: the search takes the first change of sign from
  // far below.
  constexpr int kSteps = 400;
  const double top = 1.5 * 2 * std::numbers::pi * thin_ring_frequency(ring, waves);
  double low = 0.02 * top;
  const bool negative = determinant(ring, waves, low) < 0;
  for (int i = 1; i <= kSteps; ++i) {
    double high = top * (0.02 + 0.98 * i / kSteps);
    if ((determinant(ring, waves, high) < 0) == negative) {
      low = high;
      continue;
    }
    for (int bisection = 0; bisection < 60; ++bisection) {
      const double middle = 0.5 * (low + high);
      ((determinant(ring, waves, middle) < 0) == negative ? low : high) = middle;
    }
    return low / (2 * std::numbers::pi);
  }
  throw NumericalError("verify: the ring's frequency equation has no root below 1.5 times the thin ring's");
}

}  // namespace tread
