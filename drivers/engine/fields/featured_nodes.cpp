#include "drivers/engine/fields/featured_nodes.hpp"

#include <algorithm>
#include <functional>

#include "core/index.hpp"
#include "kernels/contact/contact_surface.hpp"

namespace tread {

namespace {

/// Nodes of a block's running surface.
void add_surface(const SweptBlock& block, std::vector<std::int64_t>& slots) {
  const SurfaceProfile profile(block.section);
  for (int ordinal = 0; ordinal <= profile.edges(); ++ordinal)
    for (int station = 0; station < block.station_count(); ++station)
      slots.push_back(block.base + block.slot(profile.node(ordinal), station));
}

void add_nodes_of(const std::vector<std::int64_t>& unknowns, std::vector<std::int64_t>& slots) {
  for (const std::int64_t unknown : unknowns)
    slots.push_back(unknown / kGroupValues * kLanes + unknown % kLanes);
}

}  // namespace

GroupMarks groups_of(const Mesh& mesh, const std::vector<std::int64_t>& slots) {
  GroupMarks marks(index(mesh.slots / kLanes), 0);
  for (const std::int64_t slot : slots) marks[index(slot / kLanes)] = 1;
  return marks;
}

GroupMarks connected_groups(const Model& model) {
  std::vector<std::int64_t> slots = model.connected_slots();
  if (model.guide) add_nodes_of(model.guide->unknowns(), slots);
  return groups_of(model.mesh, slots);
}

GroupMarks surface_groups(const Model& model) {
  std::vector<std::int64_t> slots;
  if (model.contact)
    for (const int block : {model.contact->options().rail_block, model.contact->options().wheel_block})
      add_surface(model.mesh.blocks[index(block)], slots);
  return groups_of(model.mesh, slots);
}

GroupMarks tied_groups(const Model& model) {
  if (!model.ties) return groups_of(model.mesh, {});
  GroupMarks marks = groups_of(model.mesh, model.ties->secondary_slots());
  add_marks(marks, groups_of(model.mesh, model.ties->primary_slots()));
  return marks;
}

bool meet(const GroupMarks& a, const GroupMarks& b) {
  for (std::size_t group = 0; group < a.size(); ++group)
    if (a[group] != 0 && b[group] != 0) return true;
  return false;
}

void add_marks(GroupMarks& marks, const GroupMarks& more) {
  std::transform(marks.begin(), marks.end(), more.begin(), marks.begin(), std::bit_or<>());
}

}  // namespace tread
