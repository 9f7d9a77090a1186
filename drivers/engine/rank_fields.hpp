#pragma once
// The fields of a run whose steps several processes share. [docs/records/ranks.md]
//
// Each rank computes the elements of a stretch of tiles and moves their nodes. Nodes that features touch on
// several ranks are everyone's: each rank gets their forces and moves them in the same way (SharedGroups).
// Those where two stretches meet belong to both ranks. One exchange of forces a step makes all of them. The
// views of NodeFields hold them, the rank's own nodes, watched ones in samples and, after fetch(), all.

#include <memory>
#include <optional>
#include <vector>

#include "core/parallel/ranks.hpp"
#include "drivers/engine/precise_fields.hpp"
#include "drivers/engine/shared_groups.hpp"

namespace tread {

template <class Real, class U>
class RankFields final : public PreciseFields<Real, U> {
 public:
  RankFields(const Model& model, std::shared_ptr<Ranks> ranks);

  void set(const AlignedVector<double>& displacement, const AlignedVector<double>& velocity) override;
  void fetch() override;
  bool elsewhere() const override { return !whole_; }
  bool adds_forces() const override { return true; }
  void show(const WatchedNodes& nodes) override;
  const TieItems* tie_items() const override { return whole_ ? nullptr : &shared_->tie_items(); }

  void internal_force_and_move(const StepLoads& loads, bool measured) override;
  void move_rest(const StepLoads& loads, bool measured) override;
  void advance_lag(double dt) override;
  void anchor(const SpinningBody& body, const MeanMotion& mean, BodyFrame& wheel, double dt) override;
  void list_state(StateList& list) override;

 private:
  using Base = PreciseFields<Real, U>;
  /// Where the last element of a rank's tile ends at the first station of another rank's tile. Both ranks
  /// move the nodes of that station.
  struct Joint {
    int near = 0, far = 0;  ///< ranks of the element and of the station
    std::size_t tile = 0;   ///< of the element
    std::int64_t slot = 0;  ///< of section node 0 at the station
    std::int64_t nodes = 0;
    /// Places in packed_ of the force of the element and of those of all others on the station: [section
    /// node][3].
    std::int64_t element_force = 0, other_force = 0;
    std::vector<std::int64_t> shared;  ///< those of the values whose nodes all ranks move
  };

  void cut(const Mesh& mesh);
  void join_tiles();
  std::vector<GroupMovers> movers() const;
  void follow_patch(const StepLoads& loads);
  void take_choice();
  const TileShare* share() const override { return whole_ ? nullptr : &tiles_; }
  template <class T>
  void exchange(T* field, const std::vector<std::int64_t>& groups);
  std::vector<std::int64_t> first_of_ranks(const std::vector<std::int64_t>& groups) const;
  int rank_of(std::size_t tile) const;
  void fetch_law_state();
  void place_packed();
  Real* packed_groups(std::size_t rank);
  void pack();
  void unpack();
  void join_forces(const Joint& joint);
  void spoil();

  std::shared_ptr<Ranks> ranks_;
  std::size_t own_ = 0;                                 ///< this rank
  TileShare tiles_;                                     ///< stretches of the ranks
  std::vector<unsigned char> own_tiles_;                ///< marks of this rank's
  std::vector<std::int64_t> first_value_;               ///< by rank, and the end, in vector fields
  std::vector<std::vector<std::int64_t>> first_state_;  ///< by block the same in the state of its law

  std::optional<SharedGroups> shared_;
  int steps_left_ = 0;                      ///< that the patch stays among the shared groups
  GroupMarks held_;                         ///< groups of which this rank holds nodes
  std::vector<std::int64_t> groups_;        ///< shared groups, ascending
  std::vector<std::int64_t> first_group_;   ///< by rank, and the end, in groups_
  std::vector<Joint> joints_;               ///< in the order of their tiles
  std::vector<std::int64_t> first_packed_;  ///< by rank, and the end, in packed_
  AlignedVector<Real> packed_;              ///< forces: of groups, of elements at joints, of stations there
  bool whole_ = true;  ///< the views hold all values of the present, the same on all ranks
};

extern template class RankFields<double, double>;
extern template class RankFields<float, double>;
extern template class RankFields<float, float>;

}  // namespace tread
