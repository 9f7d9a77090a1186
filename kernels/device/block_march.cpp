#include "kernels/device/block_march.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>

#include "core/index.hpp"

namespace tread {

namespace {

constexpr std::uint32_t kMostPlaces = (1U << 27) - 1;  ///< of MarchQuad

/// Halves a list of quads until no part has more than `most`.
void halve(const std::vector<std::array<double, 2>>& centre, std::span<int> quads, int most,
           std::vector<std::span<int>>& parts) {
  if (std::ssize(quads) <= most) {
    parts.push_back(quads);
    return;
  }
  std::array<double, 2> extent{};
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const auto [low, high] = std::minmax_element(quads.begin(), quads.end(), [&](int a, int b) {
      return centre[index(a)][axis] < centre[index(b)][axis];
    });
    extent[axis] = centre[index(*high)][axis] - centre[index(*low)][axis];
  }
  const std::size_t axis = extent[0] >= extent[1] ? 0 : 1;
  std::sort(quads.begin(), quads.end(), [&](int a, int b) {
    const double x = centre[index(a)][axis];
    const double y = centre[index(b)][axis];
    return x != y ? x < y : a < b;
  });
  const std::size_t half = quads.size() / 2;
  halve(centre, quads.first(half), most, parts);
  halve(centre, quads.subspan(half), most, parts);
}

/// Colours of the quads by their place: each the first that no quad before it has which shares a node. They
/// do not depend on the cut, so that sums at a node by colour do not either.
std::vector<int> colours_of(const Section& section, const FrontPlan& plan) {
  std::vector<int> colours;
  std::vector<std::uint64_t> taken(index(section.nodes()), 0);
  for (const FrontPlan::Quad& entry : plan.quads) {
    std::uint64_t seen = 0;
    for (const int node : section.quads[index(entry.quad)]) seen |= taken[index(node)];
    const int colour = std::countr_one(seen);
    for (const int node : section.quads[index(entry.quad)]) taken[index(node)] |= std::uint64_t{1} << colour;
    colours.push_back(colour);
  }
  return colours;
}

}  // namespace

SectionCut cut_section(const Section& section, const FrontPlan& plan, int part_quads) {
  std::vector<std::array<double, 2>> centre;
  for (const FrontPlan::Quad& entry : plan.quads) {
    std::array<double, 2>& at = centre.emplace_back();
    for (const int node : section.quads[index(entry.quad)]) {
      at[0] += section.p[index(node)] / 4;
      at[1] += section.q[index(node)] / 4;
    }
  }
  std::vector<int> places(plan.quads.size());
  std::iota(places.begin(), places.end(), 0);
  std::vector<std::span<int>> spans;
  halve(centre, places, std::max(1, part_quads), spans);

  const auto corners_of = [&](int place) -> const std::array<int, 4>& {
    return section.quads[index(plan.quads[index(place)].quad)];
  };
  std::vector<int> part_of_quad(plan.quads.size());
  std::vector<int> owner(index(section.nodes()), -1);
  std::vector<std::vector<int>> places_at(index(section.nodes()));
  for (std::size_t part = 0; part < spans.size(); ++part)
    for (const int place : spans[part]) {
      part_of_quad[index(place)] = static_cast<int>(part);
      for (const int node : corners_of(place))
        if (owner[index(node)] < 0) owner[index(node)] = static_cast<int>(part);
    }
  for (int place = 0; place < static_cast<int>(plan.quads.size()); ++place)
    for (const int node : corners_of(place)) places_at[index(node)].push_back(place);

  const std::vector<int> colour = colours_of(section, plan);
  SectionCut cut;
  cut.colours = 1 + *std::max_element(colour.begin(), colour.end());
  for (int part = 0; part < static_cast<int>(spans.size()); ++part) {
    MarchPart& at = cut.parts.emplace_back();
    at.first_node = static_cast<int>(cut.nodes.size());
    at.first_quad = static_cast<int>(cut.quads.size());
    std::vector<int> quads(spans[index(part)].begin(), spans[index(part)].end());
    std::vector<int> local(index(section.nodes()), -1);
    const auto add_node = [&](int node) {
      if (local[index(node)] >= 0) return;
      local[index(node)] = static_cast<int>(cut.nodes.size()) - at.first_node;
      cut.nodes.push_back(node);
    };
    for (int node = 0; node < section.nodes(); ++node)
      if (owner[index(node)] == part) {
        add_node(node);
        quads.insert(quads.end(), places_at[index(node)].begin(), places_at[index(node)].end());
      }
    at.own_nodes = static_cast<int>(cut.nodes.size()) - at.first_node;
    std::sort(quads.begin(), quads.end(),
              [&](int a, int b) { return std::pair(colour[index(a)], a) < std::pair(colour[index(b)], b); });
    quads.erase(std::unique(quads.begin(), quads.end()), quads.end());
    at.quads = static_cast<int>(quads.size());
    std::vector<char> begun(index(section.nodes()), 0);
    for (const int place : quads) {
      MarchQuad quad{};
      quad.place = static_cast<unsigned>(place) & kMostPlaces;
      quad.own = part_of_quad[index(place)] == part ? 1 : 0;
      for (unsigned corner = 0; corner < 4; ++corner) {
        const int node = corners_of(place)[corner];
        add_node(node);
        quad.node[corner] = static_cast<std::uint16_t>(local[index(node)]);
        if (std::exchange(begun[index(node)], 1) == 0) quad.begins |= 1U << corner;
      }
      cut.quads.push_back(quad);
    }
    for (int c = 0; c <= cut.colours; ++c) {
      const auto before = [&](int place) { return colour[index(place)] < c; };
      cut.first_of_colour.push_back(static_cast<int>(std::count_if(quads.begin(), quads.end(), before)));
    }
    at.nodes = static_cast<int>(cut.nodes.size()) - at.first_node;
  }
  return cut;
}

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
  const SectionCut cut = cut_section(swept_->section, elements.plan(), sizes.part_quads);
  block_.closed = swept_->closed;
  block_.colours = cut.colours;
  block_.quads = static_cast<int>(swept_->section.quads.size());
  block_.section_nodes = swept_->section.nodes();
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
  std::vector<Real> cosine;
  std::vector<Real> sine;
  AlignedVector<SweptConstants<Real>> constants;
  AlignedVector<std::byte> laws;
  for (const auto& of_class : elements.classes()) {
    cosine.push_back(static_cast<Real>(of_class.cosine));
    sine.push_back(static_cast<Real>(of_class.sine));
    constants.insert(constants.end(), of_class.constants.begin(), of_class.constants.end());
    laws.insert(laws.end(), of_class.laws.begin(), of_class.laws.end());
  }
  block_.cosine = keep(device, cosine);
  block_.sine = keep(device, sine);
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
