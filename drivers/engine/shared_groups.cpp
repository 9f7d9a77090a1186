#include "drivers/engine/shared_groups.hpp"

#include <algorithm>
#include <array>

#include "core/index.hpp"

namespace tread {

namespace {

std::size_t group_of(std::int64_t slot) {
  return index(slot / kLanes);
}

std::vector<std::int64_t> marked(const GroupMarks& marks) {
  std::vector<std::int64_t> groups;
  for (std::int64_t group = 0; group < std::ssize(marks); ++group)
    if (marks[index(group)] != 0) groups.push_back(group);
  return groups;
}

}  // namespace

/// Ties at which other features act are of all ranks.
SharedGroups::SharedGroups(const Model& model, const RankCut& cut)
    : model_(&model),
      cut_(&cut),
      tied_(model.ties ? model.ties->tied_slots() : std::vector<TiedSlot>{}),
      all_ranks_(connected_groups(model)),
      loaded_(groups_of(model.mesh, model.loaded_slots())) {
  GroupMarks featured = surface_groups(model);
  near_ = marked(featured);
  add_marks(featured, all_ranks_);
  for (const auto& [secondary, primary] : tied_)
    if (featured[group_of(secondary)] != 0 || featured[group_of(primary)] != 0)
      all_ranks_[group_of(secondary)] = all_ranks_[group_of(primary)] = 1;
}

/// A tied node gets its motion from the primary nodes, and these need the forces of all that are tied to
/// them.
HeldGroups SharedGroups::held_by(int rank) const {
  HeldGroups held{all_ranks_, {}, {}};
  for (const TileStretch& stretch : cut_->stretches(rank))
    std::fill(held.moved.begin() + cut_->first_group(stretch.first),
              held.moved.begin() + cut_->first_group(stretch.last), 1);
  GroupMarks stations = held.moved;  // and, where tiles of others begin, one lane of theirs
  for (const Joint& joint : cut_->joints())
    if (joint.near == rank) std::fill_n(stations.begin() + joint.slot / kLanes, joint.nodes, 1);
  for (bool more = true; more;) {
    more = false;
    for (const auto& [secondary, primary] : tied_) {
      if (stations[group_of(secondary)] == 0 || held.moved[group_of(primary)] != 0) continue;
      held.moved[group_of(primary)] = stations[group_of(primary)] = 1;
      more = true;
    }
  }
  held.forced = held.moved;
  held.moved = stations;
  for (const auto& [secondary, primary] : tied_)
    if (held.moved[group_of(primary)] != 0) held.forced[group_of(secondary)] = 1;
  held.deferred = held.moved;
  for (std::int64_t group = 0; group < std::ssize(held.deferred); ++group)
    if (cut_->owner(group) == rank && loaded_[index(group)] == 0 && all_ranks_[index(group)] == 0)
      held.deferred[index(group)] = 0;
  return held;
}

std::vector<std::int64_t> SharedGroups::halo_of(int rank, const HeldGroups& held) const {
  GroupMarks moved = held.moved;
  if (rank == kContactRank)
    for (const std::int64_t group : near_) moved[index(group)] = 1;
  std::vector<std::int64_t> groups = marked(moved);
  std::erase_if(groups, [&](std::int64_t group) { return cut_->owner(group) == rank; });
  return groups;
}

void SharedGroups::follow(const BodyFrame& wheel, double ahead) {
  near_.clear();
  if (!model_->contact) return;
  const std::array<SurfacePart, 2> parts = model_->contact->near(wheel, ahead);
  const SurfacePair& surfaces = model_->contact->surfaces();
  const auto add = [this](std::int64_t group) { near_.push_back(group); };
  for_surface_groups(surfaces.rail(), surfaces.rail_profile(), parts[0], add);
  for_surface_groups(surfaces.wheel(), surfaces.wheel_profile(), parts[1], add);
  std::sort(near_.begin(), near_.end());
}

}  // namespace tread
