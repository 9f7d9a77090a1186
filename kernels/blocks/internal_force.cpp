#include "kernels/blocks/internal_force.hpp"

#include <fmt/core.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <set>
#include <string>

#include "core/error.hpp"
#include "core/parallel/parallel.hpp"
#include "kernels/element/element_body.hpp"

namespace tread {

namespace {

std::size_t index(int i) {
  return static_cast<std::size_t>(i);
}

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

int far_station(const SweptBlock& block, int station) {
  return station + 1 == block.station_count() ? 0 : station + 1;
}

template <class Real>
void law_strain(bool finite_rotation, const Strain<Real>& strain, Real (&e)[6]) {
  if (finite_rotation)
    point_strain<true, Real>(strain.g, e);
  else
    point_strain<false, Real>(strain.g, e);
}

/// Turns a vector from the basis of a node to that of a middle angle which lies `angle` before it.
Vec3 turned(const Vec3& v, double angle) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return {c * v.x + s * v.z, v.y, c * v.z - s * v.x};
}

template <class Real>
void component_modes(int i, const Real (&s)[4][3], const Real (&d)[4][3], Real (&a)[kModes]) {
  const Real sum[4] = {s[0][i], s[1][i], s[2][i], s[3][i]};
  const Real difference[4] = {d[0][i], d[1][i], d[2][i], d[3][i]};
  to_modes(sum, difference, a);
}

template <class Element, class Real>
Strain<Real> element_strain(const Element& element, const Real (&s)[4][3], const Real (&d)[4][3]) {
  Strain<Real> result;
  for (int i = 0; i < 3; ++i) {
    Real a[kModes];
    component_modes(i, s, d, a);
    element.strain(i, a, result);
  }
  return result;
}

template <class Element, class Real>
void element_forces(const Element& element, const Strain<Real>& force, Real (&s)[4][3], Real (&d)[4][3]) {
  for (int i = 0; i < 3; ++i) {
    Real a[kModes];
    Real sum[4];
    Real difference[4];
    element.forces(i, force, a);
    from_modes(a, sum, difference);
    for (int j = 0; j < 4; ++j) {
      s[j][i] = sum[j];
      d[j][i] = difference[j];
    }
  }
}

/// Scratch of a thread; grows in its first calls only.
template <class Real>
Real* front_of(const FrontPlan& plan) {
  thread_local AlignedVector<Real> front;
  front.resize(std::max(front.size(), index(plan.slots) * kTilesAbreast * (kFrontValues + kShiftValues)));
  return front.data();
}

}  // namespace

double von_mises(const std::array<double, 6>& s) {
  const double xy = s[0] - s[1], yz = s[1] - s[2], zx = s[2] - s[0];
  return std::sqrt(0.5 * (xy * xy + yz * yz + zx * zx) + 3 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]));
}

template <class Real, class U>
BasicInternalForce<Real, U>::BasicInternalForce(const Mesh& mesh)
    : mesh_(mesh), forces_(tile_forces().front()), blocks_(mesh.blocks.size()), carries_(mesh.blocks.size()) {
  cost_.push_back(0);
  for (int block = 0; block < static_cast<int>(blocks_.size()); ++block) {
    build_swept(block);
    build_perturbed(block);
    join_tiles(block);
    const SweptBlock& swept = mesh.blocks[index(block)];
    BlockData& data = blocks_[index(block)];
    data.carry_stride = index(3 * swept.section.nodes() + kLanes);
    carries_[index(block)].assign(swept.tiles.size() * data.carry_stride, 0);
    no_carry_.resize(std::max(no_carry_.size(), data.carry_stride), 0);
    data.first_item = items_.size();
    for (int tile = 0; tile < static_cast<int>(swept.tiles.size()); ++tile) {
      items_.push_back({block, tile});
      const auto quads = static_cast<std::int64_t>(swept.section.quads.size());
      cost_.push_back(cost_.back() + (swept.tiles[index(tile)].elements > 0 ? quads : 1));
    }
  }
  pending_.resize(items_.size(), 0);
  unmoved_.resize(items_.size(), 0);
}

