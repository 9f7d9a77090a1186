#include "core/geometry/smoothing_spline.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/math/band_matrix.hpp"
#include "core/millimetre.hpp"

namespace tread {

namespace {

/// Second divided differences of values at the distances `h`: Q^T v of Reinsch's paper.
std::vector<double> bends(const std::vector<double>& h, const std::vector<double>& v) {
  std::vector<double> result(v.size() - 2);
  for (std::size_t i = 0; i < result.size(); ++i)
    result[i] = (v[i + 2] - v[i + 1]) / h[i + 1] - (v[i + 1] - v[i]) / h[i];
  return result;
}

/// Values of the spline that minimises the sum of squared residuals plus `weight` times the integral of the
/// squared second derivative.
std::vector<double> spline_values(const std::vector<double>& h, const std::vector<double>& v, double weight) {
  const std::size_t n = v.size(), inner = n - 2;
  BandMatrix<double> matrix(static_cast<int>(inner), 2);
  const auto row = [&](std::size_t i) {  // entries of Q in column i
    return std::vector<double>{1 / h[i], -1 / h[i] - 1 / h[i + 1], 1 / h[i + 1]};
  };
  for (std::size_t i = 0; i < inner; ++i) {
    const int at = static_cast<int>(i);
    const auto a = row(i);
    matrix.at(at, at) = (h[i] + h[i + 1]) / 3 + weight * (a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
    if (i + 1 < inner) {
      const auto b = row(i + 1);
      matrix.at(at + 1, at) = h[i + 1] / 6 + weight * (a[1] * b[0] + a[2] * b[1]);
    }
    if (i + 2 < inner) matrix.at(at + 2, at) = weight * a[2] * row(i + 2)[0];
  }
  matrix.factorise();
  const std::vector<double> curvature = matrix.solve(bends(h, v));
  std::vector<double> values = v;
  for (std::size_t i = 0; i < inner; ++i) {
    const auto a = row(i);
    for (std::size_t k = 0; k < 3; ++k) values[i + k] -= weight * a[k] * curvature[i];
  }
  return values;
}

}  // namespace

std::vector<double> smooth(std::vector<double>& y, std::vector<double>& z, double largest) {
  const std::size_t n = y.size();
  std::vector<double> h(n - 1), deviation(n);  // [mm], so that the weights are of order 1
  for (std::size_t i = 0; i + 1 < n; ++i) h[i] = std::hypot(y[i + 1] - y[i], z[i + 1] - z[i]) / mm;
  std::vector<double> smooth_y = y, smooth_z = z;
  const auto deviates = [&](double weight) {
    smooth_y = spline_values(h, y, weight);
    smooth_z = spline_values(h, z, weight);
    for (std::size_t i = 0; i < n; ++i) deviation[i] = std::hypot(smooth_y[i] - y[i], smooth_z[i] - z[i]);
    return *std::max_element(deviation.begin(), deviation.end()) > largest;
  };
  double low = -10, high = 8;  // powers of ten of the weight [mm3]
  for (int step = 0; step < 40; ++step) {
    const double middle = 0.5 * (low + high);
    (deviates(std::pow(10.0, middle)) ? high : low) = middle;
  }
  deviates(std::pow(10.0, low));
  y = smooth_y;
  z = smooth_z;
  return deviation;
}

}  // namespace tread
