#pragma once
// Ties of single nodes, where one side is a body without a section: every secondary node has shares in up to
// four primary nodes. [theory.md, Ties]

#include <array>
#include <cstdint>
#include <vector>

#include "core/mesh/node_field.hpp"

namespace tread {

/// A node and its basis: `angle` of its station in a body that spins, the same for all nodes of a fixed one
/// [rad].
struct BasedNode {
  std::int64_t slot = -1;
  double angle = 0;
};

/// A secondary node and the corners of the primary face on which it lies.
struct FollowingNode {
  BasedNode node;
  std::array<BasedNode, 4> primary;
  std::array<double, 4> share = {};  ///< sum 1; a corner without a share does not count
};

/// Both directions of such ties. Nodes are worked on in any order: each sum has an order of its own.
class NodeLinks {
 public:
  NodeLinks() = default;
  explicit NodeLinks(const std::vector<FollowingNode>& tied);

  bool empty() const { return to_secondary_.rows.empty(); }

  /// Sets the secondary values from the primary ones.
  void follow(NodeField field) const { sum_up(to_secondary_, false, field); }
  /// Adds the secondary values to the primary ones.
  void hand_over(NodeField force) const { sum_up(to_primary_, true, force); }

  /// Calls visit(secondary slot, primary slot, share) for all links, by secondary slot.
  template <class Visit>
  void for_each(const Visit& visit) const {
    for (const Row& row : to_secondary_.rows)
      for (std::size_t i = row.first; i < row.last; ++i)
        visit(row.slot, to_secondary_.links[i].slot, to_secondary_.links[i].share);
  }

  std::int64_t bytes() const;

 private:
  struct Link {
    std::int64_t slot = -1;
    std::int64_t at = -1;  ///< dof(slot, 0)
    double share = 0;
    double cosine = 1, sine = 0;  ///< of the turn from the other's basis to the own, times the share
  };
  struct Row {
    std::int64_t slot = -1;
    std::size_t first = 0, last = 0;  ///< indices in `links`
  };
  struct Sums {
    std::vector<Row> rows;
    std::vector<Link> links;
  };
  struct Entry;
  static Sums sums_of(std::vector<Entry> entries);
  static void sum_up(const Sums& sums, bool add, NodeField field);

  Sums to_secondary_, to_primary_;
};

}  // namespace tread
