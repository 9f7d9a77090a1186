#include "drivers/engine/features/watched_nodes.hpp"

#include "core/index.hpp"

namespace tread {

WatchedNodes::WatchedNodes(const Mesh& mesh) : mesh_(&mesh), added_(index(mesh.slots / kLanes), 0) {}

void WatchedNodes::clear() {
  for (const std::int64_t group : groups_) added_[index(group)] = 0;
  groups_.clear();
}

void WatchedNodes::add(std::int64_t slot) {
  const std::int64_t group = slot / kLanes;
  if (added_[index(group)] != 0) return;
  added_[index(group)] = 1;
  groups_.push_back(group);
}

void WatchedNodes::add_element(int block, int quad, int station) {
  const SweptBlock& swept = mesh_->blocks[index(block)];
  const int far = (station + 1) % swept.station_count();
  for (const int node : swept.section.quads[index(quad)])
    for (const int at : {station, far}) add(swept.base + swept.slot(node, at));
}

}  // namespace tread
