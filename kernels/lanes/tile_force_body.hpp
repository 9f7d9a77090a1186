#pragma once
// Included by one source per instruction set; internal linkage keeps the versions apart.

#include "kernels/element_body.hpp"
#include "kernels/lanes/registers.hpp"
#include "kernels/lanes/tie_sum_body.hpp"
#include "kernels/lanes/tile_force.hpp"

namespace tread {
namespace {

/// (a[1], ..., a[last], b[0])
template <class V>
TREAD_INLINE V shift_down(const V& a, const V& b) {
  if constexpr (sizeof a / sizeof a[0] == 8) return __builtin_shufflevector(a, b, 1, 2, 3, 4, 5, 6, 7, 8);
  if constexpr (sizeof a / sizeof a[0] == 4) return __builtin_shufflevector(a, b, 1, 2, 3, 4);
  if constexpr (sizeof a / sizeof a[0] == 2) return __builtin_shufflevector(a, b, 1, 2);
}

/// (a[last], b[0], ..., b[last - 1])
template <class V>
TREAD_INLINE V shift_up(const V& a, const V& b) {
  if constexpr (sizeof a / sizeof a[0] == 8)
    return __builtin_shufflevector(a, b, 7, 8, 9, 10, 11, 12, 13, 14);
  if constexpr (sizeof a / sizeof a[0] == 4) return __builtin_shufflevector(a, b, 3, 4, 5, 6);
  if constexpr (sizeof a / sizeof a[0] == 2) return __builtin_shufflevector(a, b, 1, 2);
}

/// Moves the lanes of a section node that begin at `lane` by their force.
template <Sweep sweep, class Real, class V>
TREAD_INLINE void move_node(const TileMotion<Real>& motion, int node, int lane, const V (&f)[3]) {
  const std::ptrdiff_t first = static_cast<std::ptrdiff_t>(node) * kLanes + lane;
  const std::ptrdiff_t vectors = static_cast<std::ptrdiff_t>(node) * 3 * kLanes + lane;
  const V inverse_mass = load<V>(motion.inverse_mass + first);
  V u[3];
  V v[3];
  for (int c = 0; c < 3; ++c) {
    u[c] = load<V>(motion.u + vectors + c * kLanes);
    v[c] = load<V>(motion.v + vectors + c * kLanes);
  }
  if constexpr (sweep == Sweep::revolved) {
    const V weight[2] = {load<V>(motion.weight[0] + lane), load<V>(motion.weight[1] + lane)};
    move_spinning(motion.step, weight, motion.radius[node], inverse_mass, f, u, v);
  } else {
    move_fixed(motion.step, motion.vertical_only, inverse_mass, f, u, v);
  }
  for (int c = 0; c < 3; ++c) {
    store(motion.u + vectors + c * kLanes, u[c]);
    store(motion.v + vectors + c * kLanes, v[c]);
  }
}

template <class Real, Sweep sweep, bool damped, bool finite_rotation>
class TileLoop {
 public:
  static constexpr int kWidth = Lanes<Real>::kWidth;
  static constexpr int kParts = Lanes<Real>::kParts;
  using Register = typename Lanes<Real>::Register;
  using Sums = typename Vector<double, kWidth>::type;

  TileLoop(const TileElements<Real>& elements, const TileView<Real>& view, Real* front)
      : elements_(elements), view_(view), front_(front) {}

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
  /// A node's displacements and velocities in the next tile, its forces or masses in this one: all that comes
  /// from memory, in an order that the processor does not foresee.
  TREAD_INLINE void prefetch(int node) const {
    constexpr int kLine = 64 / static_cast<int>(sizeof(Real));
    const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(node) * 3 * kLanes;
    const bool moves = view_.motion != nullptr;
    if (moves) __builtin_prefetch(view_.motion->inverse_mass + static_cast<std::ptrdiff_t>(node) * kLanes);
    for (int value = 0; value < 3 * kLanes; value += kLine) {
      __builtin_prefetch(view_.u_next + at + value);
      if (damped || moves) __builtin_prefetch(view_.v_next + at + value);
      if (!moves) __builtin_prefetch(view_.f + at + value, 1);
    }
  }

  TREAD_INLINE Register displacement(const Real* u, const Real* v, std::ptrdiff_t at) const {
    if constexpr (damped) return load<Register>(u + at) + elements_.beta * load<Register>(v + at);
    return load<Register>(u + at);
  }

