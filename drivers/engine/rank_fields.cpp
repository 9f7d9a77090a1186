#include "drivers/engine/rank_fields.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/index.hpp"
#include "drivers/engine/featured_nodes.hpp"

namespace tread {

template <class Real, class U>
RankFields<Real, U>::RankFields(const Model& model, std::shared_ptr<Ranks> ranks)
    : Base(model), ranks_(std::move(ranks)), own_(index(ranks_->rank())) {
  cut(model.mesh);
  join_tiles();
  shared_.emplace(model, movers(), ranks_->rank());
  take_choice();
}

/// Fields are contiguous in the order of blocks and tiles, and so is a stretch of them.
template <class Real, class U>
void RankFields<Real, U>::cut(const Mesh& mesh) {
  tiles_ = {ranks_.get(), this->internal().cut(ranks_->count())};
  std::vector<std::int64_t> first_of_tile;
  for (const SweptBlock& block : mesh.blocks)
    for (std::int64_t tile = 0; tile < std::ssize(block.tiles); ++tile)
      first_of_tile.push_back(dof(block.base + tile * block.section.nodes() * kLanes, 0));
  first_of_tile.push_back(3 * mesh.slots);
  for (const TileStretch& stretch : tiles_.by_rank) first_value_.push_back(first_of_tile[stretch.first]);
  first_value_.push_back(first_of_tile.back());
  own_tiles_.resize(first_of_tile.size() - 1, 0);
  std::fill(own_tiles_.begin() + std::ptrdiff_t(tiles_.own().first),
            own_tiles_.begin() + std::ptrdiff_t(tiles_.own().last), 1);

  std::size_t before = 0;
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    const std::size_t tiles = mesh.blocks[b].tiles.size();
    const auto values_to = [&](std::size_t tile) {
      const std::size_t within = std::clamp(tile, before, before + tiles) - before;
      return this->internal().elements(static_cast<int>(b)).state_place(static_cast<int>(within));
    };
    std::vector<std::int64_t>& first = first_state_.emplace_back();
    for (const TileStretch& stretch : tiles_.by_rank) first.push_back(values_to(stretch.first));
    first.push_back(values_to(before + tiles));
    before += tiles;
  }
}

template <class Real, class U>
int RankFields<Real, U>::rank_of(std::size_t tile) const {
  const auto holds = [tile](const TileStretch& stretch) { return stretch.holds(tile); };
  return static_cast<int>(std::find_if(tiles_.by_rank.begin(), tiles_.by_rank.end(), holds) -
                          tiles_.by_rank.begin());
}

template <class Real, class U>
void RankFields<Real, U>::join_tiles() {
  const Mesh& mesh = this->mesh();
  std::size_t before = 0;
  for (std::size_t b = 0; b < mesh.blocks.size(); before += mesh.blocks[b++].tiles.size()) {
    const SweptBlock& block = mesh.blocks[b];
    for (std::size_t tile = 0; tile < block.tiles.size(); ++tile) {
      if (block.tiles[tile].elements == 0) continue;
      const int next = block.tiles[tile].next;
      Joint joint;
      joint.near = rank_of(before + tile);
      joint.far = rank_of(before + index(next));
      joint.tile = before + tile;
      if (joint.near == joint.far) continue;
      joint.nodes = block.section.nodes();
      joint.slot = block.base + next * joint.nodes * kLanes;
      joints_.push_back(std::move(joint));
    }
  }
}

template <class Real, class U>
std::vector<GroupMovers> RankFields<Real, U>::movers() const {
  std::vector<GroupMovers> movers(index(first_value_.back() / kGroupValues));
  for (std::size_t rank = 0; rank < tiles_.by_rank.size(); ++rank)
    for (std::int64_t group = first_value_[rank] / kGroupValues;
         group < first_value_[rank + 1] / kGroupValues; ++group)
      movers[index(group)].rank = static_cast<int>(rank);
  for (const Joint& joint : joints_)
    for (std::int64_t node = 0; node < joint.nodes; ++node)
      movers[index(joint.slot / kLanes + node)].beside = joint.near;
  return movers;
}

/// Chooses the nodes about the patch that all ranks move, for some steps, and gives each rank their motion.
template <class Real, class U>
void RankFields<Real, U>::follow_patch(const StepLoads& loads) {
  constexpr int kSteps = 70;
  shared_->follow(loads.frame,
                  (kSteps + 1) * loads.dt);  // the next choice comes after the search of its step
  steps_left_ = kSteps;
  take_choice();
  exchange(this->u().data(), groups_);
  exchange(this->v().data(), groups_);
}

