#include "drivers/bench/rank_parts.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace tread {

namespace {

/// Values that go from one rank to another in a step.
using Traffic = std::map<std::pair<int, int>, std::int64_t>;

void add_tiles(const Mesh& mesh, const RankCut& cut, const std::vector<TileWork>& work,
               std::vector<RankPart>& parts) {
  std::size_t tile = 0;
  for (const SweptBlock& block : mesh.blocks)
    for (const Tile& each : block.tiles) {
      RankPart& part = parts[index(cut.rank_of(tile))];
      part.elements += each.elements * std::ssize(block.section.quads);
      part.own += block.section.nodes();
      part.cost += work[tile++].cost;
    }
}

/// Groups that a rank gets whole, and those of which it moves one station.
void add_held(const RankCut& cut, const SharedGroups& groups, int rank, std::vector<RankPart>& parts,
              Traffic& traffic) {
  HeldGroups held = groups.held_by(rank);
  for (const std::int64_t group : groups.near()) held.moved[index(group)] = held.forced[index(group)] = 1;
  for (std::int64_t group = 0; group < std::ssize(held.forced); ++group) {
    const int owner = cut.owner(group);
    if (owner == rank) continue;
    if (held.moved[index(group)] != 0) ++parts[index(rank)].halo;
    if (held.forced[index(group)] != 0) traffic[{owner, rank}] += kGroupValues;
  }
  for (const Joint& joint : cut.joints()) {
    const auto marks = held.forced.begin() + joint.slot / kLanes;
    if (joint.far == rank)
      traffic[{joint.near, rank}] += 3 * joint.nodes;
    else if (joint.near != rank)
      traffic[{joint.near, rank}] += 3 * std::count(marks, marks + joint.nodes, 1);
    if (joint.near == rank) traffic[{joint.far, rank}] += 3 * joint.nodes;
  }
}

}  // namespace

std::vector<RankPart> rank_parts(const Model& model, const RankCut& cut, const std::vector<TileWork>& work,
                                 const SharedGroups& groups) {
  std::vector<RankPart> parts(index(cut.ranks()));
  add_tiles(model.mesh, cut, work, parts);
  Traffic traffic;
  for (int rank = 0; rank < cut.ranks(); ++rank) add_held(cut, groups, rank, parts, traffic);
  for (const auto& [ranks, values] : traffic) {
    if (values == 0) continue;
    RankPart& from = parts[index(ranks.first)];
    RankPart& to = parts[index(ranks.second)];
    from.sent += values;
    to.received += values;
    if (traffic.count({ranks.second, ranks.first}) == 0 || traffic[{ranks.second, ranks.first}] == 0)
      ++from.neighbours;
    ++to.neighbours;
  }
  return parts;
}

}  // namespace tread
