#include "drivers/engine/features/watched_nodes.hpp"

#include <cstddef>
#include <numeric>

#include "core/index.hpp"

namespace tread {

namespace {

/// Number of tiles in the blocks before this one.
std::int64_t tiles_before(const Mesh& mesh, std::size_t block) {
  return std::accumulate(
      mesh.blocks.begin(), mesh.blocks.begin() + static_cast<std::ptrdiff_t>(block), std::int64_t{0},
      [](std::int64_t sum, const SweptBlock& before) { return sum + std::ssize(before.tiles); });
}

}  // namespace

WatchedNodes::Numbers::Numbers(std::int64_t all) : added(index(all), 0) {}

void WatchedNodes::Numbers::clear() {
  for (const std::int64_t number : listed) added[index(number)] = 0;
  listed.clear();
}

void WatchedNodes::Numbers::add(std::int64_t number) {
  if (added[index(number)] != 0) return;
  added[index(number)] = 1;
  listed.push_back(number);
}

WatchedNodes::WatchedNodes(const Mesh& mesh)
    : mesh_(&mesh), groups_(mesh.slots / kLanes), tiles_(tiles_before(mesh, mesh.blocks.size())) {}

void WatchedNodes::clear() {
  groups_.clear();
  tiles_.clear();
}

void WatchedNodes::add(std::int64_t slot) {
  groups_.add(slot / kLanes);
}

void WatchedNodes::add_element(int block, int quad, int station) {
  const SweptBlock& swept = mesh_->blocks[index(block)];
  tiles_.add(tiles_before(*mesh_, index(block)) + swept.tile_of_station[index(station)]);
  const int far = (station + 1) % swept.station_count();
  for (const int node : swept.section.quads[index(quad)])
    for (const int at : {station, far}) add(swept.base + swept.slot(node, at));
}

}  // namespace tread
