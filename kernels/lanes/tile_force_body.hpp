#pragma once
// Included by one source per instruction set; internal linkage keeps the versions apart.

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "kernels/element/element_body.hpp"
#include "kernels/lanes/patch_sum_body.hpp"
#include "kernels/lanes/registers.hpp"
#include "kernels/lanes/tie_sum_body.hpp"
#include "kernels/lanes/tile_force.hpp"

namespace tread {
namespace {

/// (a[1], ..., a[last], b[0])
template <class V>
TREAD_INLINE V shift_down(const V& a, const V& b) {
  if constexpr (sizeof a / sizeof a[0] == 16)
    return __builtin_shufflevector(a, b, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16);
  if constexpr (sizeof a / sizeof a[0] == 8) return __builtin_shufflevector(a, b, 1, 2, 3, 4, 5, 6, 7, 8);
  if constexpr (sizeof a / sizeof a[0] == 4) return __builtin_shufflevector(a, b, 1, 2, 3, 4);
  if constexpr (sizeof a / sizeof a[0] == 2) return __builtin_shufflevector(a, b, 1, 2);
}

/// (a[last], b[0], ..., b[last - 1])
template <class V>
TREAD_INLINE V shift_up(const V& a, const V& b) {
  if constexpr (sizeof a / sizeof a[0] == 16)
    return __builtin_shufflevector(a, b, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30);
  if constexpr (sizeof a / sizeof a[0] == 8)
    return __builtin_shufflevector(a, b, 7, 8, 9, 10, 11, 12, 13, 14);
  if constexpr (sizeof a / sizeof a[0] == 4) return __builtin_shufflevector(a, b, 3, 4, 5, 6);
  if constexpr (sizeof a / sizeof a[0] == 2) return __builtin_shufflevector(a, b, 1, 2);
}

/// Both side by side.
template <class V>
TREAD_INLINE auto abreast(const V& a, const V& b) {
  if constexpr (sizeof a / sizeof a[0] == 8)
    return __builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
  if constexpr (sizeof a / sizeof a[0] == 4) return __builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7);
  if constexpr (sizeof a / sizeof a[0] == 2) return __builtin_shufflevector(a, b, 0, 1, 2, 3);
}

/// `values` with another one in a lane; as they are where they have no such lane.
template <class V, class Real>
TREAD_INLINE V with_lane(const V& values, int lane, Real value) {
  using Index = std::conditional_t<sizeof(Real) == 8, std::int64_t, std::int32_t>;
  typename Vector<Index, sizeof(V) / sizeof(Real)>::type lanes;
  for (std::size_t l = 0; l < sizeof(V) / sizeof(Real); ++l) lanes[l] = static_cast<Index>(l);
  return lanes == static_cast<Index>(lane) ? V{} + value : values;
}

/// Differences of `lanes` values in U, rounded to Real.
template <class Real, int lanes, class U>
TREAD_INLINE auto rounded_difference(const U* a, const U* b) {
  if constexpr (lanes > Lanes<U>::kWidth) {
    constexpr int kHalf = lanes / 2;
    return abreast(rounded_difference<Real, kHalf>(a, b),
                   rounded_difference<Real, kHalf>(a + kHalf, b + kHalf));
  } else {
    using V = typename Vector<U, lanes>::type;
    return converted<typename Vector<Real, lanes>::type>(load<V>(a) - load<V>(b));
  }
}

/// Registers in which a tile's nodes move: as many lanes of both precisions as fit one of the wider.
template <class Real, class U>
struct NodeLanes {
  static constexpr int kWidth = Lanes<U>::kWidth;
  static constexpr int kParts = Lanes<U>::kParts;
  using Register = typename Vector<Real, kWidth>::type;
  using Displacement = typename Lanes<U>::Register;
};

/// Moves the lanes of a section node that begin at `lane` by their force, components from `first` on.
template <Sweep sweep, int first, class Real, class U>
TREAD_INLINE void move_node(const TileMotion<Real, U>& motion, int node, int lane,
                            const typename NodeLanes<Real, U>::Register (&f)[3]) {
  using V = typename NodeLanes<Real, U>::Register;
  using Displacement = typename NodeLanes<Real, U>::Displacement;
  const std::ptrdiff_t scalars = static_cast<std::ptrdiff_t>(node) * kLanes + lane;
  const std::ptrdiff_t vectors = static_cast<std::ptrdiff_t>(node) * 3 * kLanes + lane;
  const V inverse_mass = load<V>(motion.inverse_mass + scalars);
  Displacement u[3];
  V v[3];
  for (int c = first; c < 3; ++c) {
    u[c] = load<Displacement>(motion.u + vectors + c * kLanes);
    v[c] = load<V>(motion.v + vectors + c * kLanes);
  }
  if constexpr (sweep == Sweep::revolved) {
    const V weight[2] = {load<V>(motion.weight[0] + lane), load<V>(motion.weight[1] + lane)};
    move_spinning(motion.step, weight, motion.radius[node], inverse_mass, f, u, v);
  } else {
    move_fixed<first>(motion.step, inverse_mass, f, u, v);
  }
  for (int c = first; c < 3; ++c) {
    store(motion.u + vectors + c * kLanes, u[c]);
    store(motion.v + vectors + c * kLanes, v[c]);
  }
}

/// The lanes of all tiles abreast are one row of registers. Components before `first` are zero.
template <class Real, class U, Sweep sweep, bool damped, bool finite_rotation, int first = 0>
class TileLoop {
 public:
  static constexpr int kTiles = kFitting<Real> > kLanes ? kTilesAbreast : 1;
  static constexpr int kAbreast = kTiles * kLanes;
  static constexpr int kWidth = kFitting<Real> < kAbreast ? kFitting<Real> : kAbreast;
  static constexpr int kParts = kAbreast / kWidth;
  using Register = typename Vector<Real, kWidth>::type;
  using Half = typename Vector<Real, kLanes>::type;  ///< where a register holds two tiles
  using Sums = typename Vector<double, kWidth>::type;

