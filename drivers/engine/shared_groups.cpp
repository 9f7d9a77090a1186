#include "drivers/engine/shared_groups.hpp"

#include <algorithm>
#include <functional>

#include "core/index.hpp"
#include "drivers/engine/featured_nodes.hpp"
#include "kernels/device/surface_copies.hpp"

namespace tread {

namespace {

/// Adds marks to others.
void mark(std::vector<unsigned char>& marks, const std::vector<unsigned char>& more) {
  std::transform(marks.begin(), marks.end(), more.begin(), marks.begin(), std::bit_or<>());
}

}  // namespace

SharedGroups::SharedGroups(const Model& model, const std::vector<GroupMovers>& movers, int own)
    : model_(&model),
      always_(groups_of(model.mesh, connected_slots(model))),
      own_(groups_of(model.mesh, model.loaded_slots())),
      shared_(groups_of(model.mesh, surface_slots(model))) {
  if (model.ties) share_ties(movers);
  for (std::size_t group = 0; group < own_.size(); ++group)
    own_[group] = movers[group].beside == own || (own_[group] != 0 && movers[group].rank == own);
  mark(shared_, always_);
  deferred_ = always_;
  mark(deferred_, own_);
  if (model.ties) tie_items_ = model.ties->items_in(deferred_);
  mark(deferred_, shared_);
}

/// A tie whose nodes one rank moves is that rank's own. Where ranks meet or other features act, all need the
/// motion of the primary nodes, and for it the forces of all secondary ones on them.
void SharedGroups::share_ties(const std::vector<GroupMovers>& movers) {
  std::vector<unsigned char> featured = groups_of(model_->mesh, surface_slots(*model_));
  mark(featured, always_);
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
    share_near(model_->contact->options().rail_block, parts[0]);
    share_near(model_->contact->options().wheel_block, parts[1]);
  }
  deferred_ = shared_;
  mark(deferred_, own_);
}

void SharedGroups::share_near(int block, const SurfacePart& part) {
  const SweptBlock& swept = model_->mesh.blocks[index(block)];
  const SurfacePair& surfaces = model_->contact->surfaces();
  const SurfaceProfile& profile =
      block == model_->contact->options().rail_block ? surfaces.rail_profile() : surfaces.wheel_profile();
  const TileSpan tiles = tiles_of(swept, part);
  const auto all = static_cast<int>(swept.tiles.size());
  for (int i = 0; i < tiles.count; ++i)
    for (int ordinal = part.first_node; ordinal < part.last_node; ++ordinal)
      shared_[index(swept.base / kLanes + std::int64_t{(tiles.first + i) % all} * swept.section.nodes() +
                    profile.node(ordinal))] = 1;
}

}  // namespace tread
