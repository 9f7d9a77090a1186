#include "drivers/engine/fields/patch_tiles.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "core/index.hpp"
#include "drivers/engine/model/restraints.hpp"

namespace tread {

namespace {

/// Groups on whose nodes ties, connectors, loads or restraints act.
GroupMarks taken_groups(const Model& model) {
  GroupMarks marks = tied_groups(model);
  add_marks(marks, connected_groups(model));
  for (const std::int64_t unknown : held_unknowns(model.mesh, model.restrained))
    marks[index(unknown / kGroupValues)] = 1;
  return marks;
}

}  // namespace

PatchTiles::PatchTiles(const Model& model, std::vector<unsigned char> joined)
    : model_(&model), joined_(std::move(joined)), first_tile_{0} {
  if (!model.contact) return;
  for (const SweptBlock& block : model.mesh.blocks)
    first_tile_.push_back(first_tile_.back() + block.tiles.size());
  taken_ = taken_groups(model);
  constexpr std::size_t kMost = 4;  // stretches about the patch: two a body where its tiles pass a full turn
  near_.reserve(kMost);
  elsewhere_.reserve(kMost + 1);
}

bool PatchTiles::find(const BodyFrame& wheel, double dt) {
  if (!model_->contact) return false;
  const Contact& contact = *model_->contact;
  const std::array<SurfacePart, 2> parts = contact.near(wheel, dt);
  const SurfacePair& surfaces = contact.surfaces();
  near_.clear();
  if (!add(contact.options().rail_block, surfaces.rail_profile(), parts[0]) ||
      !add(contact.options().wheel_block, surfaces.wheel_profile(), parts[1]))
    return false;
  list_others();
  return !elsewhere_.empty();
}

void PatchTiles::share(std::span<const TileStretch> own, std::vector<TileStretch>& near,
                       std::vector<TileStretch>& elsewhere) const {
  const auto common = [own](const std::vector<TileStretch>& of, std::vector<TileStretch>& found) {
    found.clear();
    for (const TileStretch& stretch : of)
      for (const TileStretch& part : own) {
        const TileStretch both{std::max(stretch.first, part.first), std::min(stretch.last, part.last)};
        if (both.first < both.last) found.push_back(both);
      }
  };
  common(near_, near);
  common(elsewhere_, elsewhere);
}

bool PatchTiles::add(int number, const SurfaceProfile& profile, const SurfacePart& part) {
  const SweptBlock& block = model_->mesh.blocks[index(number)];
  const auto all = static_cast<int>(block.tiles.size());
  const TileSpan span = tiles_of(block, part);
  bool apart = true;
  for (int i = 0; i < span.count; ++i) apart &= block.tiles[index((span.first + i) % all)].elements > 0;
  for_surface_groups(block, profile, part, [&](std::int64_t group) { apart &= taken_[index(group)] == 0; });
  if (!apart) return false;
  const std::size_t base = first_tile_[index(number)];
  const auto joins = [&](int tile) { return joined_[base + index((tile + all) % all)] != 0; };
  int first = span.first - 1;
  if (!block.closed) first = std::max(first, 0);
  if (joins(first - 1)) --first;
  int last = span.first + span.count;
  if (joins(last - 1)) ++last;
  if (last - first >= all) return false;
  const auto add_stretch = [&](int from, int to) {
    if (from < to) near_.push_back({base + index(from), base + index(to)});
  };
  if (first < 0) add_stretch(first + all, all);
  add_stretch(std::max(first, 0), std::min(last, all));
  if (last > all) add_stretch(0, last - all);
  return true;
}

void PatchTiles::list_others() {
  elsewhere_.assign(1, {0, first_tile_.back()});
  for (const TileStretch& stretch : near_) {
    const auto around = std::find_if(elsewhere_.begin(), elsewhere_.end(),
                                     [&](const TileStretch& of) { return of.holds(stretch.first); });
    const TileStretch behind{stretch.last, around->last};
    around->last = stretch.first;
    elsewhere_.insert(around + 1, behind);
  }
  std::erase_if(elsewhere_, [](const TileStretch& of) { return of.first == of.last; });
}

}  // namespace tread
