#pragma once
// Mean, extremes, scatter, median and trend of values.

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace tread {

struct Statistics {
  double mean = 0, min = 0, max = 0;
  double deviation = 0;  ///< standard deviation about the mean

  double range() const { return max - min; }
  /// Returns true if the values scatter by no more than their rounding, or one of them is NaN.
  bool constant() const { return !(deviation > 1e-12 * std::max(std::abs(min), std::abs(max))); }
};

/// Mean distance of places in their order, two at least.
inline double mean_spacing(const std::vector<double>& places) {
  return (places.back() - places.front()) / static_cast<double>(places.size() - 1);
}

/// Statistics of value(item) over the items that `counts` accepts; zeros if there is none.
template <class Items, class Counts, class Value>
Statistics statistics(const Items& items, const Counts& counts, const Value& value) {
  Statistics s;
  int count = 0;
  for (const auto& item : items) {
    if (!counts(item)) continue;
    const double v = value(item);
    s.min = count == 0 ? v : std::min(s.min, v);
    s.max = count == 0 ? v : std::max(s.max, v);
    s.mean += v;
    ++count;
  }
  if (count == 0) return s;
  s.mean /= count;
  double sum = 0, squares = 0;  // about the mean: squares of large values lose the digits of a small scatter
  for (const auto& item : items) {
    if (!counts(item)) continue;
    const double apart = value(item) - s.mean;
    sum += apart;
    squares += apart * apart;
  }
  s.deviation = std::sqrt(std::max(0.0, squares / count - (sum / count) * (sum / count)));
  return s;
}

inline Statistics statistics(const std::vector<double>& values) {
  return statistics(
      values, [](double) { return true; }, [](double value) { return value; });
}

/// Middle value, of an even number the mean of the middle two. At least one value.
inline double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return 0.5 * (values[(values.size() - 1) / 2] + values[values.size() / 2]);
}

/// Correlation coefficient of two curves at equal places; nullopt if one of them is constant or empty.
inline std::optional<double> correlation(const std::vector<double>& a, const std::vector<double>& b) {
  const Statistics of_a = statistics(a);
  const Statistics of_b = statistics(b);
  if (of_a.constant() || of_b.constant()) return std::nullopt;
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - of_a.mean) * (b[i] - of_b.mean);
  return sum / static_cast<double>(a.size()) / (of_a.deviation * of_b.deviation);
}

/// Least-squares line through the points that are added. Abscissae count from the first one: far from zero
/// their squares would lose the digits of their differences.
class LineFit {
 public:
  void add(double x, double y) {
    if (n_ == 0) first_ = x;
    x -= first_;
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
  double first_ = 0;
  double n_ = 0, x_ = 0, y_ = 0, xx_ = 0, xy_ = 0;  ///< count and sums
};

}  // namespace tread
