#include "drivers/bench/rank_parts.hpp"

#include <algorithm>
#include <vector>

#include "drivers/engine/ranks/rank_forces.hpp"
#include "drivers/engine/ranks/rank_shares.hpp"

namespace tread {

namespace {

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

}  // namespace

std::vector<RankPart> rank_parts(const Model& model, const RankCut& cut, const std::vector<TileWork>& work,
                                 const SharedGroups& groups) {
  std::vector<RankPart> parts(index(cut.ranks()));
  add_tiles(model.mesh, cut, work, parts);
  parts[kContactRank].contact = contact_cost(model);
  std::vector<std::vector<bool>> beside(parts.size(), std::vector<bool>(parts.size(), false));
  for (int to = 0; to < cut.ranks(); ++to) {
    const HeldGroups held = groups.held_by(to);
    parts[index(to)].halo = std::ssize(groups.halo_of(to, held));
    if (to != kContactRank) {
      const std::int64_t moved = std::count_if(groups.near().begin(), groups.near().end(),
                                               [&](auto group) { return held.moved[index(group)] != 0; });
      parts[index(to)].received_motion = kGroupValues * moved;
      parts[kContactRank].sent_motion += kGroupValues * moved;
    }
    for (int from = 0; from < cut.ranks(); ++from) {
      if (from == to) continue;
      for (const auto content : {RankMessage::Content::patch, RankMessage::Content::rest}) {
        RankMessage message(cut, from, to, held.forced, content);
        message.follow(groups.near());
        if (message.count == 0) continue;
        parts[index(from)].sent += message.count;
        parts[index(to)].received += message.count;
        beside[index(from)][index(to)] = beside[index(to)][index(from)] = true;
      }
    }
  }
  for (std::size_t rank = 0; rank < parts.size(); ++rank)
    parts[rank].neighbours = static_cast<int>(std::count(beside[rank].begin(), beside[rank].end(), true));
  return parts;
}

}  // namespace tread
