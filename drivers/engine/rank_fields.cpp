#include "drivers/engine/rank_fields.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "drivers/engine/featured_nodes.hpp"

namespace tread {

namespace {

std::size_t index(std::int64_t i) {
  return static_cast<std::size_t>(i);
}

template <class T>
std::span<std::byte> bytes_of(std::span<T> values) {
  return std::as_writable_bytes(values);
}

}  // namespace

template <class Real, class U>
RankFields<Real, U>::RankFields(const Model& model, std::shared_ptr<Ranks> ranks)
    : Base(model), ranks_(std::move(ranks)), own_(index(ranks_->rank())) {
  cut(model.mesh);
  choose_groups(model);
  join_tiles();
}

/// Fields are contiguous in the order of blocks and tiles, and so is a stretch of them.
template <class Real, class U>
void RankFields<Real, U>::cut(const Mesh& mesh) {
  stretches_ = this->internal().cut(ranks_->count());
  std::vector<std::int64_t> first_of_tile;
  for (const SweptBlock& block : mesh.blocks)
    for (std::int64_t tile = 0; tile < std::ssize(block.tiles); ++tile)
      first_of_tile.push_back(dof(block.base + tile * block.section.nodes() * kLanes, 0));
  first_of_tile.push_back(3 * mesh.slots);
  for (const TileStretch& stretch : stretches_) first_value_.push_back(first_of_tile[stretch.first]);
  first_value_.push_back(first_of_tile.back());

  std::size_t before = 0;
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    const std::size_t tiles = mesh.blocks[b].tiles.size();
    const auto values_to = [&](std::size_t tile) {
      const std::size_t within = std::clamp(tile, before, before + tiles) - before;
      return this->internal().elements(static_cast<int>(b)).state_place(static_cast<int>(within));
    };
    std::vector<std::int64_t>& first = first_state_.emplace_back();
    for (const TileStretch& stretch : stretches_) first.push_back(values_to(stretch.first));
    first.push_back(values_to(before + tiles));
    before += tiles;
  }
}

template <class Real, class U>
void RankFields<Real, U>::choose_groups(const Model& model) {
  const std::vector<std::int64_t> slots = featured_slots(model);
  this->update().defer(slots);
  const std::vector<unsigned char> marks = groups_of(model.mesh, slots);
  for (std::int64_t group = 0; group < std::ssize(marks); ++group)
    if (marks[index(group)] != 0) groups_.push_back(group);
  for (const std::int64_t value : first_value_) {
    const auto at = std::lower_bound(groups_.begin(), groups_.end(), value / kGroupValues);
    first_group_.push_back(at - groups_.begin());
    first_packed_.push_back(first_group_.back() * kGroupValues);
  }
  packed_f_.resize(groups_.size() * kGroupValues);
}

template <class Real, class U>
int RankFields<Real, U>::rank_of(std::size_t tile) const {
  const auto holds = [tile](const TileStretch& stretch) { return stretch.holds(tile); };
  return static_cast<int>(std::find_if(stretches_.begin(), stretches_.end(), holds) - stretches_.begin());
}

/// Where the last element of a rank's tile ends in another rank's: its far force goes there, the motion of
/// its far station comes from there. All ranks list these places in one order.
template <class Real, class U>
void RankFields<Real, U>::join_tiles() {
  std::vector<int> to, from;
  std::size_t before = 0;
  for (std::size_t b = 0; b < this->mesh().blocks.size(); before += this->mesh().blocks[b++].tiles.size())
    for (std::size_t tile = 0; tile < this->mesh().blocks[b].tiles.size(); ++tile) {
      const int next = this->mesh().blocks[b].tiles[tile].next;
      if (next < 0 || this->mesh().blocks[b].tiles[tile].elements == 0) continue;
      const int near = rank_of(before + tile);
      const int far = rank_of(before + index(next));
      if (near == far || (near != ranks_->rank() && far != ranks_->rank())) continue;
      const RankMessage carry = {near == ranks_->rank() ? far : near,
                                 bytes_of(this->internal().carry(before + tile))};
      const bool sends = near == ranks_->rank();
      (sends ? carries_sent_ : carries_received_).push_back(carry);
      (sends ? received_halos_ : sent_halos_).push_back(halo_of(static_cast<int>(b), next));
      (sends ? from : to).push_back(carry.rank);
    }
  const auto list = [](std::vector<Halo>& halos, const std::vector<int>& others,
                       std::vector<RankMessage>& messages) {
    for (std::size_t i = 0; i < halos.size(); ++i) {
      messages.push_back({others[i], bytes_of(std::span(halos[i].u))});
      if (!halos[i].d.empty()) messages.push_back({others[i], bytes_of(std::span(halos[i].d))});
    }
  };
  list(sent_halos_, to, halos_sent_);
  list(received_halos_, from, halos_received_);
}

