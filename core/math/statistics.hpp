#pragma once
// Mean, extremes, scatter and trend of values.

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace tread {

struct Statistics {
  double mean = 0, min = 0, max = 0;
  double deviation = 0;  ///< standard deviation about the mean

  double range() const { return max - min; }
};

/// Mean distance of places in their order, two at least.
inline double mean_spacing(const std::vector<double>& places) {
  return (places.back() - places.front()) / static_cast<double>(places.size() - 1);
}

/// Statistics of value(item) over the items that `counts` accepts; zeros if there is none.
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

inline Statistics statistics(const std::vector<double>& values) {
  return statistics(
      values, [](double) { return true; }, [](double value) { return value; });
}

/// Correlation coefficient of two curves at equal places; nullopt if one of them is constant or empty.
inline std::optional<double> correlation(const std::vector<double>& a, const std::vector<double>& b) {
  const Statistics of_a = statistics(a);
  const Statistics of_b = statistics(b);
  if (of_a.deviation == 0 || of_b.deviation == 0) return std::nullopt;
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - of_a.mean) * (b[i] - of_b.mean);
  return sum / static_cast<double>(a.size()) / (of_a.deviation * of_b.deviation);
}

/// Least-squares line through the points that are added.
class LineFit {
 public:
  void add(double x, double y) {
    n_ += 1;
    x_ += x;
    y_ += y;
    xx_ += x * x;
    xy_ += x * y;
  }
  /// Rise of the line over a stretch `run` of the abscissa, in the ordinate's unit; NaN with fewer than two
  /// abscissae.
  double rise(double run) const { return run * (n_ * xy_ - x_ * y_) / (n_ * xx_ - x_ * x_); }
  double slope() const { return rise(1); }
  double mean() const { return y_ / n_; }  ///< of the ordinates

 private:
  double n_ = 0, x_ = 0, y_ = 0, xx_ = 0, xy_ = 0;  ///< count and sums
};

}  // namespace tread