template <class Real, class U>
void BasicInternalForce<Real, U>::build_swept(int block) {
  const SweptBlock& swept = mesh_.blocks[index(block)];
  BlockData& data = blocks_[index(block)];
  data.plan = make_front_plan(swept.section);
  data.place.resize(swept.section.quads.size());
  for (std::size_t place = 0; place < data.plan.quads.size(); ++place)
    data.place[index(data.plan.quads[place].quad)] = static_cast<int>(place);
  data.previous.assign(swept.tiles.size(), -1);
  for (std::size_t tile = 0; tile < swept.tiles.size(); ++tile)
    if (swept.tiles[tile].elements > 0) data.previous[index(swept.tiles[tile].next)] = static_cast<int>(tile);

  ElementFaults faults(swept);
  for (int pitch_class = 0; pitch_class < static_cast<int>(swept.classes.size()); ++pitch_class) {
    const double pitch = swept.classes[index(pitch_class)].pitch;
    ClassData& elements = data.classes.emplace_back();
    if (swept.sweep == Sweep::revolved) {
      elements.cosine = std::cos(pitch / 2);
      elements.sine = std::sin(pitch / 2);
    }
    for (const FrontPlan::Quad& entry : data.plan.quads) {
      const HexNodes nodes = swept_nodes(swept.section, entry.quad, swept.sweep, pitch);
      const ElementGeometry& shape = elements.geometry.emplace_back(element_geometry(nodes));
      const Material& material = swept.material(entry.quad, pitch_class);
      faults.check(shape, entry.quad, 0);
      elements.constants.push_back(
          swept_constants<Real>(shape, hourglass_matrix(nodes, shape.volume, material), material));
    }
  }
  faults.raise("a revolved section must lie on the positive side of its axis");
}

template <class Real, class U>
void BasicInternalForce<Real, U>::build_perturbed(int block) {
  const SweptBlock& swept = mesh_.blocks[index(block)];
  BlockData& data = blocks_[index(block)];
  data.row.assign(swept.tiles.size(), -1);
  if (swept.node_shift.empty()) return;
  mark_perturbed(block);
  store_shifts(block);
  ElementFaults faults(swept);
  for_each_element(block, [&](const Place& at) {
    if (at.perturbed) faults.check(geometry(block, at), at.quad, at.station);
  });
  faults.raise("reduce the shift of their nodes or make the elements larger");
}

/// Elements at moved nodes, and the nodes of such elements.
template <class Real, class U>
void BasicInternalForce<Real, U>::mark_perturbed(int block) {
  const SweptBlock& swept = mesh_.blocks[index(block)];
  BlockData& data = blocks_[index(block)];
  const std::size_t quads = swept.section.quads.size();
  const std::size_t nodes = swept.section.p.size();
  std::vector<std::vector<int>> quads_of_node(nodes);
  for (std::size_t quad = 0; quad < quads; ++quad)
    for (const int node : swept.section.quads[quad])
      quads_of_node[index(node)].push_back(static_cast<int>(quad));

  const auto mark = [&](int tile, int node) {
    int& row = data.row[index(tile)];
    if (row < 0) {
      row = static_cast<int>(data.perturbed.size() / quads);
      data.perturbed.resize(data.perturbed.size() + quads, 0);
      data.shifted.resize(data.shifted.size() + nodes, -1);
    }
    for (const int quad : quads_of_node[index(node)]) {
      data.perturbed[index(row) * quads + index(data.place[index(quad)])] = 1;
      for (const int corner : swept.section.quads[index(quad)])
        data.shifted[index(row) * nodes + index(corner)] = 0;
    }
  };
  for (const auto& [slot, shift] : swept.node_shift) {
    const auto group = static_cast<int>(slot / kLanes);
    const int tile = group / swept.section.nodes();
    const int node = group % swept.section.nodes();
    mark(tile, node);
    if (slot % kLanes == 0 && data.previous[index(tile)] >= 0) mark(data.previous[index(tile)], node);
  }
}

/// Tiles with the same shifts of a node share them: chords repeat along a ring, and what is read again and
/// again stays in the caches.
template <class Real, class U>
void BasicInternalForce<Real, U>::store_shifts(int block) {
  constexpr double kSame = 1e-15;  ///< rounding of positions [m]
  constexpr int kRemembered = 8;   ///< chords of n elements repeat every n tiles or sooner
  const SweptBlock& swept = mesh_.blocks[index(block)];
  BlockData& data = blocks_[index(block)];
  const auto nodes = index(swept.section.nodes());
  std::vector<std::vector<int>> stored(nodes);
  data.shifts.assign(1, {});
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
    auto found = std::find_if(last, known.end(), [&](int i) { return same(data.shifts[index(i)], own); });
    if (found == known.end()) {
      found = known.insert(known.end(), static_cast<int>(data.shifts.size()));
      data.shifts.push_back(own);
    }
    data.shifted[index(data.row[static_cast<std::size_t>(group) / nodes]) * nodes + node] = *found;
  }
}