/// Takes over the choice of shared groups. No more of them than at first, so nothing is allocated.
template <class Real, class U>
void RankFields<Real, U>::take_choice() {
  const GroupMarks& marks = shared_->shared();
  this->update().defer_only(shared_->deferred());
  held_ = marks;
  std::fill(held_.begin() + first_value_[own_] / kGroupValues,
            held_.begin() + first_value_[own_ + 1] / kGroupValues, 1);
  groups_.clear();
  for (std::int64_t group = 0; group < std::ssize(marks); ++group)
    if (marks[index(group)] != 0) groups_.push_back(group);
  first_group_ = first_of_ranks(groups_);
  for (Joint& joint : joints_) {
    joint.shared.clear();
    for (std::int64_t node = 0; node < joint.nodes; ++node) {
      const std::size_t group = index(joint.slot / kLanes + node);
      if (joint.near == ranks_->rank()) held_[group] = 1;
      for (int c = 0; marks[group] != 0 && c < 3; ++c) joint.shared.push_back(3 * node + c);
    }
  }
  place_packed();
}

/// Places in a list of ascending groups where those of each rank begin, and its end.
template <class Real, class U>
std::vector<std::int64_t> RankFields<Real, U>::first_of_ranks(const std::vector<std::int64_t>& groups) const {
  std::vector<std::int64_t> first;
  for (const std::int64_t value : first_value_)
    first.push_back(std::lower_bound(groups.begin(), groups.end(), value / kGroupValues) - groups.begin());
  return first;
}

/// Gives each rank the values of these groups, in ascending order, as their tiles' ranks have them.
template <class Real, class U>
template <class T>
void RankFields<Real, U>::exchange(T* field, const std::vector<std::int64_t>& groups) {
  std::vector<std::int64_t> first = first_of_ranks(groups);
  AlignedVector<T> packed(groups.size() * kGroupValues);
  const auto for_values = [&](std::int64_t from, std::int64_t to, const auto& visit) {
    for_groups(groups, from, to,
               [&](std::int64_t at, std::int64_t place) { visit(packed.data() + at, field + place); });
  };
  for_values(first[own_], first[own_ + 1],
             [](T* at, const T* value) { std::copy_n(value, kGroupValues, at); });
  std::vector<std::int64_t> first_packed = first;
  for (std::int64_t& place : first_packed) place *= kGroupValues;
  ranks_->gather(packed.data(), first_packed);
  const auto take = [](const T* at, T* value) { std::copy_n(at, kGroupValues, value); };
  for_values(0, first[own_], take);
  for_values(first[own_ + 1], first.back(), take);
}

template <class Real, class U>
void RankFields<Real, U>::show(const WatchedNodes& nodes) {
  std::vector<std::int64_t> groups = nodes.groups();
  std::sort(groups.begin(), groups.end());
  exchange(this->u().data(), groups);
  exchange(this->v().data(), groups);
  if (this->q()) exchange(this->q()->values().data(), groups);
  fetch_law_state();
}

/// Forces that a rank sends lie together: those of its groups, then those at joints.
template <class Real, class U>
void RankFields<Real, U>::place_packed() {
  std::int64_t place = 0;
  first_packed_.clear();
  for (std::size_t rank = 0; rank < tiles_.by_rank.size(); ++rank) {
    first_packed_.push_back(place);
    place += (first_group_[rank + 1] - first_group_[rank]) * kGroupValues;
    for (Joint& joint : joints_) {
      if (joint.near == static_cast<int>(rank))
        joint.element_force = std::exchange(place, place + 3 * joint.nodes);
      if (joint.far == static_cast<int>(rank))
        joint.other_force = std::exchange(place, place + 3 * joint.nodes);
    }
  }
  first_packed_.push_back(place);
  packed_.resize(index(place));
}

/// Packed forces of a rank's groups, counted from those of the first group of all.
template <class Real, class U>
Real* RankFields<Real, U>::packed_groups(std::size_t rank) {
  return packed_.data() + first_packed_[rank] - first_group_[rank] * kGroupValues;
}

template <class Real, class U>
void RankFields<Real, U>::pack() {
  Real* const packed = packed_groups(own_);
  for_groups(groups_, first_group_[own_], first_group_[own_ + 1], [&](std::int64_t at, std::int64_t place) {
    std::copy_n(this->f().data() + place, kGroupValues, packed + at);
  });
  for (const Joint& joint : joints_) {
    if (joint.near == ranks_->rank())
      std::copy_n(this->internal().carry(joint.tile).data(), 3 * joint.nodes,
                  packed_.data() + joint.element_force);
    if (joint.far == ranks_->rank())
      for (std::int64_t i = 0; i < 3 * joint.nodes; ++i)
        packed_[index(joint.other_force + i)] = this->f()[index(dof(joint.slot, 0) + i * kLanes)];
  }
}

template <class Real, class U>
void RankFields<Real, U>::unpack() {
  for (std::size_t rank = 0; rank < tiles_.by_rank.size(); ++rank) {
    if (rank == own_) continue;
    const Real* const packed = packed_groups(rank);
    for_groups(groups_, first_group_[rank], first_group_[rank + 1], [&](std::int64_t at, std::int64_t place) {
      std::copy_n(packed + at, kGroupValues, this->f().data() + place);
    });
  }
  for (const Joint& joint : joints_) join_forces(joint);
}

