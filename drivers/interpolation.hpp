#pragma once
// Values of curves between their points.

#include <algorithm>
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

}  // namespace tread