template <class Real, class U>
bool BasicInternalForce<Real, U>::perturbed(const BlockData& data, int tile, int place) const {
  const int row = data.row[index(tile)];
  return row >= 0 && data.perturbed[index(row) * data.plan.quads.size() + index(place)] != 0;
}

/// Two tiles that the loop takes at once lie behind one another in memory and along the sweep, the first is
/// full, and their elements have the same shape or both their own. Which ones does not depend on the
/// threads: displacements are rounded relative to one of the first tile's.
template <class Real, class U>
void BasicInternalForce<Real, U>::join_tiles(int block) {
  const SweptBlock& swept = mesh_.blocks[index(block)];
  BlockData& data = blocks_[index(block)];
  const auto joins = [&](int tile) {
    const Tile& own = swept.tiles[index(tile)];
    const Tile& next = swept.tiles[index(tile + 1)];
    bool alike = own.next == tile + 1 && own.elements == kLanes && next.elements > 0 &&
                 own.pitch_class == next.pitch_class;
    for (int place = 0; alike && place < static_cast<int>(data.plan.quads.size()); ++place)
      alike = perturbed(data, tile, place) == perturbed(data, tile + 1, place);
    return alike && (tile == 0 || data.joins_next[index(tile - 1)] == 0);
  };
  data.joins_next.assign(swept.tiles.size(), 0);
  for (int tile = 0; tile + 1 < static_cast<int>(swept.tiles.size()); ++tile)
    data.joins_next[index(tile)] = joins(tile);
}

template <class Real, class U>
void BasicInternalForce<Real, U>::internal_force(int block, const U* u, const Real* v, Real* f) const {
  const std::size_t first = blocks_[index(block)].first_item;
  evaluate(first, first + mesh_.blocks[index(block)].tiles.size(), {u, v, nullptr, f, false});
}

template <class Real, class U>
Real* BasicInternalForce<Real, U>::carry(const Item& item) const {
  return carries_[index(item.block)].data() + index(item.tile) * blocks_[index(item.block)].carry_stride +
         kLanes;
}

template <class Real, class U>
void BasicInternalForce<Real, U>::evaluate(std::size_t first, std::size_t last, const Fields& fields) const {
  const auto begin = cost_.begin() + static_cast<std::ptrdiff_t>(first);
  const auto end = cost_.begin() + static_cast<std::ptrdiff_t>(last);
  const auto item_at = [&](std::int64_t cost) {
    const auto i = static_cast<std::size_t>(std::lower_bound(begin, end, *begin + cost) - cost_.begin());
    return i > first && i < last && joined(i - 1) ? i + 1 : i;
  };
  parallel_ranges(*end - *begin, [&](std::int64_t from, std::int64_t to) {
    evaluate_items(item_at(from), item_at(to), fields);
  });
  for (std::size_t i = first; i < last; ++i)
    if (pending_[i]) add_carry(items_[i], fields.f);
}

template <class Real, class U>
void BasicInternalForce<Real, U>::add_carry(const Item& item, Real* f) const {
  const SweptBlock& swept = mesh_.blocks[index(item.block)];
  const Real* carry = this->carry({item.block, blocks_[index(item.block)].previous[index(item.tile)]});
  f += dof(swept.base + std::int64_t{item.tile} * swept.section.nodes() * kLanes, 0);
  for (int value = 0; value < 3 * swept.section.nodes(); ++value)
    f[std::ptrdiff_t{value} * kLanes] += carry[value];
}

