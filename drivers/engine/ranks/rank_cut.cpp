#include "drivers/engine/ranks/rank_cut.hpp"

#include <fmt/core.h>
#include <metis.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "core/error.hpp"

namespace tread {

namespace {

/// Pieces of work, with the number of nodal forces that go between two of them if they part.
struct WorkGraph {
  std::vector<idx_t> cost;
  std::map<std::pair<idx_t, idx_t>, idx_t> links;  ///< both ways

  void link(idx_t a, idx_t b, std::int64_t forces) {
    if (a == b) return;
    for (const auto& pair : {std::pair(a, b), std::pair(b, a)}) links[pair] += static_cast<idx_t>(forces);
  }
};

/// Part of each piece, of these shares of the cost.
std::vector<idx_t> parts_of(WorkGraph graph, std::vector<real_t> shares) {
  const auto parts = static_cast<int>(shares.size());
  auto pieces = static_cast<idx_t>(graph.cost.size());
  std::vector<idx_t> part(graph.cost.size(), 0);
  if (pieces <= parts) {
    for (idx_t piece = 0; piece < pieces; ++piece) part[index(piece)] = piece;
    return part;
  }
  if (parts == 1) return part;
  std::vector<idx_t> first(graph.cost.size() + 1, 0);
  std::vector<idx_t> other, weight;
  for (const auto& [pair, forces] : graph.links) {
    ++first[index(pair.first) + 1];
    other.push_back(pair.second);
    weight.push_back(forces);
  }
  for (std::size_t piece = 0; piece < graph.cost.size(); ++piece) first[piece + 1] += first[piece];
  std::vector<idx_t> options(METIS_NOPTIONS);
  METIS_SetDefaultOptions(options.data());
  options[METIS_OPTION_SEED] = 1;
  idx_t constraints = 1, cut = 0, wanted = parts;
  const int outcome = METIS_PartGraphRecursive(&pieces, &constraints, first.data(), other.data(),
                                               graph.cost.data(), nullptr, weight.data(), &wanted,
                                               shares.data(), nullptr, options.data(), &cut, part.data());
  if (outcome != METIS_OK)
    throw ResourceError(
        fmt::format("METIS cannot cut {} pieces of the mesh for {} ranks (its code: {}); start "
                    "fewer ranks",
                    pieces, parts, outcome));
  return part;
}

/// `first`: first_groups().
std::size_t tile_of(const std::vector<std::int64_t>& first, std::int64_t slot) {
  const auto at = std::upper_bound(first.begin(), first.end(), slot / kLanes);
  return index(at - first.begin()) - 1;
}

/// Adds a tile behind those of the stretches.
void append(std::vector<TileStretch>& stretches, std::size_t tile) {
  if (stretches.empty() || stretches.back().last != tile) stretches.push_back({tile, tile});
  stretches.back().last = tile + 1;
}

/// Calls visit(tile, tile of the station behind its last element, nodes there) for tiles with elements.
template <class Visit>
void for_each_link(const Mesh& mesh, const Visit& visit) {
  std::size_t before = 0;
  for (const SweptBlock& block : mesh.blocks) {
    for (std::size_t tile = 0; tile < block.tiles.size(); ++tile)
      if (block.tiles[tile].elements > 0)
        visit(before + tile, before + index(block.tiles[tile].next), std::int64_t{block.section.nodes()});
    before += block.tiles.size();
  }
}

}  // namespace

std::vector<std::int64_t> first_groups(const Mesh& mesh) {
  std::vector<std::int64_t> first;
  for (const SweptBlock& block : mesh.blocks)
    for (std::int64_t tile = 0; tile < std::ssize(block.tiles); ++tile)
      first.push_back(block.base / kLanes + tile * block.section.nodes());
  first.push_back(mesh.slots / kLanes);
  return first;
}

void add_ties(const Model& model, std::vector<TileWork>& work) {
  if (!model.ties) return;
  // Both directions of a node's tie, and its late motion, take as long as half an extruded element.
  constexpr std::int64_t kTiedNode = 2;
  const std::vector<std::int64_t> first = first_groups(model.mesh);
  for (const std::int64_t slot : model.ties->secondary_slots()) work[tile_of(first, slot)].cost += kTiedNode;
}

RankCut::RankCut(const Model& model, const std::vector<TileWork>& work, std::span<const double> shares,
                 Borders borders)
    : rank_(work.size()),
      owner_(index(model.mesh.slots / kLanes)),
      first_group_(first_groups(model.mesh)),
      stretches_(shares.size()),
      halos_(shares.size()),
      before_(shares.size()) {
  deal_out(model, work, shares);
  for (std::size_t tile = 0; tile < rank_.size(); ++tile) {
    std::fill(owner_.begin() + first_group_[tile], owner_.begin() + first_group_[tile + 1], rank_[tile]);
    append(stretches_[index(rank_[tile])], tile);
  }
  if (borders == Borders::joints)
    join_tiles(model.mesh);
  else
    find_halos(model.mesh);
}

std::vector<std::vector<TileStretch>> RankCut::by_rank(const std::vector<std::int64_t>& tiles) const {
  std::vector<std::vector<TileStretch>> stretches(stretches_.size());
  for (const std::int64_t tile : tiles) append(stretches[index(rank_of(index(tile)))], index(tile));
  return stretches;
}

/// Tiles that the loop takes together are one piece. Pieces are linked along the sweep and by ties.
void RankCut::deal_out(const Model& model, const std::vector<TileWork>& work,
                       std::span<const double> shares) {
  WorkGraph graph;
  std::vector<idx_t> piece(work.size());
  for (std::size_t tile = 0; tile < work.size(); ++tile) {
    if (tile == 0 || !work[tile - 1].with_next) graph.cost.push_back(0);
    piece[tile] = static_cast<idx_t>(graph.cost.size()) - 1;
    graph.cost.back() += static_cast<idx_t>(work[tile].cost);
  }
  for_each_link(model.mesh, [&](std::size_t tile, std::size_t next, std::int64_t nodes) {
    graph.link(piece[tile], piece[next], 2 * nodes);
  });
  const auto piece_of = [&](std::int64_t slot) { return piece[tile_of(first_group_, slot)]; };
  if (model.ties)
    model.ties->for_each_pair([&](std::int64_t secondary, std::int64_t primary) {
      graph.link(piece_of(secondary), piece_of(primary), 1);
    });
  const std::vector<idx_t> part = parts_of(std::move(graph), {shares.begin(), shares.end()});
  for (std::size_t tile = 0; tile < work.size(); ++tile)
    rank_[tile] = static_cast<int>(part[index(piece[tile])]);
}

void RankCut::join_tiles(const Mesh& mesh) {
  for_each_link(mesh, [&](std::size_t tile, std::size_t next, std::int64_t nodes) {
    if (rank_[tile] != rank_[next])
      joints_.push_back({rank_[tile], rank_[next], tile, first_group_[next] * kLanes, nodes});
  });
}

void RankCut::find_halos(const Mesh& mesh) {
  std::vector<std::set<std::size_t>> tiles(halos_.size());
  for_each_link(mesh, [&](std::size_t tile, std::size_t next, std::int64_t /*nodes*/) {
    if (rank_[tile] == rank_[next]) return;
    tiles[index(rank_[tile])].insert(next);
    tiles[index(rank_[next])].insert(tile);
    before_[index(rank_[next])].push_back(tile);
  });
  for (std::size_t rank = 0; rank < halos_.size(); ++rank)
    for (const std::size_t tile : tiles[rank]) append(halos_[rank], tile);
}

}  // namespace tread
