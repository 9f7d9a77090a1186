#pragma once
// The fields of a run whose steps several processes share. [docs/records/ranks.md]
//
// Each rank computes the elements of its tiles and moves their nodes. Nodes that elements or features of
// other ranks touch are moved by these ranks, too, in the same way (SharedGroups): one exchange of forces a
// step makes that possible (RankForces). kContactRank alone moves those about the patch and sends their
// motion (PatchMotion). The views of NodeFields hold the nodes that the rank moves, watched ones in samples
// and, on rank 0 after fetch(), all.

#include <algorithm>
#include <iterator>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/parallel/ranks.hpp"
#include "drivers/engine/fields/patch_tiles.hpp"
#include "drivers/engine/fields/precise_fields.hpp"
#include "drivers/engine/ranks/rank_cut.hpp"
#include "drivers/engine/ranks/rank_forces.hpp"
#include "drivers/engine/ranks/rank_patch.hpp"
#include "drivers/engine/ranks/shared_groups.hpp"

namespace tread {

template <class Real, class U>
class RankFields : public PreciseFields<Real, U> {
 public:
  /// `borders`: joints where the processor computes the elements.
  RankFields(const Model& model, std::shared_ptr<Ranks> ranks, Borders borders = Borders::joints);

  void set(const AlignedVector<double>& displacement, const AlignedVector<double>& velocity) override;
  void fetch() override;
  void spread() override;
  std::span<const unsigned char> groups_with_mass() const override;
  bool elsewhere() const override { return !whole(); }
  bool adds_forces() const override { return true; }
  void show(const WatchedNodes& nodes) override;
  const TieItems* tie_items() const override { return whole() ? nullptr : &tie_items_; }

  bool follow_patch(const BodyFrame& wheel, double dt) override;
  void internal_force_and_move(const StepLoads& loads, bool measured) override;
  void move_with_contact(const StepLoads& loads, double time) override;
  void move_rest(const StepLoads& loads, bool measured) override;
  /// Those of nodes that move here: the memory of the others stays untouched.
  void hold(std::span<const std::int64_t> unknowns) override {
    if (!std::exchange(knows_held_, true)) {
      held_unknowns_.clear();
      std::copy_if(unknowns.begin(), unknowns.end(), std::back_inserter(held_unknowns_),
                   [this](std::int64_t unknown) { return moved_[index(unknown / kGroupValues)] != 0; });
    }
    Base::hold(held_unknowns_);
  }
  void spread_patch(bool measured) override;
  void advance_lag(double dt) override;
  void anchor(const SpinningBody& body, const MeanMotion& mean, BodyFrame& wheel, double dt) override {
    body.anchor(mean, this->displacement(), this->velocity(), wheel, dt, moved_.data());
  }
  void list_state(StateList& list) override;

 protected:
  /// The views get the motion of these groups, as far as they are this rank's.
  virtual void bring(const std::vector<std::int64_t>& /*groups*/) {}
  /// deferred() has changed.
  virtual void patch_chosen() {}

  bool solves() const { return ranks_->rank() == kContactRank; }
  const RankCut& cut() const { return cut_; }
  const std::vector<TileStretch>& own_stretches() const { return tiles_.own; }
  const std::vector<TileStretch>& halo() const { return cut_.halo(ranks_->rank()); }
  const std::vector<std::size_t>& tiles_before() const { return cut_.before(ranks_->rank()); }
  bool owns(std::int64_t group) const { return cut_.owner(group) == ranks_->rank(); }
  /// Groups that elements alone do not move: those that wait for forces of others, that others wait for, and
  /// all about the patch.
  const GroupMarks& deferred() const { return deferred_; }
  /// Sends the forces of the elements, and receives those of other ranks.
  void exchange_forces() {
    exchange_patch_forces();
    exchange_other_forces();
  }
  void move_patch(const StepLoads& loads);
  /// Calls visit(block, place): values of the state of the block's law in the tiles [first, last) of all lie
  /// at [place(first), place(last)). Blocks without state are left out.
  template <class Visit>
  void for_law_blocks(const Visit& visit) {
    std::size_t before = 0;
    for (std::size_t b = 0; this->law_state() && b < this->mesh().blocks.size(); ++b) {
      const std::size_t tiles = this->mesh().blocks[b].tiles.size();
      const BlockElements<Real>& elements = this->internal().elements(static_cast<int>(b));
      const auto place = [&elements, before, tiles](std::size_t tile) {
        return elements.state_place(static_cast<int>(std::clamp(tile, before, before + tiles) - before));
      };
      if (place(before + tiles) > 0) visit(static_cast<int>(b), place);
      before += tiles;
    }
  }

 private:
  using Base = PreciseFields<Real, U>;

  /// True where the views hold all values of the present.
  bool whole() const { return gathered_ && ranks_->rank() == 0; }
  const TileShare* share() const override { return whole() ? nullptr : &tiles_; }
  void choose_patch(const BodyFrame& wheel, double ahead);
  void spread_points();
  auto carries() const {
    return [this](std::size_t tile) { return this->internal().carry(tile).data(); };
  }
  void exchange_patch_forces();
  void exchange_other_forces();
  void take_near();
  template <class T>
  void share_groups(T* field, const std::vector<std::int64_t>& groups);
  void require_one_cut();
  enum class Way { to_rank_0, from_rank_0 };
  using ByRank = std::vector<std::vector<TileStretch>>;
  template <class T, class Place>
  void send_tiles(Way way, const ByRank& tiles, T* values, const Place& place);
  void send_all_tiles(Way way);
  void send_law_state(Way way, const ByRank& tiles);
  struct Halo {
    int other;  ///< rank that sends or gets its values
    std::vector<std::int64_t> groups;
  };
  template <class T>
  void spread_halos(T* field, const std::vector<Halo>& halos);
  void exchange_one_way(bool sends, const std::vector<RankSegment>& segments);
  void spoil();

  /// Contact of a rank that does not solve it.
  struct ContactElsewhere final : ContactSteps {
    explicit ContactElsewhere(Contact* of) : contact(of) {}
    void search(const BodyFrame& /*wheel*/, double /*time*/, double /*dt*/) override {}
    void resolve() override { contact->take({}); }  // points come in measured steps alone

    Contact* contact;
  };

  std::shared_ptr<Ranks> ranks_;
  Borders borders_;
  RankCut cut_;
  TileShare tiles_;
  std::vector<unsigned char> own_tiles_;  ///< marks of this rank's

  SharedGroups shared_;
  HeldGroups held_;                          ///< of this rank, the patch aside
  GroupMarks moved_, deferred_;              ///< with the patch
  std::vector<std::int64_t> held_unknowns_;  ///< of moved_
  bool knows_held_ = false;
  TieItems tie_items_;
  RankForces<Real> patch_forces_, other_forces_;
  PatchTiles patch_tiles_;
  bool apart_ = false;                         ///< patch_tiles_ are found
  std::vector<TileStretch> near_, elsewhere_;  ///< of this rank's tiles
  bool beside_ = false;                        ///< contact was solved beside the elements of this step
  std::optional<ContactElsewhere> contact_elsewhere_;
  PatchMotion<Real, U> patch_motion_;
  int steps_left_ = 0;    ///< that the patch stays among the shared groups
  bool gathered_ = true;  ///< rank 0 has all values of the present
};

extern template class RankFields<double, double>;
extern template class RankFields<float, double>;
extern template class RankFields<float, float>;

}  // namespace tread
