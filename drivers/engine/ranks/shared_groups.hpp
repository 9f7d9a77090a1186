#pragma once
// Which groups of kLanes slots several ranks of a run move: where their tiles meet, where nodes are tied,
// where features act, and about the patch, wherever it is. [docs/records/ranks.md]

#include <cstdint>
#include <utility>
#include <vector>

#include "drivers/engine/fields/featured_nodes.hpp"
#include "drivers/engine/ranks/rank_cut.hpp"

namespace tread {

/// Groups of a rank, by mark.
struct HeldGroups {
  GroupMarks moved;  ///< whose nodes it moves: one lane at stations where another rank's tile begins
  GroupMarks
      forced;  ///< of which it needs the forces in all lanes, to move them or nodes to which they are tied
  GroupMarks
      deferred;  ///< of those that it moves, the ones that wait for forces of others, or others for theirs
};

/// Groups of which a node follows one of the other.
struct TiedGroups {
  std::int64_t secondary, primary;

  bool operator==(const TiedGroups&) const = default;
  bool operator<(const TiedGroups& o) const {
    return std::pair(secondary, primary) < std::pair(o.secondary, o.primary);
  }
};

class SharedGroups {
 public:
  /// Keeps references. The patch is anywhere on both running surfaces until follow().
  SharedGroups(const Model& model, const RankCut& cut);

  HeldGroups held_by(int rank) const;
  /// Groups of others' tiles of which a rank moves nodes, with those about the patch that it moves,
  /// ascending. `held`: by it.
  std::vector<std::int64_t> halo_of(int rank, const HeldGroups& held) const;

  /// The patch is what contact touches with the wheel's frame anywhere between now and a time of `ahead` [s]
  /// later.
  void follow(const BodyFrame& wheel, double ahead);
  /// The groups about it, ascending. kContactRank moves them, and others get their motion.
  const std::vector<std::int64_t>& near() const { return near_; }

 private:
  const Model* model_;
  const RankCut* cut_;
  std::vector<TiedGroups> tied_;
  GroupMarks all_ranks_;  ///< of all ranks, wherever the wheel is
  GroupMarks loaded_;     ///< of connectors, loads and ties
  std::vector<std::int64_t> near_;
};

}  // namespace tread
