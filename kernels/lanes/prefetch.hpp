#pragma once
// Fetches values ahead of their use. Inlined always: in a function of its own, which changes nothing, GCC
// leaves it out.

#include "core/inline.hpp"
#include "core/mesh/swept_block.hpp"

namespace tread {

/// Fetches the components from `first` on of a node of a tile into the cache.
template <int to_write, int first = 0, class Value>
TREAD_INLINE void prefetch_vector(const Value* at) {
  constexpr int kLine = 64 / static_cast<int>(sizeof(Value));
  for (int value = first * kLanes / kLine * kLine; value < 3 * kLanes; value += kLine)
    __builtin_prefetch(at + value, to_write);
}

/// Fetches `count` values that lie one behind another.
template <class Value>
TREAD_INLINE void prefetch_row(const Value* at, int count) {
  for (int value = 0; value < count; value += 64 / static_cast<int>(sizeof(Value)))
    __builtin_prefetch(at + value);
}

}  // namespace tread