template <class Real, class U>
void BasicInternalForce<Real, U>::evaluate_items(std::size_t first, std::size_t last,
                                                 const Fields& fields) const {
  const int most = forces_->loops<Real, U>().tiles;
  for (std::size_t i = first; i < last;) {
    const Item item = items_[i];
    const BlockData& data = blocks_[index(item.block)];
    const int previous = data.previous[index(item.tile)];
    const bool at_hand =
        i > first && previous >= 0 && items_[i - 1].block == item.block && items_[i - 1].tile == previous;
    const bool empty = mesh_.blocks[index(item.block)].tiles[index(item.tile)].elements == 0;
    const int tiles = joined(i) ? most : 1;
    pending_[i] = previous >= 0 && !at_hand;
    // The tile before reads what a pending one holds, maybe later.
    unmoved_[i] = pending_[i] || empty;
    if (tiles > 1) pending_[i + 1] = unmoved_[i + 1] = 0;
    const Real* carry_in = at_hand ? carry({item.block, previous}) : no_carry_.data() + kLanes;
    if (empty)
      pass_carry(item, carry_in, fields.f);
    else
      evaluate_tiles(i, tiles, carry_in, fields);
    i += static_cast<std::size_t>(tiles);
  }
}

/// To the last station of an open block in a tile of its own.
template <class Real, class U>
void BasicInternalForce<Real, U>::pass_carry(const Item& item, const Real* carry_in, Real* f) const {
  const SweptBlock& swept = mesh_.blocks[index(item.block)];
  const std::int64_t slots = std::int64_t{swept.section.nodes()} * kLanes;
  f += dof(swept.base + item.tile * slots, 0);
  std::fill_n(f, 3 * slots, Real{0});
  for (std::int64_t value = 0; value < 3 * swept.section.nodes(); ++value)
    f[value * kLanes] = carry_in[value];
}

template <class Real, class U>
void BasicInternalForce<Real, U>::evaluate_tiles(std::size_t first, int tiles, const Real* carry_in,
                                                 const Fields& fields) const {
  const Item& item = items_[first];
  const Item& last = items_[first + static_cast<std::size_t>(tiles) - 1];
  const SweptBlock& swept = mesh_.blocks[index(item.block)];
  const BlockData& data = blocks_[index(item.block)];
  const Tile& last_tile = swept.tiles[index(last.tile)];
  const std::int64_t slots = std::int64_t{swept.section.nodes()} * kLanes;
  const std::int64_t own = dof(swept.base + item.tile * slots, 0);
  const std::int64_t next = dof(swept.base + last_tile.next * slots, 0);
  const Real* const damping = data.branch != 0 ? fields.q : data.beta != 0 ? fields.v : nullptr;

  TileView<Real, U> view;
  view.u = fields.u + own;
  view.u_next = fields.u + next;
  if (damping != nullptr) {
    view.v = damping + own;
    view.v_next = damping + next;
  }
  view.f = fields.f + own;
  TileMotion<Real, U> motion[kTilesAbreast];
  for (int tile = 0; tile < tiles; ++tile) {
    const Moved& moved = fields.moved;
    if (moved.update == nullptr || unmoved_[first + static_cast<std::size_t>(tile)]) continue;
    motion[tile] = moved.update->motion(item.block, item.tile + tile, *moved.loads, moved.u, moved.v);
    view.motion[tile] = &motion[tile];
  }
  view.carry_in = carry_in;
  view.carry_out = carry(last);
  view.elements = last_tile.elements;
  view.tiles = tiles;
  view.stride = 3 * slots;

  const TileVariant variant{swept.sweep, damping != nullptr, data.finite_rotation && !fields.linear,
                            swept.vertical_only};
  forces_->loops<Real, U>().force(variant)(tile_elements(item, tiles), view, front_of<Real>(data.plan));
}

template <class Real, class U>
TileElements<Real> BasicInternalForce<Real, U>::tile_elements(const Item& item, int tiles) const {
  const BlockData& data = blocks_[index(item.block)];
  const Tile& tile = mesh_.blocks[index(item.block)].tiles[index(item.tile)];
  const ClassData& elements = data.classes[index(tile.pitch_class)];
  TileElements<Real> made_of;
  made_of.quads = data.plan.quads.data();
  made_of.open = data.plan.open.data();
  made_of.close = data.plan.close.data();
  made_of.quad_count = static_cast<int>(data.plan.quads.size());
  made_of.slots = data.plan.slots;
  made_of.swept = elements.constants.data();
  const int row = data.row[index(item.tile)];
  if (row >= 0) made_of.perturbed = data.perturbed.data() + index(row) * data.plan.quads.size();
  const auto shifted_of = [&](int of) {
    const int its_row = data.row[index(of)];
    return its_row < 0 ? nullptr : data.shifted.data() + index(its_row) * data.plan.close.size();
  };
  for (int i = 0; i < tiles; ++i) made_of.shifted[i] = shifted_of(item.tile + i);
  made_of.shifted_next = shifted_of(mesh_.blocks[index(item.block)].tiles[index(item.tile + tiles - 1)].next);
  made_of.shifts = data.shifts.data();
  made_of.beta = data.branch != 0 ? data.branch : data.beta;
  made_of.cosine = elements.cosine;
  made_of.sine = elements.sine;
  return made_of;
}