  TileLoop(const TileElements<Real>& elements, const TileView<Real, U>& view, Real* front)
      : elements_(elements), view_(view), front_(front), count_((view.tiles - 1) * kLanes + view.elements) {
    if constexpr (kRelative) place_origin();
  }

  /// Of all elements.
  DeformationEnergy energy() const {
    const FrontPlan::Node* open = elements_.open;
    Sums strain{};
    Sums hourglass{};
    for (int i = 0; i < elements_.quad_count; ++i) {
      const FrontPlan::Quad& quad = elements_.quads[i];
      for (; open != elements_.open + quad.opened; ++open) open_node(*open);
      with_elements(i, [&](int lane, const auto& element) {
        add_energy(deformation(quad, lane, element), elements_.swept[i], element, strain, hourglass);
      });
    }
    DeformationEnergy sum;
    for (int lane = 0; lane < kWidth; ++lane) {
      sum.strain += strain[lane];
      sum.hourglass += hourglass[lane];
    }
    return sum;
  }

  void run() const {
    const FrontPlan::Node* open = elements_.open;
    const FrontPlan::Node* close = elements_.close;
    for (int i = 0; i < elements_.quad_count; ++i) {
      const FrontPlan::Quad& quad = elements_.quads[i];
      for (; open != elements_.open + quad.opened; ++open) {
        prefetch(open[kPrefetchAhead].node);
        open_node(*open);
      }
      with_elements(i, [&](int lane, const auto& element) { add_elements(i, quad, lane, element); });
      for (; close != elements_.close + quad.closed; ++close) close_node(*close);
    }
  }

 private:
  /// Displacements are taken relative to a translation, so that what all nodes share is not rounded.
  static constexpr bool kRelative = !std::is_same_v<Real, U>;

  /// The translation is the displacement of one node, in the bases of all stations of the elements; where
  /// there is no station it is zero, as displacements are.
  TREAD_INLINE void place_origin() {
    U at[3];
    for (int i = 0; i < 3; ++i)
      at[i] = view_.u[(static_cast<std::ptrdiff_t>(elements_.open->node) * 3 + i) * kLanes];
    const U c = static_cast<U>(elements_.cosine);
    const U w = static_cast<U>(elements_.sine);
    for (int station = 0; station <= kAbreast; ++station) {
      for (int i = 0; i < 3; ++i) origin_[i][station] = station < count_ ? at[i] : 0;
      if (station == count_)
        for (int i = 0; i < 3; ++i) far_origin_[i] = at[i];
      if constexpr (sweep == Sweep::revolved)
        for (int half = 0; half < 2; ++half) {
          const U t = c * at[0] - w * at[2];
          at[2] = c * at[2] + w * at[0];
          at[0] = t;
        }
    }
  }

