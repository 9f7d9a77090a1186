#include "core/geometry/point_scatter.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace tread {

namespace {

/// Median of the third divided differences of four points each, every `stride`-th, in standard deviations of
/// the z that would cause them [m].
double median_difference(const std::vector<double>& y, const std::vector<double>& z, std::size_t stride) {
  constexpr std::size_t kNeighbours = 4;
  constexpr double kMedian = 0.6745;  // of the size of a normal deviate
  const std::size_t reach = (kNeighbours - 1) * stride;
  std::vector<double> sizes;
  for (std::size_t first = 0; first + reach < y.size(); ++first) {
    double sum = 0;
    double squares = 0;
    for (std::size_t i = first; i <= first + reach; i += stride) {
      double weight = 1;
      for (std::size_t j = first; j <= first + reach; j += stride)
        if (j != i) weight /= y[i] - y[j];
      sum += weight * z[i];
      squares += weight * weight;
    }
    sizes.push_back(std::abs(sum) / std::sqrt(squares));
  }
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return *middle / kMedian;
}

}  // namespace

std::optional<double> point_scatter(const std::vector<double>& y, const std::vector<double>& z) {
  constexpr std::size_t kFewest = 20;
  if (y.size() < kFewest) return std::nullopt;
  const double near = median_difference(y, z, 1), far = median_difference(y, z, 2);
  // The share of the line itself grows as the cube of the distance, that of the scatter does not.
  const double line = (far * far - near * near) / (8 * 8 - 1);
  return std::sqrt(std::max(0.0, near * near - std::max(0.0, line)));
}

}  // namespace tread
