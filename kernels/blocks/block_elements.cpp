#include "kernels/blocks/block_elements.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <type_traits>

#include "core/body_frame.hpp"
#include "core/error.hpp"
#include "core/index.hpp"
#include "core/parallel/parallel.hpp"
#include "kernels/element/law_body.hpp"
#include "kernels/material/laws.hpp"

namespace tread {

namespace {

/// Collects what is wrong with elements and throws it as one error.
class ElementFaults {
 public:
  explicit ElementFaults(const SweptBlock& block) : block_(block) {}

  /// Degenerate corners (an edge on the axis) pass, negative ones do not.
  void check(const ElementGeometry& geometry, int quad, int station) {
    constexpr double kRounding = 1e-9;
    if (geometry.volume > 0 && geometry.smallest_jacobian > -kRounding) return;
    if (++count_ > 10) return;
    text_ += fmt::format(
        "\n  quad {} from station {} ({:.6g}): volume {:.3e} m3, smallest corner Jacobian {:.2g} of the mean",
        quad, station, block_.stations[index(station)], geometry.volume, geometry.smallest_jacobian);
  }

  void raise(const std::string& reason) const {
    if (count_ == 0) return;
    throw InputError(fmt::format("block '{}': {} elements are turned inside out; {}:{}{}", block_.name,
                                 count_, reason, text_, count_ > 10 ? "\n  ..." : ""));
  }

 private:
  const SweptBlock& block_;
  int count_ = 0;
  std::string text_;
};

/// Appends a law that is not linear.
template <class Real>
void add_law(int law, const Material& material, double volume, AlignedVector<std::byte>& list) {
  Laws::with(law, [&]<template <class> class Law>() {
    if constexpr (!Law<Real>::kLinear) {
      const ElementLaw<Law<Real>, Real> at{Law<Real>::of(material), static_cast<Real>(volume)};
      static_assert(std::is_trivially_copyable_v<decltype(at)>);
      list.resize(list.size() + sizeof at);
      std::memcpy(list.data() + list.size() - sizeof at, &at, sizeof at);
    }
    return true;
  });
}

/// A corner of the smallest quad.
int finest_node(const Section& section) {
  int finest = 0;
  for (int quad = 1; quad < static_cast<int>(section.quads.size()); ++quad)
    if (quad_area(section, quad) < quad_area(section, finest)) finest = quad;
  return section.quads[index(finest)].front();
}

}  // namespace

template <class Real>
BlockElements<Real>::BlockElements(const Mesh& mesh, int block)
    : mesh_(&mesh), block_(block), law_(law_of(this->block())) {
  build_swept();
  build_perturbed();
  join_tiles();
}

template <class Real>
void BlockElements<Real>::build_swept() {
  const SweptBlock& swept = block();
  plan_ = make_front_plan(swept.section);
  origin_node_ = finest_node(swept.section);
  place_.resize(swept.section.quads.size());
  for (std::size_t place = 0; place < plan_.quads.size(); ++place)
    place_[index(plan_.quads[place].quad)] = static_cast<int>(place);
  previous_.assign(swept.tiles.size(), -1);
  for (std::size_t tile = 0; tile < swept.tiles.size(); ++tile)
    if (swept.tiles[tile].elements > 0) previous_[index(swept.tiles[tile].next)] = static_cast<int>(tile);

  ElementFaults faults(swept);
  for (int pitch_class = 0; pitch_class < static_cast<int>(swept.classes.size()); ++pitch_class) {
    const double pitch = swept.classes[index(pitch_class)].pitch;
    Class& elements = classes_.emplace_back();
    if (swept.sweep == Sweep::revolved) {
      elements.cosine = std::cos(pitch / 2);
      elements.sine = std::sin(pitch / 2);
    }
    elements.constants.reserve(plan_.quads.size());
    for (const FrontPlan::Quad& entry : plan_.quads) {
      const HexNodes nodes = swept_nodes(swept.section, entry.quad, swept.sweep, pitch);
      const ElementGeometry shape = element_geometry(nodes);
      const Material& material = swept.material(entry.quad, pitch_class);
      faults.check(shape, entry.quad, 0);
      elements.constants.push_back(
          swept_constants<Real>(shape, hourglass_matrix(nodes, shape.volume, material), material));
      add_law<Real>(law_, material, shape.volume, elements.laws);
    }
  }
  faults.raise("a revolved section must lie on the positive side of its axis");
}

template <class Real>
void BlockElements<Real>::build_perturbed() {
  const SweptBlock& swept = block();
  row_.assign(swept.tiles.size(), -1);
  if (swept.node_shift.empty()) return;
  mark_perturbed();
  store_shifts();
  std::vector<ElementPlace> places;
  for_each_element([&](const ElementPlace& at) {
    if (at.perturbed) places.push_back(at);
  });
  std::vector<ElementGeometry> shapes(places.size());
  parallel_ranges(std::ssize(places), [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i) shapes[index(i)] = geometry(places[index(i)]);
  });
  ElementFaults faults(swept);
  for (std::size_t i = 0; i < places.size(); ++i) faults.check(shapes[i], places[i].quad, places[i].station);
  faults.raise("reduce the shift of their nodes or make the elements larger");
}

