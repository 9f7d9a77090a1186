#include "drivers/engine/shared_groups.hpp"

#include <array>

#include "core/index.hpp"
#include "kernels/device/surface_copies.hpp"

namespace tread {

SharedGroups::SharedGroups(const Model& model, const std::vector<GroupMovers>& movers, int own)
    : model_(&model),
      always_(connected_groups(model)),
      own_(groups_of(model.mesh, model.loaded_slots())),
      shared_(surface_groups(model)) {
  add_marks(shared_, always_);
  if (model.ties) share_ties(shared_, movers);
  for (std::size_t group = 0; group < own_.size(); ++group)
    own_[group] = movers[group].beside == own || (own_[group] != 0 && movers[group].rank == own);
  add_marks(shared_, always_);
  deferred_ = always_;
  add_marks(deferred_, own_);
  if (model.ties) tie_items_ = model.ties->items_in(deferred_);
  add_marks(deferred_, shared_);
}

/// A tie whose nodes one rank moves is that rank's own. Where ranks meet or other features act, all need the
/// motion of the primary nodes, and for it the forces of all secondary ones on them.
void SharedGroups::share_ties(const GroupMarks& featured, const std::vector<GroupMovers>& movers) {
  const std::vector<TiedSlot> tied = model_->ties->tied_slots();
  const auto group = [](std::int64_t slot) { return index(slot / kLanes); };
  for (const TiedSlot& pair : tied)
    if (featured[group(pair.secondary)] != 0 || featured[group(pair.primary)] != 0 ||
        !movers[group(pair.secondary)].alone_with(movers[group(pair.primary)]))
      always_[group(pair.primary)] = 1;
  for (const TiedSlot& pair : tied)
    if (always_[group(pair.primary)] != 0) always_[group(pair.secondary)] = 1;
}

void SharedGroups::follow(const BodyFrame& wheel, double ahead) {
  shared_ = always_;
  if (model_->contact) {
    const std::array<SurfacePart, 2> parts = model_->contact->near(wheel, ahead);
    const SurfacePair& surfaces = model_->contact->surfaces();
    share_near(surfaces.rail(), surfaces.rail_profile(), parts[0]);
    share_near(surfaces.wheel(), surfaces.wheel_profile(), parts[1]);
  }
  deferred_ = shared_;
  add_marks(deferred_, own_);
}

void SharedGroups::share_near(const SweptBlock& block, const SurfaceProfile& profile,
                              const SurfacePart& part) {
  const TileSpan tiles = tiles_of(block, part);
  const auto all = static_cast<int>(block.tiles.size());
  for (int i = 0; i < tiles.count; ++i)
    for (int ordinal = part.first_node; ordinal < part.last_node; ++ordinal)
      shared_[index(block.base / kLanes + std::int64_t{(tiles.first + i) % all} * block.section.nodes() +
                    profile.node(ordinal))] = 1;
}

}  // namespace tread
