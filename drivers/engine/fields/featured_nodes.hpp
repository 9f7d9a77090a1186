#pragma once
// Nodes that features read or write in a step, in whole groups of kLanes slots: contact surfaces, tied,
// fastened and driven ones. Elements alone act on all others.

#include <cstdint>
#include <vector>

#include "core/parallel/few_values.hpp"
#include "drivers/engine/model/model.hpp"
#include "kernels/contact/contact_search.hpp"

namespace tread {

inline constexpr int kGroupValues = 3 * kLanes;  ///< values of a group in a vector field

/// Marks by group.
using GroupMarks = std::vector<unsigned char>;

/// Groups that hold one of these slots.
GroupMarks groups_of(const Mesh& mesh, const std::vector<std::int64_t>& slots);
/// Groups of nodes on which connectors and loads act, or that the guided bore moves.
GroupMarks connected_groups(const Model& model);
/// Those of both contact surfaces; none without contact.
GroupMarks surface_groups(const Model& model);
/// Those of tied nodes.
GroupMarks tied_groups(const Model& model);

/// Calls visit(group) for the groups of a part of a running surface, tile by tile.
template <class Visit>
void for_surface_groups(const SweptBlock& block, const SurfaceProfile& profile, const SurfacePart& part,
                        const Visit& visit) {
  const TileSpan tiles = tiles_of(block, part);
  const auto all = static_cast<int>(block.tiles.size());
  for (int i = 0; i < tiles.count; ++i)
    for (int ordinal = part.first_node; ordinal < part.last_node; ++ordinal)
      visit(block.base / kLanes + std::int64_t{(tiles.first + i) % all} * block.section.nodes() +
            profile.node(ordinal));
}

/// True where a group has both marks.
bool meet(const GroupMarks& a, const GroupMarks& b);
void add_marks(GroupMarks& marks, const GroupMarks& more);

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