/// Elements at moved nodes, and the nodes of such elements.
template <class Real>
void BlockElements<Real>::mark_perturbed() {
  const SweptBlock& swept = block();
  const std::size_t quads = swept.section.quads.size();
  const std::size_t nodes = swept.section.p.size();
  std::vector<std::vector<int>> quads_of_node(nodes);
  for (std::size_t quad = 0; quad < quads; ++quad)
    for (const int node : swept.section.quads[quad])
      quads_of_node[index(node)].push_back(static_cast<int>(quad));

  const auto mark = [&](int tile, int node) {
    int& row = row_[index(tile)];
    if (row < 0) {
      row = static_cast<int>(perturbed_.size() / quads);
      perturbed_.resize(perturbed_.size() + quads, 0);
      shifted_.resize(shifted_.size() + nodes, -1);
    }
    for (const int quad : quads_of_node[index(node)]) {
      perturbed_[index(row) * quads + index(place_[index(quad)])] = 1;
      for (const int corner : swept.section.quads[index(quad)])
        shifted_[index(row) * nodes + index(corner)] = 0;
    }
  };
  for (const auto& [slot, shift] : swept.node_shift) {
    const auto group = static_cast<int>(slot / kLanes);
    const int tile = group / swept.section.nodes();
    const int node = group % swept.section.nodes();
    mark(tile, node);
    if (slot % kLanes == 0 && previous_[index(tile)] >= 0) mark(previous_[index(tile)], node);
  }
}

/// Tiles with the same shifts of a node share them: chords repeat along a ring, and what is read again and
/// again stays in the caches.
template <class Real>
void BlockElements<Real>::store_shifts() {
  constexpr double kSame = 1e-15;  ///< rounding of positions [m]
  constexpr int kRemembered = 8;   ///< chords of n elements repeat every n tiles or sooner
  const SweptBlock& swept = block();
  const auto nodes = index(swept.section.nodes());
  std::vector<std::vector<int>> stored(nodes);
  shifts_.assign(1, {});
  const auto same = [](const LaneShifts<Real>& a, const LaneShifts<Real>& b) {
    return std::equal(&a.shift[0][0], &a.shift[0][0] + 3 * kLanes, &b.shift[0][0],
                      [](Real x, Real y) { return std::abs(x - y) <= static_cast<Real>(kSame); });
  };
  for (auto at = swept.node_shift.begin(); at != swept.node_shift.end();) {
    const std::int64_t group = at->first / kLanes;
    LaneShifts<Real> own{};
    for (; at != swept.node_shift.end() && at->first / kLanes == group; ++at)
      for (int i = 0; i < 3; ++i) own.shift[i][at->first % kLanes] = static_cast<Real>(at->second[i]);
    const std::size_t node = static_cast<std::size_t>(group) % nodes;
    auto& known = stored[node];
    const auto last = known.end() - std::min<std::ptrdiff_t>(kRemembered, std::ssize(known));
    auto found = std::find_if(last, known.end(), [&](int i) { return same(shifts_[index(i)], own); });
    if (found == known.end()) {
      found = known.insert(known.end(), static_cast<int>(shifts_.size()));
      shifts_.push_back(own);
    }
    shifted_[index(row_[static_cast<std::size_t>(group) / nodes]) * nodes + node] = *found;
  }
}

template <class Real>
bool BlockElements<Real>::perturbed(int tile, int place) const {
  const int row = row_[index(tile)];
  return row >= 0 && perturbed_[index(row) * plan_.quads.size() + index(place)] != 0;
}

/// Two tiles that the loop takes at once lie behind one another in memory and along the sweep, the first is
/// full, and their elements have the same shape or both their own.
template <class Real>
void BlockElements<Real>::join_tiles() {
  const SweptBlock& swept = block();
  const auto joins = [&](int tile) {
    const Tile& own = swept.tiles[index(tile)];
    const Tile& next = swept.tiles[index(tile + 1)];
    bool alike = own.next == tile + 1 && own.elements == kLanes && next.elements > 0 &&
                 own.pitch_class == next.pitch_class;
    for (int place = 0; alike && place < static_cast<int>(plan_.quads.size()); ++place)
      alike = perturbed(tile, place) == perturbed(tile + 1, place);
    return alike && (tile == 0 || joins_next_[index(tile - 1)] == 0);
  };
  joins_next_.assign(swept.tiles.size(), 0);
  for (int tile = 0; tile + 1 < static_cast<int>(swept.tiles.size()); ++tile)
    joins_next_[index(tile)] = joins(tile);
}

