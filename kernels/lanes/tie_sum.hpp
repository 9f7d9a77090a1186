#pragma once
// Values of nodes as weighted sums over nodes of another block, tile by tile. Both directions of a tie use
// it.

#include <cstdint>

#include "core/mesh/swept_block.hpp"

namespace tread {

/// A station of the other block for every lane of a tile.
struct StationLink {
  std::int64_t at[kLanes] = {};  ///< place of the station's section node 0, component 0, in a vector field
  double share[kLanes] = {};     ///< weight of the station; 0: none
  double cosine[kLanes] = {};    ///< cosine of the turn from the other's basis to the lane's, times the share
  double sine[kLanes] = {};      ///< sine of the turn, times the share
};

/// A section node of the other block.
struct NodeLink {
  int other = 0;  ///< index in TieTile::others
  double share = 0;
};

/// Own section node and its links, [first, last).
struct LinkedNode {
  int node = 0;
  int first = 0;
  int last = 0;
};

inline constexpr int kMostTiedNodes = 512;  ///< most tied nodes of a section's line

struct TieTile {
  std::int64_t own = 0;  ///< place of the tile's section node 0, component 0, in a vector field
  const StationLink* stations = nullptr;
  int station_count = 0;
  const int* others = nullptr;  ///< section nodes of the other block, at most kMostTiedNodes
  int other_count = 0;
  const LinkedNode* nodes = nullptr;
  int node_count = 0;
  const NodeLink* links = nullptr;
};

/// Sums up the links of a tile: the sum replaces a node's values or is added to them. The sum is formed in
/// double for either storage: for each of `others` over the stations' links in their order, then over the
/// nodes' links in theirs. Nothing is contracted, so all instruction sets give equal bits.
template <class Real>
using TieSum = void (*)(const TieTile& tile, bool add, Real* field);

}  // namespace tread
