#include "core/math/monotone_cubic.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace tread {

MonotoneCubic::MonotoneCubic(std::vector<double> x, std::vector<double> y, CurveEnds ends)
    : x_(std::move(x)), y_(std::move(y)) {
  const std::size_t n = x_.size();
  slope_.assign(n, 0.0);
  const auto secant = [&](std::size_t i) { return (y_[i + 1] - y_[i]) / (x_[i + 1] - x_[i]); };
  if (ends == CurveEnds::straight) {
    slope_.front() = secant(0);
    slope_.back() = secant(n - 2);
  }
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double left = secant(i - 1);
    const double right = secant(i);
    if (left * right > 0) slope_[i] = 2 * left * right / (left + right);
  }
  // A harmonic mean is at most twice the smaller secant; between its ends a piece is flatter than 1.5
  // secants.
  for (std::size_t i = 1; i < n; ++i) steepest_ = std::max(steepest_, 2 * std::abs(secant(i - 1)));
}

}  // namespace tread
