#pragma once
// Functions of a number or of a vector of lanes.

#include <cmath>
#include <type_traits>

#include "core/inline.hpp"

namespace tread {

/// Square root, by lanes.
template <class V>
TREAD_INLINE V square_root(const V& value) {
  if constexpr (std::is_class_v<V> || std::is_arithmetic_v<V>) {
    using std::sqrt;
    return sqrt(value);
  } else {
    V root{};
    for (unsigned lane = 0; lane < sizeof(V) / sizeof(value[0]); ++lane) root[lane] = std::sqrt(value[lane]);
    return root;
  }
}

}  // namespace tread
