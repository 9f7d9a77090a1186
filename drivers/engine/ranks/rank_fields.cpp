#include "drivers/engine/ranks/rank_fields.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "core/error.hpp"
#include "core/index.hpp"
#include "core/math/hash.hpp"
#include "drivers/engine/fields/featured_nodes.hpp"
#include "drivers/engine/ranks/rank_shares.hpp"

namespace tread {

namespace {

TileShare share_of(const RankCut& cut, Ranks& ranks) {
  TileShare share{&ranks, cut.stretches(ranks.rank()), {}, {0}};
  for (int rank = 0; rank < cut.ranks(); ++rank) {
    for (const TileStretch& stretch : cut.stretches(rank))
      for (std::size_t tile = stretch.first; tile < stretch.last; ++tile) share.by_rank.push_back(tile);
    share.first.push_back(std::ssize(share.by_rank));
  }
  return share;
}

/// By the ranks' shares; where they have none yet, by the expected ones, which they keep.
template <class Internal>
RankCut cut_of(const Model& model, const Internal& internal, Ranks& ranks, Borders borders) {
  const std::vector<TileWork> work = tile_work(model, internal);
  if (ranks.shares.empty()) ranks.shares = expected_shares(model, work, ranks.count());
  RankCut cut(model, work, ranks.shares, borders);
  ranks.dealt = dealt_shares(cut, work);
  return cut;
}

}  // namespace

template <class Real, class U>
RankFields<Real, U>::RankFields(const Model& model, std::shared_ptr<Ranks> ranks, Borders borders)
    : Base(model),
      ranks_(std::move(ranks)),
      borders_(borders),
      cut_(cut_of(model, this->internal(), *ranks_, borders)),
      tiles_(share_of(cut_, *ranks_)),
      own_tiles_(cut_.tiles(), 0),
      shared_(model, cut_),
      held_(shared_.held_by(ranks_->rank())),
      patch_forces_(cut_, *ranks_, RankMessage::Content::patch),
      other_forces_(cut_, *ranks_, RankMessage::Content::rest),
      patch_tiles_(model, this->joined_tiles()) {
  for (const TileStretch& stretch : tiles_.own)
    for (std::size_t tile = stretch.first; tile < stretch.last; ++tile) own_tiles_[tile] = 1;
  if (model.contact && !solves()) model.contact->run_on(&contact_elsewhere_.emplace(&*model.contact));
  for (int rank = 0; rank < ranks_->count(); ++rank) {
    if (rank == ranks_->rank()) continue;
    const HeldGroups there = shared_.held_by(rank);
    patch_forces_.add(rank, there, held_);
    other_forces_.add(rank, there, held_);
    if (solves() || rank == kContactRank) patch_motion_.add(rank, shared_.near(), solves() ? there : held_);
    for (std::size_t group = 0; group < there.forced.size(); ++group)
      if (there.forced[group] != 0 && owns(static_cast<std::int64_t>(group))) held_.deferred[group] = 1;
  }
  if (model.ties) tie_items_ = model.ties->items_in(held_.deferred);
  this->take_masses();
  take_near();
}

/// The rank that solves the patch moves nodes wherever the wheel comes.
template <class Real, class U>
std::span<const unsigned char> RankFields<Real, U>::groups_with_mass() const {
  return solves() ? std::span<const unsigned char>{} : std::span<const unsigned char>(held_.moved);
}

template <class Real, class U>
bool RankFields<Real, U>::follow_patch(const BodyFrame& wheel, double dt) {
  constexpr int kSteps = 70;
  if (steps_left_ == 0) {
    choose_patch(wheel, (kSteps + 1) * dt);
    steps_left_ = kSteps;
  }
  --steps_left_;
  beside_ = false;
  return apart_;
}

/// Chooses the nodes about the patch that kContactRank moves, for some time, and gives it their motion.
template <class Real, class U>
void RankFields<Real, U>::choose_patch(const BodyFrame& wheel, double ahead) {
  shared_.follow(wheel, ahead);
  bring(shared_.near());
  take_near();
  share_groups(this->u().data(), shared_.near());
  share_groups(this->v().data(), shared_.near());
  patch_chosen();
  apart_ = patch_tiles_.find(wheel, ahead);
  if (apart_) patch_tiles_.share(tiles_.own, near_, elsewhere_);
}

template <class Real, class U>
void RankFields<Real, U>::take_near() {
  moved_ = held_.moved;
  deferred_ = held_.deferred;
  for (const std::int64_t group : shared_.near()) {
    if (solves()) moved_[index(group)] = 1;
    deferred_[index(group)] = 1;
  }
  knows_held_ = false;
  this->update().defer_only(deferred_, shared_.near());
  patch_motion_.follow(shared_.near());
  patch_forces_.follow(shared_.near());
  // With halos the contact is never solved beside elements, whose forces its motion would go with.
  const bool beside = borders_ == Borders::joints;
  other_forces_.follow(shared_.near(), beside ? std::span<const RankSegment>(patch_motion_.segments())
                                              : std::span<const RankSegment>{});
}

template <class Real, class U>
void RankFields<Real, U>::spread_patch(bool measured) {
  if (!this->model().contact || beside_) return;
  if (solves()) patch_motion_.pack(this->u().data(), this->v().data());
  exchange_one_way(solves(), patch_motion_.segments());
  if (!solves()) patch_motion_.unpack(this->u().data(), this->v().data());
  if (measured) spread_points();
}

/// For looks at the energies and samples.
template <class Real, class U>
void RankFields<Real, U>::spread_points() {
  Contact& contact = *this->model().contact;
  struct Head {
    std::int64_t points;
    double frictional_work, contact_loss;
  } head = {std::ssize(contact.points()), contact.frictional_work(), contact.contact_loss()};
  ranks_->broadcast(std::as_writable_bytes(std::span(&head, 1)));
  std::vector<ContactPoint> points = contact.points();
  points.resize(index(head.points));
  ranks_->broadcast(std::as_writable_bytes(std::span(points)));
  if (solves()) return;
  contact.take_points(points, head.frictional_work, head.contact_loss);
  contact.add_forces(this->force_);
}

/// Gives each rank the values of these groups, as their tiles' ranks have them.
template <class Real, class U>
template <class T>
void RankFields<Real, U>::share_groups(T* field, const std::vector<std::int64_t>& groups) {
  if (groups.empty()) return;
  std::vector<std::int64_t> ordered = groups;
  std::stable_sort(ordered.begin(), ordered.end(),
                   [&](std::int64_t a, std::int64_t b) { return cut_.owner(a) < cut_.owner(b); });
  std::vector<std::int64_t> first(index(cut_.ranks()) + 1, 0);
  for (const std::int64_t group : ordered) first[index(cut_.owner(group)) + 1] += kGroupValues;
  for (std::size_t rank = 0; rank + 1 < first.size(); ++rank) first[rank + 1] += first[rank];
  AlignedVector<T> packed(ordered.size() * kGroupValues);
  for_groups(ordered, 0, std::ssize(ordered), [&](std::int64_t at, std::int64_t place) {
    std::copy_n(field + place, kGroupValues, packed.data() + at);
  });
  ranks_->gather(packed.data(), first);
  for_groups(ordered, 0, std::ssize(ordered), [&](std::int64_t at, std::int64_t place) {
    std::copy_n(packed.data() + at, kGroupValues, field + place);
  });
}

template <class Real, class U>
void RankFields<Real, U>::show(const WatchedNodes& nodes) {
  bring(nodes.groups());
  share_groups(this->u().data(), nodes.groups());
  share_groups(this->v().data(), nodes.groups());
  if (this->q()) share_groups(this->q()->values().data(), nodes.groups());
  if (!nodes.tiles().empty()) send_law_state(Way::to_rank_0, cut_.by_rank(nodes.tiles()));
}

template <class Real, class U>
void RankFields<Real, U>::set(const AlignedVector<double>& displacement,
                              const AlignedVector<double>& velocity) {
  Base::set(displacement, velocity);
  gathered_ = true;
  steps_left_ = 0;
}

template <class Real, class U>
void RankFields<Real, U>::fetch() {
  if (gathered_) return;
  send_all_tiles(Way::to_rank_0);
  gathered_ = true;
}

template <class Real, class U>
void RankFields<Real, U>::spread() {
  require_one_cut();
  send_all_tiles(Way::from_rank_0);
  std::vector<Halo> halos;  // of those ranks with which this one exchanges
  for (int rank = 1; ranks_->rank() == 0 && rank < cut_.ranks(); ++rank)
    halos.push_back({rank, shared_.halo_of(rank, shared_.held_by(rank))});
  if (ranks_->rank() != 0) halos.push_back({0, shared_.halo_of(ranks_->rank(), held_)});
  spread_halos(this->u().data(), halos);
  spread_halos(this->v().data(), halos);
  if (this->q()) spread_halos(this->q()->values().data(), halos);
  gathered_ = true;
}

template <class Real, class U>
void RankFields<Real, U>::require_one_cut() {
  Hash hash;
  for (std::size_t tile = 0; tile < cut_.tiles(); ++tile)
    hash.add(static_cast<std::uint64_t>(cut_.rank_of(tile)));
  std::uint64_t of_rank_0 = hash.value();
  ranks_->broadcast(std::as_writable_bytes(std::span(&of_rank_0, 1)));
  if (of_rank_0 != hash.value())
    throw ResourceError(
        fmt::format("rank {} cuts the mesh otherwise than rank 0: their machines have different versions of "
                    "METIS; install the same one on all of them",
                    ranks_->rank()));
}

template <class Real, class U>
void RankFields<Real, U>::send_all_tiles(Way way) {
  ByRank tiles;
  for (int rank = 0; rank < cut_.ranks(); ++rank) {
    std::vector<TileStretch>& of_rank = tiles.emplace_back(cut_.stretches(rank));
    const std::vector<TileStretch>& halo = cut_.halo(rank);
    if (way == Way::from_rank_0) of_rank.insert(of_rank.end(), halo.begin(), halo.end());
  }
  const auto of_tile = [this](std::size_t tile) { return kGroupValues * cut_.first_group(tile); };
  send_tiles(way, tiles, this->u().data(), of_tile);
  send_tiles(way, tiles, this->v().data(), of_tile);
  if (this->q()) send_tiles(way, tiles, this->q()->values().data(), of_tile);
  send_law_state(way, tiles);
}

/// Values of the other ranks' tiles among these. Those of [first, last) lie at [place(first), place(last)).
template <class Real, class U>
template <class T, class Place>
void RankFields<Real, U>::send_tiles(Way way, const ByRank& tiles, T* values, const Place& place) {
  std::vector<RankSegment> of_tiles;
  for (int rank = 1; rank < cut_.ranks(); ++rank) {
    if (ranks_->rank() != 0 && ranks_->rank() != rank) continue;
    for (const TileStretch& stretch : tiles[index(rank)])
      of_tiles.push_back(
          {ranks_->rank() == 0 ? rank : 0,
           std::as_writable_bytes(std::span(values + place(stretch.first), values + place(stretch.last)))});
  }
  const bool sends = (way == Way::from_rank_0) == (ranks_->rank() == 0);
  exchange_one_way(sends, of_tiles);
}

template <class Real, class U>
void RankFields<Real, U>::send_law_state(Way way, const ByRank& tiles) {
  for_law_blocks(
      [&](int b, const auto& place) { send_tiles(way, tiles, this->law_state()->values(b), place); });
}

template <class Real, class U>
template <class T>
void RankFields<Real, U>::spread_halos(T* field, const std::vector<Halo>& halos) {
  const bool sends = ranks_->rank() == 0;
  std::vector<AlignedVector<T>> packed;
  std::vector<RankSegment> segments;
  for (const Halo& halo : halos) {
    AlignedVector<T>& values = packed.emplace_back(halo.groups.size() * kGroupValues);
    segments.push_back({halo.other, std::as_writable_bytes(std::span(values))});
    if (!sends) continue;
    for_groups(halo.groups, 0, std::ssize(halo.groups), [&](std::int64_t at, std::int64_t place) {
      std::copy_n(field + place, kGroupValues, values.data() + at);
    });
  }
  exchange_one_way(sends, segments);
  if (sends) return;
  const std::vector<std::int64_t>& groups = halos.front().groups;
  for_groups(groups, 0, std::ssize(groups), [&](std::int64_t at, std::int64_t place) {
    std::copy_n(packed.front().data() + at, kGroupValues, field + place);
  });
}

template <class Real, class U>
void RankFields<Real, U>::exchange_one_way(bool sends, const std::vector<RankSegment>& segments) {
  if (sends)
    ranks_->exchange(segments, {});
  else
    ranks_->exchange({}, segments);
}

template <class Real, class U>
void RankFields<Real, U>::internal_force_and_move(const StepLoads& loads, bool measured) {
  if (measured)
    this->internal().internal_force(tiles_.own, this->force_fields());
  else
    this->internal().move(tiles_.own, this->update(), loads, this->force_fields());
  exchange_forces();
}

/// Forces of the patch go to kContactRank before the elements elsewhere; its motion comes back with the other
/// forces.
template <class Real, class U>
void RankFields<Real, U>::move_with_contact(const StepLoads& loads, double time) {
  const auto search = [&](std::int64_t first, std::int64_t last) {
    this->search_contact(loads, time, first, last);
  };
  const auto then = [&] {
    exchange_patch_forces();
    if (!solves()) return;
    move_patch(loads);
    this->solve_contact(loads);
    patch_motion_.pack(this->u().data(), this->v().data());
  };
  const int columns = solves() ? this->model().contact->columns() : 0;
  this->internal().move({near_, elsewhere_, columns, search, then}, this->update(), loads,
                        this->force_fields());
  exchange_other_forces();
  beside_ = true;
  if (solves()) return;
  patch_motion_.unpack(this->u().data(), this->v().data());
  contact_elsewhere_->resolve();
}

template <class Real, class U>
void RankFields<Real, U>::exchange_patch_forces() {
  if (solves())
    patch_forces_.receive(carries(), this->f().data());
  else
    patch_forces_.post(carries(), this->f().data());
}

template <class Real, class U>
void RankFields<Real, U>::exchange_other_forces() {
  other_forces_.exchange(carries(), this->f().data());
  gathered_ = false;
  if (ranks_->spoils_copies()) spoil();
}

template <class Real, class U>
void RankFields<Real, U>::move_patch(const StepLoads& loads) {
  this->update().move_apart(loads, {this->u().data(), this->v().data(), this->f().data()});
}

template <class Real, class U>
void RankFields<Real, U>::move_rest(const StepLoads& loads, bool measured) {
  if (measured)
    this->update().move_rest(loads, {this->u().data(), this->v().data(), this->f().data()}, own_tiles_);
  else
    Base::move_rest(loads, false);
  if (!beside_ && solves()) move_patch(loads);
}

template <class Real, class U>
void RankFields<Real, U>::advance_lag(double dt) {
  if (!this->q()) return;
  const auto advance = [&](std::int64_t first, std::int64_t last) {
    this->q()->advance(this->v().data(), dt, first * kLanes, last * kLanes);
  };
  for (const auto* stretches : {&own_stretches(), &halo()}) cut_.for_groups(*stretches, advance);
  for (const Joint& joint : cut_.joints())
    if (joint.near == ranks_->rank()) advance(joint.slot / kLanes, joint.slot / kLanes + joint.nodes);
}

/// Whoever reads another rank's values without having got them is found out.
template <class Real, class U>
void RankFields<Real, U>::spoil() {
  const auto spoil_lanes = [](auto* field, std::int64_t group, int first) {
    for (int c = 0; c < 3; ++c)
      for (int lane = first; lane < kLanes; ++lane)
        field[group * kGroupValues + c * kLanes + lane] =
            std::numeric_limits<std::remove_pointer_t<decltype(field)>>::quiet_NaN();
  };
  const std::vector<std::int64_t>& near = shared_.near();
  std::vector<unsigned char> first_lane(moved_.size(), 0);  // that this rank does not move
  for (const Joint& joint : cut_.joints())
    if (joint.near == ranks_->rank()) std::fill_n(first_lane.begin() + joint.slot / kLanes, joint.nodes, 1);
  cut_.for_groups(halo(), [&](std::int64_t first, std::int64_t last) {
    std::fill(first_lane.begin() + first, first_lane.begin() + last, kLanes);
  });
  for (std::int64_t group = 0; group < std::ssize(moved_); ++group) {
    if (owns(group)) continue;
    const int first = first_lane[index(group)];
    const bool complete =
        held_.forced[index(group)] != 0 || (solves() && std::binary_search(near.begin(), near.end(), group));
    if (this->q()) spoil_lanes(this->q()->values().data(), group, first);
    if (!complete) spoil_lanes(this->f().data(), group, first);
    if (complete && moved_[index(group)] != 0) continue;
    spoil_lanes(this->u().data(), group, first);
    spoil_lanes(this->v().data(), group, first);
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