/// Forces at the joint's station on the nodes that this rank moves there, in one process's order of addition.
template <class Real, class U>
void RankFields<Real, U>::join_forces(const Joint& joint) {
  const Real* const element = packed_.data() + joint.element_force;
  const Real* const others = packed_.data() + joint.other_force;
  Real* const f = this->f().data() + dof(joint.slot, 0);
  if (joint.far == ranks_->rank())
    for (std::int64_t i = 0; i < 3 * joint.nodes; ++i) f[i * kLanes] += element[i];
  else if (joint.near == ranks_->rank())
    for (std::int64_t i = 0; i < 3 * joint.nodes; ++i) f[i * kLanes] = others[i] + element[i];
  else
    for (const std::int64_t i : joint.shared) f[i * kLanes] += element[i];
}

template <class Real, class U>
void RankFields<Real, U>::set(const AlignedVector<double>& displacement,
                              const AlignedVector<double>& velocity) {
  Base::set(displacement, velocity);
  whole_ = true;
  steps_left_ = 0;
}

template <class Real, class U>
void RankFields<Real, U>::fetch() {
  if (whole_) return;
  ranks_->gather(this->u().data(), first_value_);
  ranks_->gather(this->v().data(), first_value_);
  if (this->q()) ranks_->gather(this->q()->values().data(), first_value_);
  fetch_law_state();
  whole_ = true;
}

template <class Real, class U>
void RankFields<Real, U>::fetch_law_state() {
  for (std::size_t b = 0; this->law_state() && b < first_state_.size(); ++b)
    if (first_state_[b].back() > 0)
      ranks_->gather(this->law_state()->values(static_cast<int>(b)), first_state_[b]);
}

template <class Real, class U>
void RankFields<Real, U>::internal_force_and_move(const StepLoads& loads, bool measured) {
  if (steps_left_ == 0) follow_patch(loads);
  --steps_left_;
  if (measured)
    this->internal().internal_force(tiles_.own(), this->force_fields());
  else
    this->internal().move(tiles_.own(), this->update(), loads, this->force_fields());
  pack();
  ranks_->gather(packed_.data(), first_packed_);
  unpack();
  whole_ = false;
  if (ranks_->spoils_copies()) spoil();
}

template <class Real, class U>
void RankFields<Real, U>::move_rest(const StepLoads& loads, bool measured) {
  if (!measured) return Base::move_rest(loads, false);
  this->update().move_rest(loads, {this->u().data(), this->v().data(), this->f().data()}, own_tiles_);
}

template <class Real, class U>
void RankFields<Real, U>::anchor(const SpinningBody& body, const MeanMotion& mean, BodyFrame& wheel,
                                 double dt) {
  body.anchor(mean, this->displacement(), this->velocity(), wheel, dt, held_.data());
}

template <class Real, class U>
void RankFields<Real, U>::advance_lag(double dt) {
  if (!this->q()) return;
  this->q()->advance(this->v().data(), dt, first_value_[own_] / 3, first_value_[own_ + 1] / 3);
  for (const Joint& joint : joints_)
    if (joint.near == ranks_->rank())
      this->q()->advance(this->v().data(), dt, joint.slot, joint.slot + joint.nodes * kLanes);
}

/// Whoever reads another rank's values without fetching them is found out.
template <class Real, class U>
void RankFields<Real, U>::spoil() {
  const auto spoil_lanes = [](auto* field, std::int64_t group, int first) {
    for (int c = 0; c < 3; ++c)
      for (int lane = first; lane < kLanes; ++lane)
        field[group * kGroupValues + c * kLanes + lane] =
            std::numeric_limits<std::remove_pointer_t<decltype(field)>>::quiet_NaN();
  };
  for (std::int64_t group = 0; group < first_value_.back() / kGroupValues; ++group) {
    const std::int64_t value = group * kGroupValues;
    if (value >= first_value_[own_] && value < first_value_[own_ + 1]) continue;
    const bool joined = std::any_of(joints_.begin(), joints_.end(), [&](const Joint& joint) {
      const std::int64_t node = group - joint.slot / kLanes;
      return joint.near == ranks_->rank() && node >= 0 && node < joint.nodes;
    });
    const int first = joined ? 1 : 0;
    if (this->q()) spoil_lanes(this->q()->values().data(), group, first);
    if (std::binary_search(groups_.begin(), groups_.end(), group)) continue;
    spoil_lanes(this->u().data(), group, first);
    spoil_lanes(this->v().data(), group, first);
    spoil_lanes(this->f().data(), group, first);
  }
}

template <class Real, class U>
void RankFields<Real, U>::list_state(StateList& list) {
  fetch();
  steps_left_ = 0;  // whoever asks may change the state
  Base::list_state(list);
}

template class RankFields<double, double>;
template class RankFields<float, double>;
template class RankFields<float, float>;

}  // namespace tread
