#pragma once
// Sums of a contact point over its nodes, and its forces on them.

#include <cstddef>

#include "core/math/vec.hpp"

namespace tread {

/// Three Cartesian components and a zero.
struct alignas(32) PatchVector {
  double value[4] = {};
};

/// Nodes that carry a point of a surface: 4 stations x 4 nodes across.
inline constexpr std::size_t kSupport = 16;

inline constexpr int kLinkedNodes = 2 * kSupport;

/// The nodes of a contact point, of the wheel and of the rail.
struct PatchLink {
  int node[kLinkedNodes];
  double weight[kLinkedNodes];
};

/// start + the weighted sum over the link's nodes.
using PatchTake = Vec3 (*)(const PatchLink& link, const PatchVector* nodes, const PatchVector& start);

/// Adds weight * value to each of the link's nodes.
using PatchGive = void (*)(const PatchLink& link, const Vec3& value, PatchVector* nodes);

}  // namespace tread
