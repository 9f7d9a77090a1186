#pragma once
// Nodes that features read or write in a step, in whole groups of kLanes slots: contact surfaces, tied,
// fastened, driven and restrained ones. Elements alone act on all others.

#include <cstdint>
#include <vector>

#include "core/parallel/few_values.hpp"
#include "drivers/engine/model.hpp"

namespace tread {

inline constexpr int kGroupValues = 3 * kLanes;  ///< values of a group in a vector field

/// Slots of nodes on which connectors and loads act, or that the guided bore moves; in any order, some of
/// them more than once.
std::vector<std::int64_t> connected_slots(const Model& model);
/// Nodes of both contact surfaces; none without contact.
std::vector<std::int64_t> surface_slots(const Model& model);

/// Marks of the groups of a mesh that hold one of these slots.
std::vector<unsigned char> groups_of(const Mesh& mesh, const std::vector<std::int64_t>& slots);
/// True where a group has both marks.
bool meet(const std::vector<unsigned char>& a, const std::vector<unsigned char>& b);

/// Copies groups between a field and packed values: copy(place in the packed values, place in the field), of
/// kGroupValues each.
template <class Copy>
void for_groups(const std::vector<std::int64_t>& groups, std::int64_t first, std::int64_t last,
                const Copy& copy) {
  ranges_of_values(last - first, kGroupValues * (last - first), [&](std::int64_t from, std::int64_t to) {
    for (std::int64_t i = first + from; i < first + to; ++i)
      copy(i * kGroupValues, groups[static_cast<std::size_t>(i)] * kGroupValues);
  });
}

}  // namespace tread