template <class Real, class U>
typename BasicInternalForce<Real, U>::Place BasicInternalForce<Real, U>::locate(int block, int quad,
                                                                                int station) const {
  const SweptBlock& swept = mesh_.blocks[index(block)];
  const BlockData& data = blocks_[index(block)];
  const int tile = swept.tile_of_station[index(station)];
  Place at;
  at.quad = quad;
  at.station = station;
  at.place = data.place[index(quad)];
  at.pitch_class = swept.tiles[index(tile)].pitch_class;
  at.perturbed = perturbed(data, tile, at.place);
  return at;
}

template <class Real, class U>
HexNodes BasicInternalForce<Real, U>::element_nodes(int block, const Place& at) const {
  const SweptBlock& swept = mesh_.blocks[index(block)];
  const double pitch = swept.classes[index(at.pitch_class)].pitch;
  HexNodes nodes = swept_nodes(swept.section, at.quad, swept.sweep, pitch);
  if (!at.perturbed) return nodes;
  for (int node = 0; node < 8; ++node) {
    const int station = node < 4 ? at.station : far_station(swept, at.station);
    const auto shift =
        swept.node_shift.find(swept.slot(swept.section.quads[index(at.quad)][index(node % 4)], station));
    if (shift == swept.node_shift.end()) continue;
    const double angle = swept.sweep == Sweep::extruded ? 0 : (node < 4 ? -pitch / 2 : pitch / 2);
    nodes[index(node)] += turned(shift->second, angle);
  }
  return nodes;
}

template <class Real, class U>
ElementGeometry BasicInternalForce<Real, U>::geometry(int block, const Place& at) const {
  if (at.perturbed) return element_geometry(element_nodes(block, at));
  return blocks_[index(block)].classes[index(at.pitch_class)].geometry[index(at.place)];
}

/// Index into the shifts, 0 where there is none.
template <class Real, class U>
int BasicInternalForce<Real, U>::shift_entry(int block, int section_node, int station) const {
  const SweptBlock& swept = mesh_.blocks[index(block)];
  const BlockData& data = blocks_[index(block)];
  const int row = data.row[index(swept.tile_of_station[index(station)])];
  if (row < 0) return 0;
  return std::max(0, data.shifted[index(row) * index(swept.section.nodes()) + index(section_node)]);
}

/// As the loop reads it. [m]
template <class Real, class U>
Real BasicInternalForce<Real, U>::shift(int block, int section_node, int station, int component) const {
  const std::int64_t slot = mesh_.blocks[index(block)].slot(section_node, station);
  const int entry = shift_entry(block, section_node, station);
  return blocks_[index(block)].shifts[index(entry)].shift[component][slot % kLanes];
}

/// Sums and differences of the values at both ends of an element, in its middle frame.
template <class Real, class U>
template <class Value>
void BasicInternalForce<Real, U>::spread(int block, const Place& at, const Value& value, Real (&s)[4][3],
                                         Real (&d)[4][3]) const {
  const ClassData& elements = blocks_[index(block)].classes[index(at.pitch_class)];
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 3; ++i) {
      s[j][i] = value(j, i) + value(j + 4, i);
      d[j][i] = value(j + 4, i) - value(j, i);
    }
    if (mesh_.blocks[index(block)].sweep == Sweep::revolved)
      turn_to_middle(static_cast<Real>(elements.cosine), static_cast<Real>(elements.sine), s[j], d[j]);
  }
}

