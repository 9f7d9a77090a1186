#pragma once
// Interpolation of curves and search for the nearest value.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace tread {

/// Value at `place` of the curve of `y` over the increasing `x`: linear between the points, NaN beyond the
/// ends and for a place that is NaN.
inline double value_at(const std::vector<double>& x, const std::vector<double>& y, double place) {
  if (x.empty() || !(place >= x.front() && place <= x.back()))
    return std::numeric_limits<double>::quiet_NaN();
  const auto above = std::upper_bound(x.begin(), x.end(), place);
  if (above == x.end()) return y.back();
  const auto i = static_cast<std::size_t>(above - x.begin()) - 1;
  const double share = (place - x[i]) / (x[i + 1] - x[i]);
  return (1 - share) * y[i] + share * y[i + 1];
}

/// Index of the value nearest to `wanted`, the first of equally near ones; values.size() if there are no
/// values.
inline std::size_t nearest(const std::vector<double>& values, double wanted) {
  const auto found = std::min_element(values.begin(), values.end(), [wanted](double a, double b) {
    return std::abs(a - wanted) < std::abs(b - wanted);
  });
  return static_cast<std::size_t>(found - values.begin());
}

}  // namespace tread