  /// Sums and differences of a node's displacements at both ends of the elements, in their middle frames.
  TREAD_INLINE void open_node(const FrontPlan::Node& node) const {
    Register s[kParts][3];
    Register d[kParts][3];
    for (int i = 0; i < 3; ++i) {
      const std::ptrdiff_t at = (static_cast<std::ptrdiff_t>(node.node) * 3 + i) * kLanes;
      Register near[kParts + 1];
      Register far[kParts];
      for (int part = 0; part < kParts; ++part)
        near[part] = displacement(view_.u, view_.v, at + part * kWidth);
      near[kParts] = displacement(view_.u_next, view_.v_next, at);
      if (view_.elements == kLanes) [[likely]] {
        for (int part = 0; part < kParts; ++part) far[part] = shift_down(near[part], near[part + 1]);
      } else {
        Real row[kLanes + 1] = {};
        const int last = view_.elements - 1;
        for (int part = 0; part < kParts; ++part) store(row + part * kWidth, near[part]);
        row[last + 1] = near[kParts][0];
        for (int part = 0; part < kParts; ++part) far[part] = load<Register>(row + 1 + part * kWidth);
      }
      for (int part = 0; part < kParts; ++part) {
        s[part][i] = near[part] + far[part];
        d[part][i] = far[part] - near[part];
      }
    }
    Real* slot = front_ + static_cast<std::ptrdiff_t>(node.slot) * kFrontValues;
    for (int part = 0; part < kParts; ++part, slot += kWidth) {
      if constexpr (sweep == Sweep::revolved)
        turn_to_middle(elements_.cosine, elements_.sine, s[part], d[part]);
      for (int i = 0; i < 3; ++i) {
        store(slot + i * kLanes, s[part][i]);
        store(slot + (3 + i) * kLanes, d[part][i]);
        store(slot + (6 + i) * kLanes, Register{});
        store(slot + (9 + i) * kLanes, Register{});
      }
    }
  }

  /// Forces on both ends of the elements; those on the far ends belong to the next lanes.
  TREAD_INLINE void close_node(const FrontPlan::Node& node) const {
    const Real* slot = front_ + static_cast<std::ptrdiff_t>(node.slot) * kFrontValues;
    Register s[kParts][3];
    Register d[kParts][3];
    for (int part = 0; part < kParts; ++part, slot += kWidth) {
      for (int i = 0; i < 3; ++i) {
        s[part][i] = load<Register>(slot + (6 + i) * kLanes);
        d[part][i] = load<Register>(slot + (9 + i) * kLanes);
      }
      if constexpr (sweep == Sweep::revolved)
        turn_to_nodes(elements_.cosine, elements_.sine, s[part], d[part]);
    }
    Register force[kParts][3];
    for (int i = 0; i < 3; ++i) {
      const std::ptrdiff_t value = static_cast<std::ptrdiff_t>(node.node) * 3 + i;
      Register far[kParts + 1];  // behind that of the preceding tile, whose last lane counts
      far[0] = load<Register>(view_.carry_in + value - (kWidth - 1));
      for (int part = 0; part < kParts; ++part) far[part + 1] = s[part][i] + d[part][i];
      if (view_.elements == kLanes) [[likely]] {
        view_.carry_out[value] = far[kParts][kWidth - 1];
      } else {
        Real row[kLanes];
        for (int part = 0; part < kParts; ++part) store(row + part * kWidth, far[part + 1]);
        view_.carry_out[value] = row[view_.elements - 1];
        row[view_.elements - 1] = 0;
        for (int part = 0; part < kParts; ++part) far[part + 1] = load<Register>(row + part * kWidth);
      }
      for (int part = 0; part < kParts; ++part)
        force[part][i] = (s[part][i] - d[part][i]) + shift_up(far[part], far[part + 1]);
    }
    if (view_.motion != nullptr && view_.motion->deferred[node.node] == 0) {
      for (int part = 0; part < kParts; ++part)
        move_node<sweep>(*view_.motion, node.node, part * kWidth, force[part]);
      return;
    }
    for (int part = 0; part < kParts; ++part)
      for (int i = 0; i < 3; ++i)
        store(view_.f + (static_cast<std::ptrdiff_t>(node.node) * 3 + i) * kLanes + part * kWidth,
              force[part][i]);
  }