/// visit(element), of the type that it has.
template <class Real, class U>
template <class Visit>
void BasicInternalForce<Real, U>::with_element(int block, const Place& at, const Visit& visit) const {
  const SweptBlock& swept = mesh_.blocks[index(block)];
  const ClassData& elements = blocks_[index(block)].classes[index(at.pitch_class)];
  const SweptConstants<Real>& constants = elements.constants[index(at.place)];
  if (at.perturbed) {
    Real s[4][3];
    Real d[4][3];
    Real shifts[3][kModes];
    const auto at_node = [&](int node, int i) {
      return shift(block, swept.section.quads[index(at.quad)][index(node % 4)],
                   node < 4 ? at.station : far_station(swept, at.station), i);
    };
    spread(block, at, at_node, s, d);
    for (int i = 0; i < 3; ++i) component_modes(i, s, d, shifts[i]);
    visit(PerturbedElement<Real, Real>(constants, shifts));
  } else if (swept.sweep == Sweep::revolved) {
    visit(SweptElement<Sweep::revolved, Real>{constants});
  } else {
    visit(SweptElement<Sweep::extruded, Real>{constants});
  }
}

template <class Real, class U>
void BasicInternalForce<Real, U>::gather(int block, const Place& at, ConstNodeField u,
                                         Real (&values)[8][3]) const {
  const SweptBlock& swept = mesh_.blocks[index(block)];
  for (int node = 0; node < 8; ++node) {
    const int station = node < 4 ? at.station : far_station(swept, at.station);
    const std::int64_t slot =
        swept.base + swept.slot(swept.section.quads[index(at.quad)][index(node % 4)], station);
    for (int i = 0; i < 3; ++i) values[node][i] = static_cast<Real>(u[dof(slot, i)]);
  }
}

template <class Real, class U>
template <class Visit>
void BasicInternalForce<Real, U>::for_each_element(int block, const Visit& visit) const {
  const SweptBlock& swept = mesh_.blocks[index(block)];
  for (const Tile& tile : swept.tiles)
    for (const FrontPlan::Quad& entry : blocks_[index(block)].plan.quads)
      for (int lane = 0; lane < tile.elements; ++lane)
        visit(locate(block, entry.quad, tile.first_station + lane));
}

template <class Real, class U>
DeformationEnergy BasicInternalForce<Real, U>::energy(int block, const U* u) const {
  return sum_energy(block, u, blocks_[index(block)].finite_rotation);
}

template <class Real, class U>
double BasicInternalForce<Real, U>::linear_energy(int block, const Real* q) const {
  const DeformationEnergy energy = sum_energy(block, q, false);
  return energy.strain + energy.hourglass;
}

template <class Real, class U>
template <class Value>
DeformationEnergy BasicInternalForce<Real, U>::sum_energy(int block, const Value* field,
                                                          bool finite_rotation) const {
  const SweptBlock& swept = mesh_.blocks[index(block)];
  const BlockData& data = blocks_[index(block)];
  std::vector<DeformationEnergy> partial(swept.tiles.size());
  const TileEnergy<Real, Value> tile_energy =
      forces_->loops<Real, Value>().energy({swept.sweep, false, finite_rotation});
  parallel_ranges(static_cast<std::int64_t>(partial.size()), [&](std::int64_t first, std::int64_t last) {
    Real* const front = front_of<Real>(data.plan);
    for (std::int64_t i = first; i < last; ++i) {
      const Tile& tile = swept.tiles[index(static_cast<int>(i))];
      if (tile.elements == 0) continue;
      const std::int64_t slots = std::int64_t{swept.section.nodes()} * kLanes;
      TileView<Real, Value> view;
      view.u = field + dof(swept.base + i * slots, 0);
      view.u_next = field + dof(swept.base + tile.next * slots, 0);
      view.elements = tile.elements;
      partial[static_cast<std::size_t>(i)] =
          tile_energy(tile_elements({block, static_cast<int>(i)}, 1), view, front);
    }
  });
  DeformationEnergy total;
  for (const DeformationEnergy& part : partial) {
    total.strain += part.strain;
    total.hourglass += part.hourglass;
  }
  return total;
}

template <class Real, class U>
std::array<double, 6> BasicInternalForce<Real, U>::stress(int block, int quad, int station, ConstNodeField u,
                                                          ConstNodeField q) const {
  const Place at = locate(block, quad, station);
  Real values[8][3];
  gather(block, at, u, values);
  const auto strength = static_cast<Real>(blocks_[index(block)].branch);
  if (q && strength != 0) {
    Real lags[8][3];
    gather(block, at, q, lags);
    for (int node = 0; node < 8; ++node)
      for (int i = 0; i < 3; ++i) values[node][i] += strength * lags[node][i];
  }
  Real sums[4][3];
  Real differences[4][3];
  spread(
      block, at, [&](int node, int i) { return values[node][i]; }, sums, differences);
  Real e[6];
  Real s[6];
  with_element(block, at, [&](const auto& element) {
    law_strain(blocks_[index(block)].finite_rotation, element_strain(element, sums, differences), e);
  });
  const Material& material = mesh_.blocks[index(block)].material(quad, at.pitch_class);
  point_stress(static_cast<Real>(material.lame_lambda()), static_cast<Real>(material.shear_modulus()), e, s);
  return {s[0], s[1], s[2], s[3], s[4], s[5]};
}