  /// A node's displacements and velocities in the next tile, its forces or masses in this one: all that comes
  /// from memory, in an order that the processor does not foresee.
  TREAD_INLINE void prefetch(int node) const {
    const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(node) * 3 * kLanes;
    for (int tile = 0; tile < kTiles && tile < view_.tiles; ++tile) {
      const bool moves = view_.motion[tile] != nullptr;
      if (moves)
        __builtin_prefetch(view_.motion[tile]->inverse_mass + static_cast<std::ptrdiff_t>(node) * kLanes);
      prefetch_vector<0, first>(next(view_.u, view_.u_next, tile) + at);
      if (damped || moves) prefetch_vector<0, first>(next(view_.v, view_.v_next, tile) + at);
      if (!moves) prefetch_vector<1>(view_.f + tile * view_.stride + at);
    }
  }

  /// The field of the tile behind `tile` along the sweep.
  template <class Value>
  TREAD_INLINE const Value* next(const Value* field, const Value* field_next, int tile) const {
    return tile + 1 == view_.tiles ? field_next : field + (tile + 1) * view_.stride;
  }

  /// A part of the lanes of a field whose first tile's values are at `at`.
  TREAD_INLINE Register load_part(const Real* at, int part) const {
    if constexpr (kWidth <= kLanes)
      return load<Register>(at + part * kWidth);
    else
      return abreast(load<Half>(at), view_.tiles > 1 ? load<Half>(at + view_.stride) : Half{});
  }

  /// Of displacements' component i, plus beta times velocity.
  TREAD_INLINE Register displacement(std::ptrdiff_t at, int i, int part) const {
    Register u;
    if constexpr (!kRelative)
      u = load_part(view_.u + at, part);
    else if constexpr (kWidth <= kLanes)
      u = rounded_difference<Real, kWidth>(view_.u + at + part * kWidth, origin_[i] + part * kWidth);
    else
      u = abreast(rounded_difference<Real, kLanes>(view_.u + at, origin_[i]),
                  view_.tiles > 1
                      ? rounded_difference<Real, kLanes>(view_.u + view_.stride + at, origin_[i] + kLanes)
                      : Half{});
    if constexpr (damped) return u + static_cast<Real>(elements_.beta) * load_part(view_.v + at, part);
    return u;
  }

  /// The same at the far end of the last element.
  TREAD_INLINE Real far_displacement(std::ptrdiff_t at, int i) const {
    Real u = 0;
    if constexpr (kRelative)
      u = static_cast<Real>(view_.u_next[at] - far_origin_[i]);
    else
      u = view_.u_next[at];
    if constexpr (damped) return u + static_cast<Real>(elements_.beta) * view_.v_next[at];
    return u;
  }

  /// Opens a node in the front.
  TREAD_INLINE void open_node(const FrontPlan::Node& node) const {
    Real* const slot = corner(node.slot, 0);
    const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(node.node) * 3 * kLanes;
    spread<first>(
        slot, [&](int i, int part) { return displacement(at + i * kLanes, i, part); },
        [&](int i) { return far_displacement(at + i * kLanes, i); });
    for (int rows = 6; rows < 12; rows += 3)
      for (int value = (rows + first) * kAbreast; value < (rows + 3) * kAbreast; value += kWidth)
        store(slot + value, Register{});
    if (elements_.perturbed != nullptr && elements_.shifted[0][node.node] >= 0) open_shift(node);
  }

  TREAD_INLINE void open_shift(const FrontPlan::Node& node) const {
    const LaneShifts<Real>* tile[kTilesAbreast] = {};
    for (int i = 0; i < kTiles; ++i)
      tile[i] = elements_.shifts + (i < view_.tiles ? elements_.shifted[i][node.node] : 0);
    const int next = elements_.shifted_next != nullptr ? elements_.shifted_next[node.node] : 0;
    const LaneShifts<Real>& far = elements_.shifts[next > 0 ? next : 0];
    spread<0>(
        shift_corner(node.slot, 0),
        [&](int i, int part) {
          if constexpr (kWidth <= kLanes)
            return load<Register>(tile[0]->shift[i] + part * kWidth);
          else
            return abreast(load<Half>(tile[0]->shift[i]), load<Half>(tile[1]->shift[i]));
        },
        [&](int i) { return far.shift[i][0]; });
  }

