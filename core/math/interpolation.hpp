#pragma once
// Values of curves between their points, and the points about a value.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace tread {

/// The curve of `y` over `x`, which increases, at `place`: linear between its points, NaN beyond its ends.
inline double value_at(const std::vector<double>& x, const std::vector<double>& y, double place) {
  if (x.empty() || place < x.front() || place > x.back()) return std::numeric_limits<double>::quiet_NaN();
  const auto above = std::upper_bound(x.begin(), x.end(), place);
  if (above == x.end()) return y.back();
  const auto i = static_cast<std::size_t>(above - x.begin()) - 1;
  const double share = (place - x[i]) / (x[i + 1] - x[i]);
  return (1 - share) * y[i] + share * y[i + 1];
}

/// Place of the value nearest to `wanted`, the first of those that are equally near; the size where there is
/// none.
inline std::size_t nearest(const std::vector<double>& values, double wanted) {
  const auto found = std::min_element(values.begin(), values.end(), [wanted](double a, double b) {
    return std::abs(a - wanted) < std::abs(b - wanted);
  });
  return static_cast<std::size_t>(found - values.begin());
}

}  // namespace tread
