#pragma once
// Curves through measured values that do not overshoot them. [Fritsch and Carlson 1980]

#include <vector>

#include "core/math/body.hpp"

namespace tread {

/// Number of the piece of the increasing `x` that holds a place within the ends.
TREAD_BODY int piece_at(const double* x, int places, double at) {
  int first = 0;
  int last = places - 1;
  while (last - first > 1) {
    const int middle = (first + last) / 2;
    (at < x[middle] ? last : first) = middle;
  }
  return first;
}

/// The curve as plain data, on a device too.
struct MonotoneCubicView {
  const double* x = nullptr;
  const double* y = nullptr;
  const double* slope = nullptr;
  int places = 0;

  /// Value at a place within the ends.
  TREAD_BODY double value(double at) const {
    const int i = piece_at(x, places, at);
    const double h = x[i + 1] - x[i];
    const double s = (at - x[i]) / h;
    const double r = 1 - s;
    return y[i] * r * r * (1 + 2 * s) + y[i + 1] * s * s * (1 + 2 * r) +
           h * s * r * (slope[i] * r - slope[i + 1] * s);
  }

  /// Derivative at a place within the ends.
  TREAD_BODY double derivative(double at) const {
    const int i = piece_at(x, places, at);
    const double h = x[i + 1] - x[i];
    const double s = (at - x[i]) / h;
    const double r = 1 - s;
    return 6 * s * r * (y[i + 1] - y[i]) / h + slope[i] * r * (1 - 3 * s) + slope[i + 1] * s * (3 * s - 2);
  }
};

/// Slopes of a curve at both ends.
enum class CurveEnds { flat, straight };

/// Piecewise cubic through `y` over the increasing `x`, with a continuous first derivative. Straight ends
/// have the slope of their piece's secant.
class MonotoneCubic {
 public:
  MonotoneCubic() = default;
  MonotoneCubic(std::vector<double> x, std::vector<double> y, CurveEnds ends = CurveEnds::flat);

  /// Value at a place within the ends.
  double value(double x) const { return view().value(x); }
  /// Derivative at a place within the ends.
  double slope(double x) const { return view().derivative(x); }

  MonotoneCubicView view() const {
    return {x_.data(), y_.data(), slope_.data(), static_cast<int>(x_.size())};
  }
  bool empty() const { return x_.empty(); }
  double first() const { return x_.front(); }
  double last() const { return x_.back(); }
  /// Upper bound of the derivative's size.
  double steepest() const { return steepest_; }

 private:
  std::vector<double> x_, y_, slope_;
  double steepest_ = 0;
};

}  // namespace tread