/// The lag of a block's branch or the velocity; null where the block has no damping.
template <class Real, class U>
Real* RankFields<Real, U>::damping(int block) {
  if (this->internal().branch(block) != 0) return this->q()->values().data();
  return this->internal().beta(block) != 0 ? this->v().data() : nullptr;
}

template <class Real, class U>
typename RankFields<Real, U>::Halo RankFields<Real, U>::halo_of(int block, int tile) {
  const SweptBlock& swept = this->mesh().blocks[index(block)];
  Halo halo;
  halo.block = block;
  halo.slot = swept.base + std::int64_t{tile} * swept.section.nodes() * kLanes;
  halo.u.resize(index(3 * swept.section.nodes()));
  halo.d.resize(damping(block) != nullptr ? halo.u.size() : 0);
  return halo;
}

template <class Real, class U>
template <class Copy>
void RankFields<Real, U>::for_halo(Halo& halo, const Copy& copy) {
  const auto for_values = [&](auto* field, auto& values) {
    field += dof(halo.slot, 0);
    for (std::size_t i = 0; i < values.size(); ++i) copy(field[i * kLanes], values[i]);
  };
  for_values(this->u().data(), halo.u);
  if (!halo.d.empty()) for_values(damping(halo.block), halo.d);
}

template <class Real, class U>
void RankFields<Real, U>::exchange_halos() {
  for (Halo& halo : sent_halos_) for_halo(halo, [](const auto& field, auto& value) { value = field; });
  ranks_->exchange(halos_sent_, halos_received_);
  for (Halo& halo : received_halos_) for_halo(halo, [](auto& field, const auto& value) { field = value; });
}

template <class Real, class U>
void RankFields<Real, U>::share_forces() {
  const std::int64_t first = first_group_[own_];
  const std::int64_t last = first_group_[own_ + 1];
  for_groups(groups_, first, last, [&](std::int64_t packed, std::int64_t place) {
    std::copy_n(this->f().data() + place, kGroupValues, packed_f_.data() + packed);
  });
  ranks_->gather(packed_f_.data(), first_packed_);
  const auto unpack = [&](std::int64_t packed, std::int64_t place) {
    std::copy_n(packed_f_.data() + packed, kGroupValues, this->f().data() + place);
  };
  for_groups(groups_, 0, first, unpack);
  for_groups(groups_, last, std::ssize(groups_), unpack);
}

template <class Real, class U>
void RankFields<Real, U>::set(const AlignedVector<double>& displacement,
                              const AlignedVector<double>& velocity) {
  Base::set(displacement, velocity);
  whole_ = true;
}

template <class Real, class U>
void RankFields<Real, U>::fetch() {
  if (whole_) return;
  ranks_->gather(this->u().data(), first_value_);
  ranks_->gather(this->v().data(), first_value_);
  if (this->q()) ranks_->gather(this->q()->values().data(), first_value_);
  for (std::size_t b = 0; this->law_state() && b < first_state_.size(); ++b)
    if (first_state_[b].back() > 0)
      ranks_->gather(this->law_state()->values(static_cast<int>(b)), first_state_[b]);
  whole_ = true;
}

template <class Real, class U>
void RankFields<Real, U>::internal_force() {
  fetch();
  Base::internal_force();
}

template <class Real, class U>
void RankFields<Real, U>::internal_force_and_move(const StepLoads& loads) {
  if (!whole_) exchange_halos();
  this->internal().move(stretches_[own_], this->update(), loads, this->force_fields());
  ranks_->exchange(carries_sent_, carries_received_);
  this->internal().add_carries(stretches_[own_], this->f().data());
  share_forces();
  whole_ = false;
  if (ranks_->spoils_copies()) spoil();
}

template <class Real, class U>
void RankFields<Real, U>::advance_lag(double dt) {
  if (!this->q()) return;
  if (whole_)
    Base::advance_lag(dt);
  else
    this->q()->advance(this->v().data(), dt, first_value_[own_] / 3, first_value_[own_ + 1] / 3);
}

/// Whoever reads another rank's values without fetching them is found out.
template <class Real, class U>
void RankFields<Real, U>::spoil() {
  const auto spoil_field = [](auto* field, std::int64_t place) {
    std::fill_n(field + place, kGroupValues,
                std::numeric_limits<std::remove_pointer_t<decltype(field)>>::quiet_NaN());
  };
  for (std::int64_t group = 0; group < first_value_.back() / kGroupValues; ++group) {
    const std::int64_t place = group * kGroupValues;
    if (place >= first_value_[own_] && place < first_value_[own_ + 1]) continue;
    if (this->q()) spoil_field(this->q()->values().data(), place);
    if (std::binary_search(groups_.begin(), groups_.end(), group)) continue;
    spoil_field(this->u().data(), place);
    spoil_field(this->v().data(), place);
    spoil_field(this->f().data(), place);
  }
}

template <class Real, class U>
void RankFields<Real, U>::list_state(StateList& list) {
  fetch();
  Base::list_state(list);
}

template class RankFields<double, double>;
template class RankFields<float, double>;
template class RankFields<float, float>;

}  // namespace tread