  /// visit(lane, element) for the elements of a quad from that lane on.
  template <class Visit>
  TREAD_INLINE void with_elements(int index, const Visit& visit) const {
    const SweptConstants<Real>& constants = elements_.swept[index];
    if (elements_.perturbed != nullptr && elements_.perturbed[index] >= 0) {
      const LanePositions<Real>& lanes = elements_.lanes[elements_.perturbed[index]];
      for (int lane = 0; lane < kLanes; lane += kWidth)
        visit(lane, PerturbedElement<Register, Real>(lanes, lane, constants));
    } else {
      for (int lane = 0; lane < kLanes; lane += kWidth) visit(lane, SweptElement<sweep, Real>{constants});
    }
  }

  /// A corner's values in the front.
  TREAD_INLINE Real* corner(const FrontPlan::Quad& quad, int j, int lane) const {
    return front_ + static_cast<std::ptrdiff_t>(quad.slot[j]) * kFrontValues + lane;
  }

  template <class Element>
  TREAD_INLINE Strain<Register> deformation(const FrontPlan::Quad& quad, int lane,
                                            const Element& element) const {
    Strain<Register> strain;
    for (int i = 0; i < 3; ++i) {
      Register s[4];
      Register d[4];
      Register a[kModes];
      for (int j = 0; j < 4; ++j) {
        s[j] = load<Register>(corner(quad, j, lane) + i * kLanes);
        d[j] = load<Register>(corner(quad, j, lane) + (3 + i) * kLanes);
      }
      to_modes(s, d, a);
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
    stress_forces<finite_rotation>(constants, strain, force);
    element.scale_by_volume(force);
    hourglass_forces(constants.hourglass, strain, force);
    for (int i = 0; i < 3; ++i) {
      Register s[4];
      Register d[4];
      Register a[kModes];
      element.forces(i, force, a);
      from_modes(a, s, d);
      for (int j = 0; j < 4; ++j) {
        Real* const fs = corner(quad, j, lane) + (6 + i) * kLanes;
        Real* const fd = corner(quad, j, lane) + (9 + i) * kLanes;
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
  const TileView<Real>& view_;
  Real* front_;
};

template <class Real, Sweep sweep, bool damped, bool finite_rotation>
void tile_force(const TileElements<Real>& elements, const TileView<Real>& view, Real* front) {
  TileLoop<Real, sweep, damped, finite_rotation>(elements, view, front).run();
}

template <class Real, Sweep sweep>
void move_nodes(const TileMotion<Real>& motion, std::span<const int> nodes, const Real* f) {
  using Register = typename Lanes<Real>::Register;
  for (const int node : nodes)
    for (int lane = 0; lane < kLanes; lane += Lanes<Real>::kWidth) {
      const Real* at = f + static_cast<std::ptrdiff_t>(node) * 3 * kLanes + lane;
      const Register force[3] = {load<Register>(at), load<Register>(at + kLanes),
                                 load<Register>(at + 2 * kLanes)};
      move_node<sweep>(motion, node, lane, force);
    }
}

template <class Real>
TileMove<Real> select_move(Sweep sweep) {
  return sweep == Sweep::revolved ? move_nodes<Real, Sweep::revolved> : move_nodes<Real, Sweep::extruded>;
}

template <class Real, Sweep sweep, bool finite_rotation>
DeformationEnergy tile_energy(const TileElements<Real>& elements, const TileView<Real>& view, Real* front) {
  return TileLoop<Real, sweep, false, finite_rotation>(elements, view, front).energy();
}

template <class Real>
TileEnergy<Real> select_energy(TileVariant v) {
  if (v.sweep == Sweep::revolved)
    return v.finite_rotation ? tile_energy<Real, Sweep::revolved, true>
                             : tile_energy<Real, Sweep::revolved, false>;
  return v.finite_rotation ? tile_energy<Real, Sweep::extruded, true>
                           : tile_energy<Real, Sweep::extruded, false>;
}

template <class Real, Sweep sweep>
TileForce<Real> select_options(TileVariant v) {
  if (v.damped)
    return v.finite_rotation ? tile_force<Real, sweep, true, true> : tile_force<Real, sweep, true, false>;
  return v.finite_rotation ? tile_force<Real, sweep, false, true> : tile_force<Real, sweep, false, false>;
}

template <class Real>
TileForce<Real> select_variant(TileVariant v) {
  return v.sweep == Sweep::revolved ? select_options<Real, Sweep::revolved>(v)
                                    : select_options<Real, Sweep::extruded>(v);
}

}  // namespace
}  // namespace tread
