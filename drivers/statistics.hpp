#pragma once
// Mean, extremes and scatter of values.

#include <algorithm>
#include <cmath>

namespace tread {

struct Statistics {
  double mean = 0, min = 0, max = 0;
  double deviation = 0;  ///< standard, about the mean

  double range() const { return max - min; }
};

/// Of value(item) over the items that `counts` accepts; zeros if there is none.
template <class Items, class Counts, class Value>
Statistics statistics(const Items& items, const Counts& counts, const Value& value) {
  Statistics s;
  double squares = 0;
  int count = 0;
  for (const auto& item : items) {
    if (!counts(item)) continue;
    const double v = value(item);
    s.min = count == 0 ? v : std::min(s.min, v);
    s.max = count == 0 ? v : std::max(s.max, v);
    s.mean += v;
    squares += v * v;
    ++count;
  }
  if (count == 0) return s;
  s.mean /= count;
  s.deviation = std::sqrt(std::max(0.0, squares / count - s.mean * s.mean));
  return s;
}

}  // namespace tread
