#pragma once
// An order of the quads of a section in which few nodes are in use at a time, so that their values stay in
// the nearest cache: a node is opened before the first and closed after the last of its quads.

#include <vector>

#include "core/mesh/section.hpp"

namespace tread {

/// Nodes that a loop over `open` may look ahead.
inline constexpr int kPrefetchAhead = 8;

struct FrontPlan {
  struct Node {
    int node;  ///< section node
    int slot;  ///< place in the front
  };
  struct Quad {
    int quad;     ///< section quad
    int slot[4];  ///< places of its corners
    int opened;   ///< entries of `open` used up to here
    int closed;   ///< entries of `close` used up to here
  };
  std::vector<Quad> quads;
  std::vector<Node> open;  ///< all nodes, then kPrefetchAhead times the last one
  std::vector<Node> close;
  int slots = 0;  ///< largest number of nodes in use
};

FrontPlan make_front_plan(const Section& section);

/// Numbers the nodes in the order in which the plan opens them: the loop then walks through memory forwards.
void number_by_front(Section& section);

}  // namespace tread
