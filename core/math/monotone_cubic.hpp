#pragma once
// Curves through measured values that do not overshoot them. [Fritsch and Carlson 1980]

#include <vector>

namespace tread {

/// Piecewise cubic through `y` over the increasing `x`, with a continuous first derivative; flat at both
/// ends.
class MonotoneCubic {
 public:
  MonotoneCubic() = default;
  MonotoneCubic(std::vector<double> x, std::vector<double> y);

  /// Value at a place within the ends.
  double value(double x) const;
  /// Derivative at a place within the ends.
  double slope(double x) const;

  bool empty() const { return x_.empty(); }
  double first() const { return x_.front(); }
  double last() const { return x_.back(); }
  /// Upper bound of the derivative's size.
  double steepest() const { return steepest_; }

 private:
  std::size_t piece(double x) const;

  std::vector<double> x_, y_, slope_;
  double steepest_ = 0;
};

}  // namespace tread
