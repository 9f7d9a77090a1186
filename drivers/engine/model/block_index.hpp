#pragma once
// Which block of a model's mesh is which body.

#include <vector>

namespace tread {

/// Indices into Mesh::blocks, or Mesh::bodies where that is said; -1: absent. A box rail and a tyre are one
/// block each.
struct BlockIndex {
  int rail_cap = -1;   ///< carries the running surface
  int rail_base = -1;  ///< tied under the cap
  int slab = -1;
  std::vector<int> sleepers;  ///< along x, one a fastening; empty: absent
  int tread = -1;             ///< carries the tread surface
  int disc = -1;
  int axle = -1;
  int disc_body = -1;  ///< in Mesh::bodies, in place of the disc
  int base_body = -1;  ///< in Mesh::bodies, in place of the rail below the cap

  /// The block whose foot stands on fastenings or ground.
  int rail_foot() const { return rail_base >= 0 ? rail_base : rail_cap; }
  std::vector<int> wheel() const;
  std::vector<int> rail() const;
};

}  // namespace tread
