#include "kernels/device/device_ties.hpp"

#include <algorithm>
#include <stdexcept>

#include "core/index.hpp"

namespace tread {

namespace {

/// Links to section nodes, not to places in the list of a line.
std::vector<NodeLink> links_of(const TieSums& sums) {
  std::vector<NodeLink> links = sums.links;
  for (const TieSums::Item& item : sums.items)
    for (int n = 0; n < item.node_count; ++n) {
      const LinkedNode& node = sums.nodes[item.first_node + index(n)];
      for (int l = node.first; l < node.last; ++l)
        links[index(l)].other = sums.others[item.first_other + index(sums.links[index(l)].other)];
    }
  return links;
}

/// The nodes of a block that have a link and a tied slot, which `slots` lists in ascending order.
std::vector<TiedNode> nodes_of(const SweptBlock& block, const TieSums& sums,
                               const std::vector<std::int64_t>& slots) {
  std::vector<TiedNode> nodes;
  for (const TieSums::Item& item : sums.items) {
    const std::int64_t first_slot = item.own / 3 - block.base;
    if (first_slot < 0 || first_slot >= block.slots()) continue;
    const Tile& tile = block.tiles[index(first_slot / kLanes / block.section.nodes())];
    for (int n = 0; n < item.node_count; ++n) {
      const LinkedNode& of = sums.nodes[item.first_node + index(n)];
      const std::int64_t slot = item.own / 3 + std::int64_t{of.node} * kLanes;
      const auto tied = std::lower_bound(slots.begin(), slots.end(), slot);
      if (tied == slots.end() || *tied >= slot + kLanes) continue;
      const auto first_share = static_cast<int>(item.first_station);
      nodes.push_back({3 * slot, tile.first_station, tile.stations, of.node, of.first, of.last, first_share,
                       first_share + item.station_count});
    }
  }
  return nodes;
}

std::int64_t groups_in(const std::vector<std::int64_t>& slots) {
  std::int64_t groups = 0;
  std::int64_t last = -1;
  for (const std::int64_t slot : slots)
    if (slot / kLanes != last) {
      last = slot / kLanes;
      ++groups;
    }
  return groups;
}

template <class T>
DeviceArray<T> copy(Device& device, const std::vector<T>& values) {
  return {device, std::span<const T>(values)};
}

}  // namespace

DeviceTies::DeviceTies(Device& device, const Mesh& mesh, const Ties& ties) {
  std::vector<TiedNode> secondary;
  std::int64_t primary = 0;
  for (const SweptBlock& block : mesh.blocks) {
    const std::vector<TiedNode> own = nodes_of(block, ties.to_secondary(), ties.secondary_slots());
    secondary.insert(secondary.end(), own.begin(), own.end());
    Nodes& of_block = primary_.emplace_back();
    const std::vector<TiedNode> nodes = nodes_of(block, ties.to_primary(), ties.primary_slots());
    primary += std::ssize(nodes);
    if (nodes.empty()) continue;
    of_block.node = copy(device, nodes);
    of_block.links = copy(device, links_of(ties.to_primary()));
    of_block.shares = copy(device, ties.to_primary().stations);
  }
  if (std::ssize(secondary) != groups_in(ties.secondary_slots()) ||
      primary != groups_in(ties.primary_slots()))
    throw std::logic_error("a tied node takes no sum, or several");
  secondary_.node = copy(device, secondary);
  secondary_.links = copy(device, links_of(ties.to_secondary()));
  secondary_.shares = copy(device, ties.to_secondary().stations);
}

}  // namespace tread