  /// Sums and differences of a node's values at both ends of the elements, in their middle frames:
  /// near_end(component, part) at the stations, far_end(component) behind the last element; of components
  /// from `from` on.
  template <int from, class Near, class Far>
  TREAD_INLINE void spread(Real* to, const Near& near_end, const Far& far_end) const {
    Register s[kParts][3];
    Register d[kParts][3];
    for (int i = from; i < 3; ++i) {
      Register near[kParts];
      Register far[kParts];
      Register next[kParts + 1];
      for (int part = 0; part < kParts; ++part) next[part] = near[part] = near_end(i, part);
      next[kParts] = Register{};
      const Real end = far_end(i);
      if (count_ == kAbreast) [[likely]]
        next[kParts][0] = end;
      else
        for (int part = 0; part < kParts; ++part)
          next[part] = with_lane(near[part], count_ - part * kWidth, end);
      for (int part = 0; part < kParts; ++part) {
        far[part] = shift_down(next[part], next[part + 1]);
        s[part][i] = near[part] + far[part];
        d[part][i] = far[part] - near[part];
      }
    }
    for (int part = 0; part < kParts; ++part, to += kWidth) {
      if constexpr (sweep == Sweep::revolved) turn_to_middle(cosine(), sine(), s[part], d[part]);
      for (int i = from; i < 3; ++i) {
        store(to + i * kAbreast, s[part][i]);
        store(to + (3 + i) * kAbreast, d[part][i]);
      }
    }
  }

  TREAD_INLINE Real cosine() const { return static_cast<Real>(elements_.cosine); }
  TREAD_INLINE Real sine() const { return static_cast<Real>(elements_.sine); }

  /// A register whose last lane is that of the element before the first.
  TREAD_INLINE Register carried(std::ptrdiff_t value) const {
    if constexpr (kWidth <= kLanes) {
      return load<Register>(view_.carry_in + value - (kWidth - 1));
    } else {
      const Half before = load<Half>(view_.carry_in + value - (kLanes - 1));
      return abreast(before, before);
    }
  }

  /// Forces on both ends of the elements; those on the far ends belong to the next lanes.
  TREAD_INLINE void close_node(const FrontPlan::Node& node) const {
    const Real* slot = corner(node.slot, 0);
    Register s[kParts][3];
    Register d[kParts][3];
    for (int part = 0; part < kParts; ++part, slot += kWidth) {
      for (int i = first; i < 3; ++i) {
        s[part][i] = load<Register>(slot + (6 + i) * kAbreast);
        d[part][i] = load<Register>(slot + (9 + i) * kAbreast);
      }
      if constexpr (sweep == Sweep::revolved) turn_to_nodes(cosine(), sine(), s[part], d[part]);
    }
    Register force[kParts][3];
    for (int i = first; i < 3; ++i) {
      const std::ptrdiff_t value = static_cast<std::ptrdiff_t>(node.node) * 3 + i;
      Register far[kParts + 1];
      far[0] = carried(value);
      for (int part = 0; part < kParts; ++part) far[part + 1] = s[part][i] + d[part][i];
      if (count_ == kAbreast) [[likely]] {
        view_.carry_out[value] = far[kParts][kWidth - 1];
      } else {
        Real row[kAbreast];
        for (int part = 0; part < kParts; ++part) store(row + part * kWidth, far[part + 1]);
        view_.carry_out[value] = row[count_ - 1];
        for (int part = 0; part < kParts; ++part)
          far[part + 1] = with_lane(far[part + 1], count_ - 1 - part * kWidth, Real{0});
      }
      for (int part = 0; part < kParts; ++part)
        force[part][i] = (s[part][i] - d[part][i]) + shift_up(far[part], far[part + 1]);
    }
    for (int tile = 0; tile < kTiles && tile < view_.tiles; ++tile) finish_node(node.node, tile, force);
  }

