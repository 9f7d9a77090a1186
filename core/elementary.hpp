#pragma once
// Elementary functions of a number, in constant expressions too, and of a vector of lanes. At run time and on
// a device they are those of the standard library; constant evaluation agrees with them to 1e-14 for
// exponents up to 5.3.

#include <cmath>
#include <type_traits>

#include "core/inline.hpp"

namespace tread {

/// Square root of a number that is not negative, or of each lane.
template <class V>
TREAD_INLINE V square_root(const V& value) {
  if constexpr (std::is_floating_point_v<V>) {
    if (!std::is_constant_evaluated()) return std::sqrt(value);
    if (value <= 0) return 0;
    V root = value < 1 ? 1 : value;  // Newton's method falls to the root from above
    for (V next = (root + value / root) / 2; next < root; next = (root + value / root) / 2) root = next;
    return root;
  } else if constexpr (std::is_class_v<V>) {
    return sqrt(value);
  } else {
    V root{};
    for (unsigned lane = 0; lane < sizeof(V) / sizeof(value[0]); ++lane) root[lane] = std::sqrt(value[lane]);
    return root;
  }
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
