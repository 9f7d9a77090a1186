#pragma once
// Registers made of the lanes of others. Internal linkage keeps the versions of the instruction sets apart.

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "kernels/lanes/registers.hpp"
#include "kernels/update/node_motion_body.hpp"

namespace tread {
namespace {

/// (a[1], ..., a[last], b[0])
template <class V>
TREAD_INLINE V shift_down(const V& a, const V& b) {
  if constexpr (sizeof a / sizeof a[0] == 16)
    return __builtin_shufflevector(a, b, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16);
  if constexpr (sizeof a / sizeof a[0] == 8) return __builtin_shufflevector(a, b, 1, 2, 3, 4, 5, 6, 7, 8);
  if constexpr (sizeof a / sizeof a[0] == 4) return __builtin_shufflevector(a, b, 1, 2, 3, 4);
  if constexpr (sizeof a / sizeof a[0] == 2) return __builtin_shufflevector(a, b, 1, 2);
}

/// (a[last], b[0], ..., b[last - 1])
template <class V>
TREAD_INLINE V shift_up(const V& a, const V& b) {
  if constexpr (sizeof a / sizeof a[0] == 16)
    return __builtin_shufflevector(a, b, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30);
  if constexpr (sizeof a / sizeof a[0] == 8)
    return __builtin_shufflevector(a, b, 7, 8, 9, 10, 11, 12, 13, 14);
  if constexpr (sizeof a / sizeof a[0] == 4) return __builtin_shufflevector(a, b, 3, 4, 5, 6);
  if constexpr (sizeof a / sizeof a[0] == 2) return __builtin_shufflevector(a, b, 1, 2);
}

/// Both side by side.
template <class V>
TREAD_INLINE auto abreast(const V& a, const V& b) {
  if constexpr (sizeof a / sizeof a[0] == 8)
    return __builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
  if constexpr (sizeof a / sizeof a[0] == 4) return __builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7);
  if constexpr (sizeof a / sizeof a[0] == 2) return __builtin_shufflevector(a, b, 0, 1, 2, 3);
}

/// `values` with another one in a lane; as they are where they have no such lane.
template <class V, class Real>
TREAD_INLINE V with_lane(const V& values, int lane, Real value) {
  using Index = std::conditional_t<sizeof(Real) == 8, std::int64_t, std::int32_t>;
  typename Vector<Index, sizeof(V) / sizeof(Real)>::type lanes;
  for (std::size_t l = 0; l < sizeof(V) / sizeof(Real); ++l) lanes[l] = static_cast<Index>(l);
  return lanes == static_cast<Index>(lane) ? V{} + value : values;
}

/// Differences of `lanes` values in U, rounded to Real.
template <class Real, int lanes, class U>
TREAD_INLINE auto rounded_difference(const U* a, const U* b) {
  if constexpr (lanes > Lanes<U>::kWidth) {
    constexpr int kHalf = lanes / 2;
    return abreast(rounded_difference<Real, kHalf>(a, b),
                   rounded_difference<Real, kHalf>(a + kHalf, b + kHalf));
  } else {
    using V = typename Vector<U, lanes>::type;
    return converted<typename Vector<Real, lanes>::type>(load<V>(a) - load<V>(b));
  }
}

}  // namespace
}  // namespace tread