template <class Real, class U>
void BasicInternalForce<Real, U>::lumped_mass(double* mass) const {
  std::fill_n(mass, mesh_.slots, 0.0);
  for (int block = 0; block < static_cast<int>(blocks_.size()); ++block) {
    const SweptBlock& swept = mesh_.blocks[index(block)];
    for_each_element(block, [&](const Place& at) {
      const double density = swept.material(at.quad, at.pitch_class).density;
      const ElementGeometry shape = geometry(block, at);
      for (int node = 0; node < 8; ++node) {
        const int station = node < 4 ? at.station : far_station(swept, at.station);
        const int section_node = swept.section.quads[index(at.quad)][index(node % 4)];
        mass[swept.base + swept.slot(section_node, station)] += density * shape.nodal_volume[index(node)];
      }
    });
  }
}

template <class Real, class U>
void BasicInternalForce<Real, U>::diagonal(double* d) const {
  std::fill_n(d, 3 * mesh_.slots, 0.0);
  for (int block = 0; block < static_cast<int>(blocks_.size()); ++block) {
    const SweptBlock& swept = mesh_.blocks[index(block)];
    const std::size_t quads = swept.section.quads.size();
    const auto diagonal_of = [&](const Place& at) {
      const ElementStiffness k = stiffness(block, at);
      std::array<double, 24> values{};
      for (std::size_t i = 0; i < 24; ++i) values[i] = k[i][i];
      return values;
    };
    std::vector<std::optional<std::array<double, 24>>> known(quads * swept.classes.size());
    for_each_element(block, [&](const Place& at) {
      std::array<double, 24> values;
      if (at.perturbed) {
        values = diagonal_of(at);
      } else {
        auto& shared = known[index(at.pitch_class) * quads + index(at.quad)];
        if (!shared) shared = diagonal_of(at);
        values = *shared;
      }
      for (int node = 0; node < 8; ++node) {
        const int station = node < 4 ? at.station : far_station(swept, at.station);
        const int section_node = swept.section.quads[index(at.quad)][index(node % 4)];
        const std::int64_t slot = swept.base + swept.slot(section_node, station);
        for (int i = 0; i < 3; ++i) d[dof(slot, i)] += values[index(3 * node + i)];
      }
    });
  }
}

template <class Real, class U>
ElementStiffness BasicInternalForce<Real, U>::stiffness(int block, const Place& at) const {
  const ClassData& elements = blocks_[index(block)].classes[index(at.pitch_class)];
  const SweptConstants<Real>& constants = elements.constants[index(at.place)];
  ElementStiffness k;
  with_element(block, at, [&](const auto& element) {
    for (int column = 0; column < 24; ++column) {
      Real s[4][3];
      Real d[4][3];
      spread(
          block, at, [&](int node, int i) { return Real(3 * node + i == column); }, s, d);
      const Strain<Real> strain = element_strain(element, s, d);
      Strain<Real> force;
      strain_forces<false>(constants, element, strain, force);
      element_forces(element, force, s, d);
      for (int j = 0; j < 4; ++j) {
        if (mesh_.blocks[index(block)].sweep == Sweep::revolved)
          turn_to_nodes(static_cast<Real>(elements.cosine), static_cast<Real>(elements.sine), s[j], d[j]);
        for (int i = 0; i < 3; ++i) {
          k[index(3 * j + i)][index(column)] = s[j][i] - d[j][i];
          k[index(3 * (j + 4) + i)][index(column)] = s[j][i] + d[j][i];
        }
      }
    }
  });
  return k;
}

template <class Real, class U>
ElementStiffness BasicInternalForce<Real, U>::element_stiffness(int block, int quad, int station) const {
  return stiffness(block, locate(block, quad, station));
}

