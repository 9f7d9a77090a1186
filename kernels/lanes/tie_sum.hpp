#pragma once
// Values of nodes as weighted sums over nodes of another block, tile by tile: both directions of a tie.

#include <cstdint>

#include "core/mesh/swept_block.hpp"

namespace tread {

/// For every lane of a tile a station of the other block.
struct StationLink {
  std::int64_t at[kLanes] = {};  ///< its section node 0, component 0, in a vector field
  double share[kLanes] = {};     ///< 0: none
  double cosine[kLanes] = {};    ///< of the turn from the other's basis to the lane's, times the share
  double sine[kLanes] = {};      ///< times the share
};

/// A section node of the other block.
struct NodeLink {
  int other = 0;  ///< which of TieTile::others
  double share = 0;
};

/// Own section node and its links, [first, last).
struct LinkedNode {
  int node = 0;
  int first = 0;
  int last = 0;
};

inline constexpr int kMostTiedNodes = 512;  ///< of a section's line

struct TieTile {
  std::int64_t own = 0;  ///< of the tile's section node 0, component 0, in a vector field
  const StationLink* stations = nullptr;
  int station_count = 0;
  const int* others = nullptr;  ///< section nodes of the other block, at most kMostTiedNodes
  int other_count = 0;
  const LinkedNode* nodes = nullptr;
  int node_count = 0;
  const NodeLink* links = nullptr;
};

/// The sum replaces a node's values, or is added to them. In double whatever the field is stored in, for each
/// of the others in the order of the stations' links, then in that of the nodes': not contracted, the same
/// bits for all instruction sets.
template <class Real>
using TieSum = void (*)(const TieTile& tile, bool add, Real* field);

}  // namespace tread
