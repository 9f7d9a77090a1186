#include "kernels/device/block_march.hpp"

#include <algorithm>
#include <cstddef>
#include <span>

#include "core/index.hpp"

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

template <class Real>
BlockMarch<Real>::BlockMarch(Device& device, const BlockElements<Real>& elements, double damping)
    : swept_(&elements.block()) {
  const MarchCut sizes = device.cut();
  const SectionCut cut = cut_section(swept_->section, elements.plan(), sizes);
  block_.closed = swept_->closed;
  block_.colours = cut.colours;
  block_.quads = static_cast<int>(swept_->section.quads.size());
  block_.section_nodes = swept_->section.nodes();
  block_.origin_node = elements.origin_node();
  block_.parts = static_cast<int>(cut.parts.size());
  block_.run_tiles = std::max(1, sizes.run_tiles);
  block_.part = keep(device, cut.parts);
  block_.part_nodes = keep(device, cut.nodes);
  block_.part_quads = keep(device, cut.quads);
  block_.first_of_colour = keep(device, cut.first_of_colour);
  for (const MarchPart& part : cut.parts) {
    block_.most_nodes = std::max(block_.most_nodes, part.nodes);
    block_.most_quads = std::max(block_.most_quads, part.quads);
    block_.most_own_nodes = std::max(block_.most_own_nodes, part.own_nodes);
  }
  block_.damping = static_cast<Real>(damping);
  build_tiles(device);
  build_coefficients(device, elements);
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

template <class Real>
const MarchBlock<Real>& BlockMarch<Real>::at(const StepLoads& loads, MarchRuns runs) {
  block_.marched = runs;
  block_.step = step_constants<Real>(*swept_, loads);
  block_.gravity = loads.gravity;
  block_.frame_angle = loads.frame.angle;
  return block_;
}

template <class Real>
MarchBlock<Real> BlockMarch<Real>::in_tiles(const StepLoads& loads, MarchRuns runs) {
  MarchBlock<Real> block = at(loads, runs);
  block.run_tiles = 1;
  block.marched.first = runs.first * block_.run_tiles;
  block.marched.count = runs.count * block_.run_tiles;
  // The last run of the block may have fewer tiles.
  if (runs.first + runs.count >= block_.runs())
    block.marched.count -= block_.runs() * block_.run_tiles - block_.tiles;
  return block;
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
  const int from = (first + all) % all / block_.run_tiles;
  const int to = last % all / block_.run_tiles;
  const int count = (to - from + block_.runs()) % block_.runs() + 1;
  // A stretch that begins and ends in one run lies in it, or passes all others.
  const bool around = count == 1 && last - first >= block_.run_tiles;
  return {from, around ? block_.runs() : count};
}

template class BlockMarch<double>;
template class BlockMarch<float>;

}  // namespace tread