  /// Moves a tile's lanes of a node, or keeps their forces.
  TREAD_INLINE void finish_node(int node, int tile, const Register (&force)[kParts][3]) const {
    constexpr int kNodeWidth = NodeLanes<Real, U>::kWidth;
    using Piece = typename NodeLanes<Real, U>::Register;
    const TileMotion<Real, U>* motion = view_.motion[tile];
    const bool moves = motion != nullptr && motion->deferred[node] == 0;
    Real* f = view_.f + tile * view_.stride + static_cast<std::ptrdiff_t>(node) * 3 * kLanes;
    for (int lane = 0; lane < kLanes; lane += kNodeWidth) {
      const int place = tile * kLanes + lane;
      Piece piece[3];
      for (int i = first; i < 3; ++i) {
        const Register& part = force[place / kWidth][i];
        if constexpr (kNodeWidth == kWidth)
          piece[i] = part;
        else
          piece[i] = load<Piece>(reinterpret_cast<const Real*>(&part) + place % kWidth);
      }
      if (moves)
        move_node<sweep, first, Real, U>(*motion, node, lane, piece);
      else
        for (int i = 0; i < 3; ++i) store(f + i * kLanes + lane, i < first ? Piece{} : piece[i]);
    }
  }

  /// visit(lane, element) for the elements of a quad from that lane on.
  template <class Visit>
  TREAD_INLINE void with_elements(int index, const Visit& visit) const {
    const SweptConstants<Real>& constants = elements_.swept[index];
    if (elements_.perturbed != nullptr && elements_.perturbed[index] != 0) {
      for (int lane = 0; lane < kAbreast; lane += kWidth) {
        Register shift[3][kModes];
        const FrontPlan::Quad& quad = elements_.quads[index];
        for (int i = 0; i < 3; ++i)
          amplitudes([&](int j) { return shift_corner(quad.slot[j], lane) + i * kAbreast; }, shift[i]);
        visit(lane, PerturbedElement<Register, Real>(constants, shift));
      }
    } else {
      for (int lane = 0; lane < kAbreast; lane += kWidth) visit(lane, SweptElement<sweep, Real>{constants});
    }
  }

  /// A corner's values in the front.
  TREAD_INLINE Real* corner(int slot, int lane) const {
    return front_ + static_cast<std::ptrdiff_t>(slot) * kTiles * kFrontValues + lane;
  }

  /// Of all corners of a quad: found once, not for every value that is added to them.
  TREAD_INLINE std::array<Real*, 4> corners(const FrontPlan::Quad& quad, int lane) const {
    return {corner(quad.slot[0], lane), corner(quad.slot[1], lane), corner(quad.slot[2], lane),
            corner(quad.slot[3], lane)};
  }

  TREAD_INLINE Real* shift_corner(int slot, int lane) const {
    return corner(elements_.slots, lane) + static_cast<std::ptrdiff_t>(slot) * kTiles * kShiftValues;
  }

  /// Modal amplitudes of a component whose sums at the quad's corners stand at `sums(corner)`, and whose
  /// differences three rows behind.
  template <class Sums>
  TREAD_INLINE void amplitudes(const Sums& sums, Register (&a)[kModes]) const {
    Register s[4];
    Register d[4];
    for (int j = 0; j < 4; ++j) {
      s[j] = load<Register>(sums(j));
      d[j] = load<Register>(sums(j) + 3 * kAbreast);
    }
    to_modes(s, d, a);
  }

  template <class Element>
  TREAD_INLINE Strain<Register> deformation(const FrontPlan::Quad& quad, int lane,
                                            const Element& element) const {
    const std::array<Real*, 4> at = corners(quad, lane);
    Strain<Register> strain;
    for (int i = first; i < 3; ++i) {
      Register a[kModes];
      amplitudes([&](int j) { return at[j] + i * kAbreast; }, a);
      element.strain(i, a, strain);
    }
    return strain;
  }

  template <class Element>
  TREAD_INLINE void add_elements(int index, const FrontPlan::Quad& quad, int lane,
                                 const Element& element) const {
    const Strain<Register> strain = deformation(quad, lane, element);
    const SweptConstants<Real>& constants = elements_.swept[index];
    Strain<Register> force;
    strain_forces<finite_rotation, first>(constants, element, strain, force);
    const std::array<Real*, 4> at = corners(quad, lane);
    for (int i = first; i < 3; ++i) {
      Register s[4];
      Register d[4];
      Register a[kModes];
      element.forces(i, force, a);
      from_modes(a, s, d);
      for (int j = 0; j < 4; ++j) {
        Real* const fs = at[j] + (6 + i) * kAbreast;
        Real* const fd = at[j] + (9 + i) * kAbreast;
        store(fs, load<Register>(fs) + s[j]);
        store(fd, load<Register>(fd) + d[j]);
      }
    }
  }

