#include "kernels/device/device_ties.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

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

/// Calls visit(number of the item, linked node, its slot of lane 0, tile) for the nodes of a block that have
/// a link and a tied slot, which `slots` lists in ascending order.
template <class Visit>
void for_each_node(const SweptBlock& block, const TieSums& sums, const std::vector<std::int64_t>& slots,
                   const Visit& visit) {
  for (std::size_t i = 0; i < sums.items.size(); ++i) {
    const TieSums::Item& item = sums.items[i];
    const std::int64_t first_slot = item.own / 3 - block.base;
    if (first_slot < 0 || first_slot >= block.slots()) continue;
    const Tile& tile = block.tiles[index(first_slot / kLanes / block.section.nodes())];
    for (int n = 0; n < item.node_count; ++n) {
      const LinkedNode& of = sums.nodes[item.first_node + index(n)];
      const std::int64_t slot = item.own / 3 + std::int64_t{of.node} * kLanes;
      const auto tied = std::lower_bound(slots.begin(), slots.end(), slot);
      if (tied != slots.end() && *tied < slot + kLanes) visit(i, of, slot, tile);
    }
  }
}

/// Shares of an item's tile, as numbers of its first and of the one after its last.
std::pair<int, int> shares_of(const TieSums::Item& item) {
  const auto first = static_cast<int>(item.first_station);
  return {first, first + item.station_count};
}

/// The sums of all items, one after another; `first`: by item, the number of its first one.
std::vector<StationSum> station_sums(const TieSums& sums, std::vector<int>& first) {
  std::vector<StationSum> all;
  for (const TieSums::Item& item : sums.items) {
    first.push_back(static_cast<int>(all.size()));
    const auto [first_share, last_share] = shares_of(item);
    for (int i = 0; i < item.other_count; ++i) {
      const int node = sums.others[item.first_other + index(i)];
      all.push_back({std::int64_t{3 * kLanes} * node, first_share, last_share});
    }
  }
  return all;
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
  const TieSums& to_secondary = ties.to_secondary();
  const TieSums& to_primary = ties.to_primary();
  std::vector<int> first_sum;
  const std::vector<StationSum> sums = station_sums(to_primary, first_sum);
  std::vector<TiedNode> secondary;
  std::int64_t primary = 0;
  for (const SweptBlock& block : mesh.blocks) {
    for_each_node(block, to_secondary, ties.secondary_slots(),
                  [&](std::size_t item, const LinkedNode& node, std::int64_t slot, const Tile& /*tile*/) {
                    const auto [first_share, last_share] = shares_of(to_secondary.items[item]);
                    secondary.push_back({3 * slot, node.first, node.last, first_share, last_share});
                  });
    std::vector<PrimaryNode> nodes;
    for_each_node(block, to_primary, ties.primary_slots(),
                  [&](std::size_t item, const LinkedNode& node, std::int64_t slot, const Tile& tile) {
                    nodes.push_back({3 * slot, tile.first_station, tile.stations, node.node, node.first,
                                     node.last, first_sum[item]});
                  });
    primary += std::ssize(nodes);
    primary_.push_back(copy(device, nodes));
  }
  if (std::ssize(secondary) != groups_in(ties.secondary_slots()) ||
      primary != groups_in(ties.primary_slots()))
    throw std::logic_error("a tied node takes no sum, or several");
  secondary_ = copy(device, secondary);
  secondary_links_ = copy(device, links_of(to_secondary));
  secondary_shares_ = copy(device, to_secondary.stations);
  sums_ = copy(device, sums);
  sum_shares_ = copy(device, to_primary.stations);
  values_ = DeviceArray<double>(device, 3 * kLanes * sums.size());
  primary_links_ = copy(device, to_primary.links);
}

}  // namespace tread
