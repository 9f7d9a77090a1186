#pragma once
// Which groups of kLanes slots all ranks of a run move: those on which features act whose nodes lie on
// several ranks, and those about the patch, wherever it is. [docs/records/ranks.md]

#include <vector>

#include "drivers/engine/featured_nodes.hpp"

namespace tread {

/// Ranks that move a group by its elements: that of its tile, and where the elements before its first station
/// belong to another rank, that one (else -1).
struct GroupMovers {
  int rank = 0, beside = -1;

  bool has(int other) const { return rank == other || beside == other; }
  /// True where both groups are moved by one rank, the same.
  bool alone_with(const GroupMovers& other) const {
    return beside < 0 && other.beside < 0 && rank == other.rank;
  }
};

class SharedGroups {
 public:
  /// `movers`: by group. Keeps a reference to the model. Shares all nodes of both running surfaces until
  /// follow().
  SharedGroups(const Model& model, const std::vector<GroupMovers>& movers, int own);

  /// Shares what contact touches of the running surfaces with the wheel's frame anywhere between now and a
  /// time of `ahead` [s] later.
  void follow(const BodyFrame& wheel, double ahead);

  /// Marks of the groups that all ranks move.
  const GroupMarks& shared() const { return shared_; }
  /// Marks of the groups that this rank moves once their force is complete.
  const GroupMarks& deferred() const { return deferred_; }
  /// Items of the ties that this rank needs.
  const TieItems& tie_items() const { return tie_items_; }

 private:
  void share_ties(const GroupMarks& featured, const std::vector<GroupMovers>& movers);
  void share_near(const SweptBlock& block, const SurfaceProfile& profile, const SurfacePart& part);

  const Model* model_;
  GroupMarks always_;  ///< shared wherever the wheel is
  GroupMarks own_;     ///< deferred on this rank wherever the wheel is
  GroupMarks shared_, deferred_;
  TieItems tie_items_;
};

}  // namespace tread
