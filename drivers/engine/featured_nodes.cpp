#include "drivers/engine/featured_nodes.hpp"

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

std::vector<std::int64_t> connected_slots(const Model& model) {
  std::vector<std::int64_t> slots = model.connected_slots();
  if (model.guide) add_nodes_of(model.guide->unknowns(), slots);
  return slots;
}

std::vector<std::int64_t> surface_slots(const Model& model) {
  std::vector<std::int64_t> slots;
  if (!model.contact) return slots;
  const ContactOptions& contact = model.contact->options();
  for (const int block : {contact.rail_block, contact.wheel_block})
    add_surface(model.mesh.blocks[index(block)], slots);
  return slots;
}

std::vector<unsigned char> groups_of(const Mesh& mesh, const std::vector<std::int64_t>& slots) {
  std::vector<unsigned char> marks(index(mesh.slots / kLanes), 0);
  for (const std::int64_t slot : slots) marks[index(slot / kLanes)] = 1;
  return marks;
}

bool meet(const std::vector<unsigned char>& a, const std::vector<unsigned char>& b) {
  for (std::size_t group = 0; group < a.size(); ++group)
    if (a[group] != 0 && b[group] != 0) return true;
  return false;
}

}  // namespace tread
