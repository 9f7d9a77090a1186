#pragma once
// Halving of nodes or elements of a mesh across the longest side of their box.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "core/math/vec.hpp"

namespace tread {

/// The longest side of the box of items at `at(item)`.
struct LongestSide {
  int axis = 0;
  double length = 0;
};
template <class At>
LongestSide longest_side(std::span<const std::int32_t> items, const At& at) {
  Vec3 low = at(items[0]), high = low;
  for (const std::int32_t item : items)
    for (int c = 0; c < 3; ++c) {
      low[c] = std::min(low[c], at(item)[c]);
      high[c] = std::max(high[c], at(item)[c]);
    }
  LongestSide side{0, high[0] - low[0]};
  for (int c = 1; c < 3; ++c)
    if (high[c] - low[c] > side.length) side = {c, high[c] - low[c]};
  return side;
}

/// Moves the `first` items that come first along an axis before the others.
template <class At>
void part_along(std::span<std::int32_t> items, std::size_t first, int axis, const At& at) {
  std::nth_element(
      items.begin(), items.begin() + static_cast<std::ptrdiff_t>(first), items.end(),
      [&](std::int32_t a, std::int32_t b) { return std::pair(at(a)[axis], a) < std::pair(at(b)[axis], b); });
}

}  // namespace tread
