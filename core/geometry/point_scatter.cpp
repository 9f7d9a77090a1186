#include "core/geometry/point_scatter.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace tread {

std::optional<double> point_scatter(const std::vector<double>& y, const std::vector<double>& z) {
  constexpr std::size_t kFewest = 20;
  constexpr std::size_t kNeighbours = 4;
  constexpr double kMedian = 0.6745;  // of the size of a normal deviate
  if (y.size() < kFewest) return std::nullopt;
  std::vector<double> sizes;
  for (std::size_t first = 0; first + kNeighbours <= y.size(); ++first) {
    double sum = 0;
    double squares = 0;
    for (std::size_t i = first; i < first + kNeighbours; ++i) {
      double weight = 1;
      for (std::size_t j = first; j < first + kNeighbours; ++j)
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

}  // namespace tread