template <class Real>
TileElements<Real> BlockElements<Real>::tile_elements(int tile, int tiles, double damping) const {
  const Tile& first = block().tiles[index(tile)];
  const Class& elements = classes_[index(first.pitch_class)];
  TileElements<Real> made_of;
  made_of.quads = plan_.quads.data();
  made_of.open = plan_.open.data();
  made_of.close = plan_.close.data();
  made_of.origin_node = origin_node_;
  made_of.quad_count = static_cast<int>(plan_.quads.size());
  made_of.slots = plan_.slots;
  made_of.swept = elements.constants.data();
  made_of.laws = elements.laws.data();
  const int row = row_[index(tile)];
  if (row >= 0) made_of.perturbed = perturbed_.data() + index(row) * plan_.quads.size();
  const auto shifted_of = [&](int of) {
    const int its_row = row_[index(of)];
    return its_row < 0 ? nullptr : shifted_.data() + index(its_row) * plan_.close.size();
  };
  for (int i = 0; i < tiles; ++i) made_of.shifted[i] = shifted_of(tile + i);
  made_of.shifted_next = shifted_of(block().tiles[index(tile + tiles - 1)].next);
  made_of.shifts = shifts_.data();
  made_of.damping = damping;
  made_of.cosine = elements.cosine;
  made_of.sine = elements.sine;
  return made_of;
}

template <class Real>
std::int64_t BlockElements<Real>::state_place(int tile) const {
  return std::int64_t{tile} * static_cast<std::int64_t>(plan_.quads.size()) * state_values(law_) * kLanes;
}

template <class Real>
ElementPlace BlockElements<Real>::locate(int quad, int station) const {
  const SweptBlock& swept = block();
  const int tile = swept.tile_of_station[index(station)];
  ElementPlace at;
  at.quad = quad;
  at.station = station;
  at.place = place_[index(quad)];
  at.pitch_class = swept.tiles[index(tile)].pitch_class;
  at.perturbed = perturbed(tile, at.place);
  return at;
}

template <class Real>
HexNodes BlockElements<Real>::element_nodes(const ElementPlace& at) const {
  const SweptBlock& swept = block();
  const double pitch = swept.classes[index(at.pitch_class)].pitch;
  HexNodes nodes = swept_nodes(swept.section, at.quad, swept.sweep, pitch);
  if (!at.perturbed) return nodes;
  for (int node = 0; node < 8; ++node) {
    const int station = node < 4 ? at.station : far_station(swept, at.station);
    const auto shift =
        swept.node_shift.find(swept.slot(swept.section.quads[index(at.quad)][index(node % 4)], station));
    if (shift == swept.node_shift.end()) continue;
    // From the node's basis to that of the element's middle, which lies so far before it.
    const double angle = swept.sweep == Sweep::extruded ? 0 : (node < 4 ? -pitch / 2 : pitch / 2);
    nodes[index(node)] += turn(shift->second, angle);
  }
  return nodes;
}

template <class Real>
ElementGeometry BlockElements<Real>::geometry(const ElementPlace& at) const {
  return element_geometry(element_nodes(at));
}

/// Index into the shifts, 0 where there is none.
template <class Real>
int BlockElements<Real>::shift_entry(int section_node, int station) const {
  const SweptBlock& swept = block();
  const int row = row_[index(swept.tile_of_station[index(station)])];
  if (row < 0) return 0;
  return std::max(0, shifted_[index(row) * index(swept.section.nodes()) + index(section_node)]);
}

/// As the loop reads it. [m]
template <class Real>
Real BlockElements<Real>::shift(int section_node, int station, int component) const {
  const std::int64_t slot = block().slot(section_node, station);
  const int entry = shift_entry(section_node, station);
  return shifts_[index(entry)].shift[component][slot % kLanes];
}

template <class Real>
void BlockElements<Real>::gather(const ElementPlace& at, ConstNodeField u, Real (&values)[8][3]) const {
  const SweptBlock& swept = block();
  for (int node = 0; node < 8; ++node) {
    const int station = node < 4 ? at.station : far_station(swept, at.station);
    const std::int64_t slot =
        swept.base + swept.slot(swept.section.quads[index(at.quad)][index(node % 4)], station);
    for (int i = 0; i < 3; ++i) values[node][i] = static_cast<Real>(u[dof(slot, i)]);
  }
}

template <class Real>
std::int64_t BlockElements<Real>::perturbed_elements() const {
  std::int64_t count = 0;
  for_each_element([&](const ElementPlace& at) { count += at.perturbed; });
  return count;
}

/// By the components that the elements have and by their sweep; those at moved nodes take twice the time.
template <class Real>
std::int64_t BlockElements<Real>::cost(int tile) const {
  if (block().tiles[index(tile)].elements == 0) return 1;
  const std::int64_t of_quad = block().vertical_only ? 2 : block().sweep == Sweep::extruded ? 4 : 5;
  std::int64_t quads = std::ssize(place_);
  for (int place = 0; place < static_cast<int>(place_.size()); ++place) quads += perturbed(tile, place);
  return of_quad * quads;
}

template <class Real>
std::int64_t BlockElements<Real>::bytes() const {
  std::size_t sum =
      shifts_.size() * sizeof(LaneShifts<Real>) + shifted_.size() * sizeof(int) + perturbed_.size();
  for (const Class& elements : classes_)
    sum += elements.constants.size() * sizeof(SweptConstants<Real>) + elements.laws.size();
  return static_cast<std::int64_t>(sum);
}

template class BlockElements<double>;
template class BlockElements<float>;

}  // namespace tread
