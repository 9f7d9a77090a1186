#include "drivers/engine/ranks/shared_groups.hpp"

#include <algorithm>
#include <array>

#include "core/index.hpp"
#include "core/marks.hpp"

namespace tread {

namespace {

/// Each pair once.
std::vector<TiedGroups> tied_pairs(const Model& model) {
  std::vector<TiedGroups> pairs;
  if (!model.ties) return pairs;
  model.ties->for_each_pair([&](std::int64_t secondary, std::int64_t primary) {
    const TiedGroups pair{secondary / kLanes, primary / kLanes};
    const auto lately = std::min(std::ssize(pairs), std::ptrdiff_t{4});  // the lane before has the same four
    if (std::find(pairs.end() - lately, pairs.end(), pair) == pairs.end()) pairs.push_back(pair);
  });
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  pairs.shrink_to_fit();
  return pairs;
}

}  // namespace

/// Ties at which other features act are of all ranks.
SharedGroups::SharedGroups(const Model& model, const RankCut& cut)
    : model_(&model),
      cut_(&cut),
      tied_(tied_pairs(model)),
      all_ranks_(connected_groups(model)),
      loaded_(groups_of(model.mesh, model.loaded_slots())) {
  GroupMarks featured = surface_groups(model);
  near_ = marked(featured);
  add_marks(featured, all_ranks_);
  for (const auto& [secondary, primary] : tied_)
    if (featured[index(secondary)] != 0 || featured[index(primary)] != 0)
      all_ranks_[index(secondary)] = all_ranks_[index(primary)] = 1;
}

/// A tied node gets its motion from the primary nodes, and these need the forces of all that are tied to
/// them.
HeldGroups SharedGroups::held_by(int rank) const {
  HeldGroups held{all_ranks_, {}, {}};
  for (const auto* stretches : {&cut_->stretches(rank), &cut_->halo(rank)})
    cut_->for_groups(*stretches, [&](std::int64_t first, std::int64_t last) {
      std::fill(held.moved.begin() + first, held.moved.begin() + last, 1);
    });
  GroupMarks stations = held.moved;  // and, where tiles of others begin, one lane of theirs
  for (const Joint& joint : cut_->joints())
    if (joint.near == rank) std::fill_n(stations.begin() + joint.slot / kLanes, joint.nodes, 1);
  for (bool more = true; more;) {
    more = false;
    for (const auto& [secondary, primary] : tied_) {
      if (stations[index(secondary)] == 0 || held.moved[index(primary)] != 0) continue;
      held.moved[index(primary)] = stations[index(primary)] = 1;
      more = true;
    }
  }
  held.forced = held.moved;
  held.moved = stations;
  for (const auto& [secondary, primary] : tied_)
    if (held.moved[index(primary)] != 0) held.forced[index(secondary)] = 1;
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
