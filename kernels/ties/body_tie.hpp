#pragma once
// Ties between a body of hexahedra and a swept block. The nodes of the finer side are moved onto the faces of
// the other and follow them. [theory.md, Ties]

#include <string>
#include <vector>

#include "core/mesh/swept_block.hpp"
#include "kernels/ties/node_links.hpp"

namespace tread {

/// Extents of the surface that a line of a block's section sweeps: "y = -76.5 to 58.5 mm, radius = 407 mm".
std::string surface_extents(const SweptBlock& block, const std::string& path);

struct BodyTieSpec {
  int body = -1;
  std::string set;  ///< of the body's nodes
  std::string key;  ///< of the scene that names the set, for messages
  int block = -1;
  std::string path;    ///< line of the block's section
  bool whole = false;  ///< the set must cover the block's line
};

/// A tie that was made.
struct BodyTie {
  std::vector<FollowingNode> nodes;
  bool body_leads = false;  ///< the block's nodes follow the body's faces
  double farthest = 0;      ///< distance of a node from its face before, at the most [m]
};

/// Locates and moves the secondary nodes; call it before coefficients are made. Throws InputError if they lie
/// further off the primary faces than a tenth of these, if the set has no faces, does not cover the line or
/// does not go around a closed block, or if the moved nodes fold an element of the body.
BodyTie tie_body(Mesh& mesh, const BodyTieSpec& spec);

}  // namespace tread
