#include "kernels/device/block_march.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <string>
#include <type_traits>
#include <utility>

#include "core/error.hpp"
#include "core/index.hpp"
#include "kernels/device/march_node.hpp"
#include "kernels/material/laws.hpp"

namespace tread {

template <class Real>
template <class T, class Allocator>
const T* BlockMarch<Real>::keep(Device& device, const std::vector<T, Allocator>& values) {
  if (values.empty()) return nullptr;
  const auto array =
      std::make_shared<DeviceArray<T>>(device, std::span<const T>(values.data(), values.size()));
  kept_.push_back(array);
  return array->data();
}

namespace {

/// For each place of a quad, how many tiles have an element of it that touches moved nodes.
template <class Real>
std::vector<int> moved_elements(const BlockElements<Real>& elements) {
  const auto moved = elements.moved_nodes();
  std::vector<int> of_place(moved.perturbed.empty() ? 0 : elements.plan().quads.size(), 0);
  for (std::size_t i = 0; i < moved.perturbed.size(); ++i)
    if (moved.perturbed[i] != 0) ++of_place[i % of_place.size()];
  return of_place;
}

}  // namespace

template <class Real>
BlockMarch<Real>::BlockMarch(Device& device, const BlockElements<Real>& elements, double damping,
                             std::span<const int> marks)
    : swept_(&elements.block()) {
  constexpr std::int64_t kMostValues = std::int64_t{1} << 32;  // MarchPlace numbers them
  if (const std::int64_t values = 3 * (swept_->base + swept_->slots()); values > kMostValues)
    throw ResourceError("block \"" + swept_->name + "\": the fields up to it have " + std::to_string(values) +
                        " values, and a device takes " + std::to_string(kMostValues) +
                        "; choose larger elements, or --device cpu");
  const SectionCut cut = choose_cut(device, elements);
  block_.closed = swept_->closed;
  block_.quads = static_cast<int>(swept_->section.quads.size());
  block_.section_nodes = swept_->section.nodes();
  block_.origin_node = elements.origin_node();
  block_.parts = static_cast<int>(cut.parts.size());
  block_.part = keep(device, cut.parts);
  block_.part_nodes = keep(device, cut.nodes);
  block_.part_quads = keep(device, cut.quads);
  block_.first_of_colour = keep(device, cut.first_of_colour);
  block_.damping = static_cast<Real>(damping);
  build_tiles(device);
  build_coefficients(device, elements);
  find_awaiting(device, cut, marks);
}

/// A team that lacks memory for the largest part gets parts of fewer quads.
template <class Real>
SectionCut BlockMarch<Real>::choose_cut(const Device& device, const BlockElements<Real>& elements) {
  MarchCut sizes = device.cut();
  block_.run_tiles = std::max(1, sizes.run_tiles);
  const std::vector<int> moved = moved_elements(elements);
  for (;;) {
    SectionCut cut = cut_section(swept_->section, elements.plan(), sizes, moved);
    const auto most = [&](int MarchPart::*number) { return std::ranges::max(cut.parts, {}, number).*number; };
    block_.colours = cut.colours;
    block_.most_nodes = most(&MarchPart::nodes);
    block_.most_quads = most(&MarchPart::quads);
    block_.most_own_nodes = most(&MarchPart::own_nodes);
    const std::size_t needed =
        room_bytes(block_, is_linear(elements.law()), swept_->sweep == Sweep::revolved);
    if (needed <= device.team_bytes() || sizes.part_quads <= 1) return cut;
    sizes.part_quads = std::max(1, static_cast<int>(index(sizes.part_quads) * device.team_bytes() / needed));
  }
}

template <class Real>
void BlockMarch<Real>::build_tiles(Device& device) {
  block_.first_group = swept_->base / kLanes;
  block_.tiles = static_cast<int>(swept_->tiles.size());
  block_.tile = keep(device, swept_->tiles);
  if (swept_->sweep == Sweep::extruded) return;
  std::vector<Real> radius(swept_->section.q.begin(), swept_->section.q.end());
  block_.radius = keep(device, radius);
  block_.angle = keep(device, swept_->stations);
}

template <class Real>
void BlockMarch<Real>::build_coefficients(Device& device, const BlockElements<Real>& elements) {
  std::vector<HalfPitch> half_pitch;
  AlignedVector<SweptConstants<Real>> constants;
  AlignedVector<std::byte> laws;
  for (const auto& of_class : elements.classes()) {
    half_pitch.push_back({of_class.cosine, of_class.sine});
    constants.insert(constants.end(), of_class.constants.begin(), of_class.constants.end());
    laws.insert(laws.end(), of_class.laws.begin(), of_class.laws.end());
  }
  block_.half_pitch = keep(device, half_pitch);
  block_.constants = keep(device, constants);
  block_.laws = keep(device, laws);
  const auto moved = elements.moved_nodes();
  if (moved.perturbed.empty()) return;
  block_.row = keep(device, moved.row);
  block_.perturbed = keep(device, moved.perturbed);
  block_.shifted = keep(device, moved.shifted);
  block_.shifts = keep(device, moved.shifts);
}

/// A run reads a tile before and a tile after its own, and the translation's node too [NodeEnds].
template <class Real>
bool BlockMarch<Real>::touches_host(const SectionCut& cut, const MarchPart& part, int run,
                                    std::span<const int> marks) const {
  if (marks.empty()) return false;
  const int first = run * block_.run_tiles - 1;
  const int last = std::min((run + 1) * block_.run_tiles, block_.tiles);
  for (int t = first; t <= last; ++t) {
    if (block_.closed == 0 && (t < 0 || t == block_.tiles)) continue;
    const int tile = (t + block_.tiles) % block_.tiles;
    const std::int64_t group = block_.first_group + std::int64_t{tile} * block_.section_nodes;
    if (std::is_same_v<Real, float> && marks[index(group + block_.origin_node)] >= 0) return true;
    for (int node = 0; node < part.nodes; ++node)
      if (marks[index(group + cut.nodes[index(part.first_node + node)])] >= 0) return true;
  }
  return false;
}

template <class Real>
void BlockMarch<Real>::find_awaiting(Device& device, const SectionCut& cut, std::span<const int> marks) {
  std::vector<int> awaiting;
  std::vector<int> others;
  awaits_host_.assign(index(block_.runs()), 0);
  for (int run = 0; run < block_.runs(); ++run)
    for (int part = 0; part < block_.parts; ++part) {
      if (!touches_host(cut, cut.parts[index(part)], run, marks)) {
        others.push_back(run * block_.parts + part);
        continue;
      }
      awaits_host_[index(run)] = 1;
      const MarchRuns tiles = as_tiles({run, 1});
      for (int tile = tiles.first; tile < tiles.first + tiles.count; ++tile)
        awaiting.push_back(tile * block_.parts + part);
    }
  awaiting_ = DeviceArray<int>(device, std::span<const int>(awaiting));
  if (!awaiting.empty()) others_ = DeviceArray<int>(device, std::span<const int>(others));
}

template <class Real>
bool BlockMarch<Real>::awaits_host(MarchRuns runs) const {
  for (int i = 0; i < runs.count; ++i)
    if (awaits_host_[index((runs.first + i) % block_.runs())] != 0) return true;
  return false;
}

template <class Real>
const MarchBlock<Real>& BlockMarch<Real>::at(const StepLoads& loads) {
  block_.marched = {0, block_.runs()};
  block_.step = step_constants<Real>(swept_->sweep, loads);
  block_.gravity = loads.gravity;
  block_.frame_angle = loads.frame.angle;
  return block_;
}

/// The last run of the block may have fewer tiles.
template <class Real>
MarchRuns BlockMarch<Real>::as_tiles(MarchRuns runs) const {
  const int missing = block_.runs() * block_.run_tiles - block_.tiles;
  const bool last = runs.first + runs.count >= block_.runs();
  return {runs.first * block_.run_tiles, runs.count * block_.run_tiles - (last ? missing : 0)};
}

template <class Real>
MarchBlock<Real> BlockMarch<Real>::in_tiles(const StepLoads& loads, MarchRuns runs) {
  MarchBlock<Real> block = at(loads);
  block.run_tiles = 1;
  block.marched = runs.count > 0 ? as_tiles(runs) : MarchRuns{};
  return block;
}

template <class Real>
MarchBlock<Real> BlockMarch<Real>::awaiting(const StepLoads& loads, MarchRuns near) {
  MarchBlock<Real> block = in_tiles(loads, near);
  block.left_out = block.marched;
  return listed(block, awaiting_);
}

template <class Real>
MarchBlock<Real> BlockMarch<Real>::beyond(const StepLoads& loads, MarchRuns near) {
  MarchBlock<Real> block = at(loads);
  if (!awaits_host()) {
    block.marched = {(near.first + near.count) % block_.runs(), block_.runs() - near.count};
    return block;
  }
  block.left_out = near;
  return listed(block, others_);
}

template <class Real>
void BlockMarch<Real>::choose(Device& device, std::span<const ChosenTile> tiles) {
  std::vector<int> of_runs;
  std::vector<int> of_tiles;
  for (int run = 0; run < block_.runs(); ++run) {
    const MarchRuns in_run = as_tiles({run, 1});
    const auto of_run = tiles.subspan(index(in_run.first), index(in_run.count));
    const bool whole =
        std::all_of(of_run.begin(), of_run.end(), [](ChosenTile tile) { return tile == ChosenTile::yes; });
    for (int part = 0; part < block_.parts; ++part) {
      if (whole) of_runs.push_back(run * block_.parts + part);
      for (int i = 0; !whole && i < in_run.count; ++i)
        if (of_run[index(i)] != ChosenTile::no) of_tiles.push_back((in_run.first + i) * block_.parts + part);
    }
  }
  chosen_runs_ = DeviceArray<int>(device, std::span<const int>(of_runs));
  chosen_tiles_ = DeviceArray<int>(device, std::span<const int>(of_tiles));
}

template <class Real>
MarchBlock<Real> BlockMarch<Real>::chosen_runs(const StepLoads& loads) {
  return listed(at(loads), chosen_runs_);
}

template <class Real>
MarchBlock<Real> BlockMarch<Real>::chosen_tiles(const StepLoads& loads) {
  return listed(in_tiles(loads, {}), chosen_tiles_);
}

/// A run reads a tile before and a tile after its own.
template <class Real>
MarchRuns BlockMarch<Real>::near(TileSpan tiles) const {
  const int all = block_.tiles;
  if (tiles.count + 2 >= all) return {0, block_.runs()};
  int first = tiles.first - 1;
  int last = tiles.first + tiles.count;
  if (block_.closed == 0) {
    first = std::max(first, 0);
    last = std::min(last, all - 1);
  }
  first = (first + all) % all;
  last %= all;
  const int from = first / block_.run_tiles;
  const int to = last / block_.run_tiles;
  const int count = (to - from + block_.runs()) % block_.runs() + 1;
  // A stretch that begins and ends in one run lies in it, or passes all others.
  const bool around = count == 1 && first > last;
  return {from, around ? block_.runs() : count};
}

template class BlockMarch<double>;
template class BlockMarch<float>;

}  // namespace tread