  template <class Element>
  TREAD_INLINE void add_energy(const Strain<Register>& deformation, const SweptConstants<Real>& constants,
                               const Element& element, Sums& strain, Sums& hourglass) const {
    Register e[6];
    Register s[6];
    point_strain<finite_rotation, Real>(deformation.g, e);
    point_stress(constants.lambda, constants.mu, e, s);
    Register work = e[0] * s[0];
    for (int i = 1; i < 6; ++i) work += e[i] * s[i];
    strain += 0.5 * __builtin_convertvector(element.energy_in_volume(work), Sums);
    Strain<Register> force;
    hourglass_forces(constants.hourglass, deformation, force);
    for (int i = 0; i < 3; ++i)
      for (int m = 0; m < kHourglassModes; ++m)
        hourglass += 0.5 * __builtin_convertvector(deformation.q[i][m] * force.q[i][m], Sums);
  }

  const TileElements<Real>& elements_;
  const TileView<Real, U>& view_;
  Real* front_;
  int count_;  ///< elements abreast
  alignas(64) U origin_[3][kRelative ? kAbreast + 1 : 1];
  U far_origin_[3];
};

template <class Real, class U, Sweep sweep, bool damped, bool finite_rotation, int first = 0>
void tile_force(const TileElements<Real>& elements, const TileView<Real, U>& view, Real* front) {
  TileLoop<Real, U, sweep, damped, finite_rotation, first>(elements, view, front).run();
}

template <class Real, class U, Sweep sweep, int first>
void move_nodes(const TileMotion<Real, U>& motion, std::span<const int> nodes, const Real* f) {
  using Lanes = NodeLanes<Real, U>;
  using Register = typename Lanes::Register;
  for (const int node : nodes)
    for (int lane = 0; lane < kLanes; lane += Lanes::kWidth) {
      const Real* at = f + static_cast<std::ptrdiff_t>(node) * 3 * kLanes + lane;
      const Register force[3] = {load<Register>(at), load<Register>(at + kLanes),
                                 load<Register>(at + 2 * kLanes)};
      move_node<sweep, first, Real, U>(motion, node, lane, force);
    }
}

template <class Real, class U>
TileMove<Real, U> select_move(TileVariant v) {
  if (v.sweep == Sweep::revolved) return move_nodes<Real, U, Sweep::revolved, 0>;
  return v.vertical_only ? move_nodes<Real, U, Sweep::extruded, 2> : move_nodes<Real, U, Sweep::extruded, 0>;
}

template <class Real, class U, Sweep sweep, bool finite_rotation>
DeformationEnergy tile_energy(const TileElements<Real>& elements, const TileView<Real, U>& view,
                              Real* front) {
  return TileLoop<Real, U, sweep, false, finite_rotation>(elements, view, front).energy();
}

template <class Real, class U>
TileEnergy<Real, U> select_energy(TileVariant v) {
  if (v.sweep == Sweep::revolved)
    return v.finite_rotation ? tile_energy<Real, U, Sweep::revolved, true>
                             : tile_energy<Real, U, Sweep::revolved, false>;
  return v.finite_rotation ? tile_energy<Real, U, Sweep::extruded, true>
                           : tile_energy<Real, U, Sweep::extruded, false>;
}

template <class Real, class U, Sweep sweep>
TileForce<Real, U> select_options(TileVariant v) {
  if (v.damped)
    return v.finite_rotation ? tile_force<Real, U, sweep, true, true>
                             : tile_force<Real, U, sweep, true, false>;
  return v.finite_rotation ? tile_force<Real, U, sweep, false, true>
                           : tile_force<Real, U, sweep, false, false>;
}

template <class Real, class U>
TileForce<Real, U> select_variant(TileVariant v) {
  if (v.vertical_only)
    return v.damped ? tile_force<Real, U, Sweep::extruded, true, false, 2>
                    : tile_force<Real, U, Sweep::extruded, false, false, 2>;
  return v.sweep == Sweep::revolved ? select_options<Real, U, Sweep::revolved>(v)
                                    : select_options<Real, U, Sweep::extruded>(v);
}

template <class Real, class U>
constexpr TileLoops<Real, U> tile_loops = {select_variant<Real, U>, select_energy<Real, U>,
                                           select_move<Real, U>, kFitting<Real> > kLanes ? kTilesAbreast : 1};

}  // namespace
}  // namespace tread
