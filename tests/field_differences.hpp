#pragma once
// Sizes and differences of fields. A value that is not finite is infinitely large: no bound holds for it.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "core/math/vec.hpp"

namespace tread::samples {

/// Infinity where the value is not finite.
inline double magnitude(double value) {
  return std::isfinite(value) ? std::abs(value) : std::numeric_limits<double>::infinity();
}
inline double magnitude(const Vec3& value) {
  return magnitude(norm(value));
}

/// Largest magnitude of the values. Bounds are shares of it, so the test fails where it is not finite.
template <class Values>
double largest(const Values& values) {
  double most = 0;
  for (const auto& value : values) most = std::max(most, magnitude(value));
  EXPECT_TRUE(std::isfinite(most)) << "a value is not finite";
  return most;
}

/// Largest difference of two fields; infinity where a value is not finite, and for fields of two sizes.
template <class A, class B>
double difference(const A& a, const B& b) {
  if (a.size() != b.size()) return std::numeric_limits<double>::infinity();
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, magnitude(a[i] - b[i]));
  return most;
}

/// Largest difference by the largest expected value, which is not zero.
template <class A, class B>
double relative_difference(const A& values, const B& expected) {
  return difference(values, expected) / largest(expected);
}

}  // namespace tread::samples