template <class Real, class U>
double BasicInternalForce<Real, U>::frequency(int block, const Place& at) const {
  const ElementStiffness k = stiffness(block, at);
  const ElementGeometry shape = geometry(block, at);
  const double density = mesh_.blocks[index(block)].material(at.quad, at.pitch_class).density;
  Eigen::Matrix<double, 24, 24> pencil;
  for (int row = 0; row < 24; ++row)
    for (int column = 0; column < 24; ++column)
      pencil(row, column) =
          k[index(row)][index(column)] /
          (density * std::sqrt(shape.nodal_volume[index(row / 3)] * shape.nodal_volume[index(column / 3)]));
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 24, 24>> solver(pencil, Eigen::EigenvaluesOnly);
  return std::sqrt(solver.eigenvalues()(23));
}

template <class Real, class U>
double BasicInternalForce<Real, U>::element_frequency(int block, int quad, int station) const {
  return frequency(block, locate(block, quad, station));
}

template <class Real, class U>
ElementFrequency BasicInternalForce<Real, U>::max_frequency(int block) const {
  const SweptBlock& swept = mesh_.blocks[index(block)];
  const std::size_t quads = swept.section.quads.size();
  std::vector<Place> candidates;  // one of each shape
  // Quad and pitch class; of elements at moved nodes, what shifts their eight nodes have in which lane.
  std::set<std::array<int, 11>> shapes;
  for_each_element(block, [&](const Place& at) {
    std::array<int, 11> shape = {static_cast<int>(index(at.pitch_class) * quads + index(at.quad))};
    if (at.perturbed) {
      const int stations[2] = {at.station, far_station(swept, at.station)};
      for (int node = 0; node < 8; ++node)
        shape[index(1 + node)] =
            shift_entry(block, swept.section.quads[index(at.quad)][index(node % 4)], stations[node / 4]);
      for (int end = 0; end < 2; ++end)
        shape[index(9 + end)] = 1 + static_cast<int>(swept.slot(0, stations[end]) % kLanes);
    }
    if (shapes.insert(shape).second) candidates.push_back(at);
  });
  std::vector<double> omega(candidates.size());
  parallel_ranges(static_cast<std::int64_t>(omega.size()), [&](std::int64_t first, std::int64_t last) {
    for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(last); ++i)
      omega[i] = frequency(block, candidates[i]);
  });
  const auto highest = std::max_element(omega.begin(), omega.end());
  if (highest == omega.end()) return {};
  const Place& at = candidates[static_cast<std::size_t>(highest - omega.begin())];
  return {*highest, at.quad, at.station};
}

template <class Real, class U>
std::int64_t BasicInternalForce<Real, U>::perturbed_elements() const {
  std::int64_t count = 0;
  for (int block = 0; block < static_cast<int>(blocks_.size()); ++block) count += perturbed_elements(block);
  return count;
}

template <class Real, class U>
std::int64_t BasicInternalForce<Real, U>::perturbed_elements(int block) const {
  std::int64_t count = 0;
  for_each_element(block, [&](const Place& at) { count += at.perturbed; });
  return count;
}

template <class Real, class U>
std::int64_t BasicInternalForce<Real, U>::bytes() const {
  std::size_t sum = 0;
  for (std::size_t block = 0; block < blocks_.size(); ++block) {
    const BlockData& data = blocks_[block];
    sum += data.shifts.size() * sizeof(LaneShifts<Real>) + data.shifted.size() * sizeof(int) +
           data.perturbed.size() + carries_[block].size() * sizeof(Real);
    for (const ClassData& elements : data.classes)
      sum += elements.constants.size() * (sizeof(SweptConstants<Real>) + sizeof(ElementGeometry));
  }
  return static_cast<std::int64_t>(sum);
}

template <class Real, class U>
std::vector<const char*> BasicInternalForce<Real, U>::instruction_sets() {
  std::vector<const char*> names;
  for (const TileForces* forces : tile_forces()) names.push_back(forces->name);
  return names;
}

template <class Real, class U>
void BasicInternalForce<Real, U>::use_instruction_set(const char* name) {
  for (const TileForces* forces : tile_forces())
    if (std::strcmp(forces->name, name) == 0) {
      forces_ = forces;
      return;
    }
  throw InputError(fmt::format("instruction set '{}' is not available on this processor", name));
}

template class BasicInternalForce<double>;
template class BasicInternalForce<float, double>;
template class BasicInternalForce<float>;

}  // namespace tread
