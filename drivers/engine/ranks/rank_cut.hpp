#pragma once
// The tiles of a model's mesh, dealt out among ranks: like cost for each, few nodes between them.
// [docs/records/ranks.md]

#include <cstdint>
#include <span>
#include <vector>

#include "core/index.hpp"
#include "core/mesh/tile_sums.hpp"
#include "drivers/engine/model/model.hpp"

namespace tread {

/// Where the last element of a rank's tile ends at the first station of another rank's tile. Both ranks move
/// the nodes of that station.
struct Joint {
  int near = 0, far = 0;  ///< ranks of the element and of the station
  std::size_t tile = 0;   ///< of the element
  std::int64_t slot = 0;  ///< of section node 0 at the station
  std::int64_t nodes = 0;
};

/// Nodes beside a rank's tiles whose motion it needs.
enum class Borders {
  joints,  ///< stations of Joints: each element is one rank's
  halos,   ///< all of the tiles before and behind: forces are complete on each rank's own nodes
};

/// The rank that searches for contact and solves it.
inline constexpr int kContactRank = 0;

/// A tile as a piece of work.
struct TileWork {
  std::int64_t cost = 0;
  bool with_next = false;  ///< the loop takes the tile behind it along
};

/// First group of each tile, in the order of blocks and tiles, and the number of groups.
std::vector<std::int64_t> first_groups(const Mesh& mesh);

/// Adds the work of tied nodes.
void add_ties(const Model& model, std::vector<TileWork>& work);

/// By tile. `internal`: BasicInternalForce of the model's mesh.
template <class Internal>
std::vector<TileWork> tile_work(const Model& model, const Internal& internal) {
  std::vector<TileWork> work;
  for (const SweptBlock& block : model.mesh.blocks)
    for (std::size_t tile = 0; tile < block.tiles.size(); ++tile)
      work.push_back({internal.cost(work.size()), internal.joined(work.size())});
  add_ties(model, work);
  return work;
}

class RankCut {
 public:
  /// `work`: tile_work(); `shares`: of it, by rank, which add up to 1. Ranks are left without tiles where
  /// there are few.
  RankCut(const Model& model, const std::vector<TileWork>& work, std::span<const double> shares,
          Borders borders = Borders::joints);

  int ranks() const { return static_cast<int>(stretches_.size()); }
  std::size_t tiles() const { return rank_.size(); }
  int rank_of(std::size_t tile) const { return rank_[tile]; }
  int owner(std::int64_t group) const { return owner_[index(group)]; }
  const std::vector<TileStretch>& stretches(int rank) const { return stretches_[index(rank)]; }
  /// Some of the tiles, by rank.
  std::vector<std::vector<TileStretch>> by_rank(const std::vector<std::int64_t>& tiles) const;
  /// None with halos.
  const std::vector<Joint>& joints() const { return joints_; }
  /// Tiles of others before and behind a rank's own; none with joints.
  const std::vector<TileStretch>& halo(int rank) const { return halos_[index(rank)]; }
  /// Tiles of others whose last element ends in a tile of the rank, among those.
  const std::vector<std::size_t>& before(int rank) const { return before_[index(rank)]; }
  /// First group of a tile, and after the last one the number of groups.
  std::int64_t first_group(std::size_t tile) const { return first_group_[tile]; }
  /// Calls visit(first, last) for the groups [first, last) of each stretch.
  template <class Visit>
  void for_groups(const std::vector<TileStretch>& stretches, const Visit& visit) const {
    for (const TileStretch& stretch : stretches) visit(first_group(stretch.first), first_group(stretch.last));
  }

 private:
  void deal_out(const Model& model, const std::vector<TileWork>& work, std::span<const double> shares);
  void join_tiles(const Mesh& mesh);
  void find_halos(const Mesh& mesh);

  std::vector<int> rank_;   ///< by tile
  std::vector<int> owner_;  ///< by group
  std::vector<std::int64_t> first_group_;
  std::vector<std::vector<TileStretch>> stretches_, halos_;
  std::vector<std::vector<std::size_t>> before_;
  std::vector<Joint> joints_;
};

}  // namespace tread
