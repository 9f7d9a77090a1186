#pragma once
// The raised cosine by which loads begin and end smoothly along a surface.

#include <cmath>
#include <numbers>

namespace tread {

/// Raised cosine over -half ... half with the integral 1. [1 / unit of x]
inline double raised_cosine(double x, double half) {
  if (std::abs(x) >= half) return 0;
  const double c = std::cos(0.5 * std::numbers::pi * x / half);
  return c * c / half;
}

/// Its cosine coefficient at a wave number, or at a number of waves where `half` is an angle; 1 at 0.
inline double raised_cosine_coefficient(double wave_number, double half) {
  const double a = wave_number * half;
  if (a == 0) return 1;
  const double pole = 1 - std::pow(a / std::numbers::pi, 2);
  return std::abs(pole) < 1e-9 ? 0.5 : std::sin(a) / a / pole;
}

}  // namespace tread
