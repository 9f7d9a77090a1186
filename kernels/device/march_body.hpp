#pragma once
// The march of a team of threads over its part of a block: internal force, and motion of the nodes that
// nothing but elements acts on. Written once for a GPU and for its emulation. [docs/records/device.md]
//
// A team has `block()`, its number; `share<T>(n)`, memory that its threads share; `for_each(n, body)`, which
// calls body(0) ... body(n - 1) in any order, by any thread, and ends when all have ended.

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "core/inline.hpp"
#include "kernels/device/march_layout.hpp"
#include "kernels/element/element_body.hpp"
#include "kernels/element/law_body.hpp"
#include "kernels/material/laws.hpp"

namespace tread {

/// dof(), on a device too.
TREAD_INLINE std::int64_t place_in_field(std::int64_t slot, int component) {
  return (slot / kLanes * 3 + component) * kLanes + slot % kLanes;
}

/// Moves the node of a slot under its force. `weight`: gravity at its station (revolved), rounded [m/s2].
template <Sweep sweep, int first, class Real, class U>
TREAD_INLINE void move_on_device(const MarchBlock<Real>& block, const MarchFields<Real, U>& fields,
                                 int section_node, std::int64_t slot, const Real (&weight)[2],
                                 const Real (&force)[3]) {
  U u[3] = {};
  Real v[3] = {};
  for (int i = first; i < 3; ++i) {
    u[i] = fields.u[place_in_field(slot, i)];
    v[i] = fields.v[place_in_field(slot, i)];
  }
  if constexpr (sweep == Sweep::revolved)
    move_spinning(block.step, weight, block.radius[section_node], fields.inverse_mass[slot], force, u, v);
  else
    move_fixed<first>(block.step, fields.inverse_mass[slot], force, u, v);
  for (int i = first; i < 3; ++i) {
    fields.moved_u[place_in_field(slot, i)] = u[i];
    fields.moved_v[place_in_field(slot, i)] = v[i];
  }
}

/// Gravity at a station of a revolved block, rounded [m/s2].
template <class Real>
TREAD_INLINE void weigh(const MarchBlock<Real>& block, int station, Real* weight) {
  const GravityInSweep gravity = gravity_in_sweep(block.gravity, block.angle[station] + block.frame_angle);
  weight[0] = static_cast<Real>(gravity.along);
  weight[1] = static_cast<Real>(gravity.outwards);
}

template <class Real, class U, Sweep sweep, bool finite_rotation, int first, template <class> class Law,
          class Team>
class March {
 public:
  TREAD_INLINE March(const Team& team, const MarchBlock<Real>& block, const MarchFields<Real, U>& fields)
      : team_(team), block_(block), fields_(fields), part_(block.part[team.block() % block.parts]) {
    const std::size_t nodes = static_cast<std::size_t>(part_.nodes);
    values_ = team.template share<Real>(6 * nodes);
    if constexpr (!kLinear) rates_ = team.template share<Real>(6 * nodes);
    if (block.row != nullptr) shifts_ = team.template share<Real>(6 * nodes);
    forces_ = team.template share<Real>(24 * static_cast<std::size_t>(part_.quads));
    carry_ = team.template share<Real>(3 * static_cast<std::size_t>(part_.own_nodes));
    if constexpr (sweep == Sweep::revolved)
      weights_ = team.template share<Real>(2 * static_cast<std::size_t>(block.run_length));
  }

  /// Bytes that the threads of a team share at most.
  static std::size_t shared_bytes(const MarchBlock<Real>& block) {
    const std::size_t rows = 9 + (kLinear ? 0 : 6) + (block.row != nullptr ? 6 : 0);
    const std::size_t weights = sweep == Sweep::revolved ? 2 * static_cast<std::size_t>(block.run_length) : 0;
    return sizeof(Real) * (rows * static_cast<std::size_t>(block.most_nodes) +
                           24 * static_cast<std::size_t>(block.most_quads) + weights);
  }

  TREAD_INLINE void run() {
    begin_ = team_.block() / block_.parts * block_.run_length;
    const int begin = begin_;
    const int end = begin + block_.run_length < block_.stations ? begin + block_.run_length : block_.stations;
    if constexpr (sweep == Sweep::revolved)
      team_.for_each(end - begin, [&](int i) { weigh(block_, begin + i, weights_ + 2 * i); });
    team_.for_each(3 * part_.own_nodes, [&](int i) { carry_[i] = 0; });
    // The elements before the run are computed for their forces on its first station.
    for (int element = begin > 0 || block_.closed ? begin - 1 : begin; element < end; ++element) {
      at_ = element < 0 ? block_.stations - 1 : element;
      next_ = at_ + 1 < block_.stations ? at_ + 1 : 0;
      const bool exists = next_ != 0 || block_.closed != 0;
      if (exists) add_elements(element >= begin);
      team_.for_each(part_.own_nodes, [&](int node) { close_node(node, exists, element >= begin); });
    }
  }

 private:
  static constexpr bool kLinear = Law<Real>::kLinear;
  static constexpr bool kRelative = !std::is_same_v<Real, U>;
  static constexpr int kValues = kStateValues<Law>;
  using State = typename Law<Real>::template State<Real>;

  TREAD_INLINE int section_node(int node) const { return block_.part_nodes[part_.first_node + node]; }
  TREAD_INLINE std::int64_t slot(int section_node, int station) const {
    return block_.slot[station] + std::int64_t{section_node} * kLanes;
  }

  /// Elements between the stations at_ and next_.
  TREAD_INLINE void add_elements(bool own) {
    team_.for_each(part_.nodes, [&](int node) { open_node(node); });
    team_.for_each(part_.quads, [&](int quad) { add_element(quad, own); });
  }

  /// Sums and differences of a node's values at both ends of the elements, in their middle frame.
  template <int from>
  TREAD_INLINE void spread(const Real (&near)[3], const Real (&far)[3], Real* to) const {
    Real s[3];
    Real d[3];
    for (int i = from; i < 3; ++i) {
      s[i] = near[i] + far[i];
      d[i] = far[i] - near[i];
    }
    if constexpr (sweep == Sweep::revolved) {
      const int pitch_class = block_.pitch_class[at_];
      turn_to_middle(block_.cosine[pitch_class], block_.sine[pitch_class], s, d);
    }
    for (int i = from; i < 3; ++i) {
      to[i * part_.nodes] = s[i];
      to[(3 + i) * part_.nodes] = d[i];
    }
  }

  TREAD_INLINE void open_node(int node) const {
    const int section = section_node(node);
    const std::int64_t near_slot = slot(section, at_);
    const std::int64_t far_slot = slot(section, next_);
    Real near[3];
    Real far[3];
    displacements(near_slot, far_slot, near, far);
    if (fields_.added != nullptr) {
      Real near_rate[3];
      Real far_rate[3];
      for (int i = first; i < 3; ++i) {
        near_rate[i] = block_.damping * fields_.added[place_in_field(near_slot, i)];
        far_rate[i] = block_.damping * fields_.added[place_in_field(far_slot, i)];
      }
      if constexpr (kLinear) {
        for (int i = first; i < 3; ++i) {
          near[i] += near_rate[i];
          far[i] += far_rate[i];
        }
      } else {
        spread<first>(near_rate, far_rate, rates_ + node);
      }
    }
    spread<first>(near, far, values_ + node);
    if (shifts_ != nullptr) open_shift(node, section, near_slot, far_slot);
  }

  /// Where displacements are more precise than the elements, they are taken relative to a translation, that
  /// of the part's first node, so that what all nodes share is not rounded.
  TREAD_INLINE void displacements(std::int64_t near_slot, std::int64_t far_slot, Real (&near)[3],
                                  Real (&far)[3]) const {
    U origin[3] = {};
    U far_origin[3] = {};
    if constexpr (kRelative) {
      const std::int64_t of = slot(section_node(0), at_);
      for (int i = 0; i < 3; ++i) far_origin[i] = origin[i] = fields_.u[place_in_field(of, i)];
      if constexpr (sweep == Sweep::revolved) {
        const U c = block_.cosine[block_.pitch_class[at_]];
        const U w = block_.sine[block_.pitch_class[at_]];
        for (int half = 0; half < 2; ++half) {
          const U t = c * far_origin[0] - w * far_origin[2];
          far_origin[2] = c * far_origin[2] + w * far_origin[0];
          far_origin[0] = t;
        }
      }
    }
    for (int i = first; i < 3; ++i) {
      near[i] = static_cast<Real>(fields_.u[place_in_field(near_slot, i)] - origin[i]);
      far[i] = static_cast<Real>(fields_.u[place_in_field(far_slot, i)] - far_origin[i]);
    }
  }

  TREAD_INLINE void open_shift(int node, int section, std::int64_t near_slot, std::int64_t far_slot) const {
    Real near[3];
    Real far[3];
    shift(section, at_, near_slot, near);
    shift(section, next_, far_slot, far);
    spread<0>(near, far, shifts_ + node);
  }

  TREAD_INLINE void shift(int section, int station, std::int64_t slot, Real (&value)[3]) const {
    const int row = block_.row[block_.tile[station]];
    const int entry = row < 0 ? 0 : block_.shifted[std::int64_t{row} * block_.section_nodes + section];
    for (int i = 0; i < 3; ++i) value[i] = block_.shifts[entry > 0 ? entry : 0].shift[i][slot % kLanes];
  }

  /// Modal amplitudes of component i of the nodes' values.
  TREAD_INLINE void amplitudes(const MarchQuad& quad, const Real* values, int i, Real (&a)[kModes]) const {
    Real s[4];
    Real d[4];
    for (int j = 0; j < 4; ++j) {
      s[j] = values[i * part_.nodes + quad.node[j]];
      d[j] = values[(3 + i) * part_.nodes + quad.node[j]];
    }
    to_modes(s, d, a);
  }

  template <class Element>
  TREAD_INLINE void deform(const MarchQuad& quad, const Real* values, const Element& element,
                           Strain<Real>& strain) const {
    for (int i = first; i < 3; ++i) {
      Real a[kModes];
      amplitudes(quad, values, i, a);
      element.strain(i, a, strain);
    }
  }

  TREAD_INLINE void add_element(int index, bool own) const {
    const MarchQuad& quad = block_.part_quads[part_.first_quad + index];
    const std::int64_t at = std::int64_t{block_.pitch_class[at_]} * block_.quads + quad.place;
    const SweptConstants<Real>& constants = block_.constants[at];
    const int row = block_.row != nullptr ? block_.row[block_.tile[at_]] : -1;
    if (row >= 0 && block_.perturbed[std::int64_t{row} * block_.quads + quad.place] != 0) {
      Real shift[3][kModes];
      for (int i = 0; i < 3; ++i) amplitudes(quad, shifts_, i, shift[i]);
      add_element(index, quad, at, own, PerturbedElement<Real, Real>(constants, shift));
    } else {
      add_element(index, quad, at, own, SweptElement<sweep, Real>{constants});
    }
  }

  template <class Element>
  TREAD_INLINE void add_element(int index, const MarchQuad& quad, std::int64_t at, bool own,
                                const Element& element) const {
    const SweptConstants<Real>& constants = block_.constants[at];
    Strain<Real> strain;
    Strain<Real> force;
    deform(quad, values_, element, strain);
    if constexpr (kLinear) {
      strain_forces<finite_rotation, first>(constants, element, strain, force);
    } else {
      const auto& law = static_cast<const ElementLaw<Law<Real>, Real>*>(block_.laws)[at];
      State state = load_state(quad);
      Strain<Real> rate;
      if (fields_.added != nullptr) deform(quad, rates_, element, rate);
      law_forces<finite_rotation>(constants, law, element, strain, fields_.added != nullptr ? &rate : nullptr,
                                  state, force);
      if (own && quad.own != 0) store_state(quad, state);
    }
    for (int i = first; i < 3; ++i) {
      Real s[4];
      Real d[4];
      Real a[kModes];
      element.forces(i, force, a);
      from_modes(a, s, d);
      for (int j = 0; j < 4; ++j) {
        corner_force(index, i, j) = s[j];
        corner_force(index, 3 + i, j) = d[j];
      }
    }
  }

  TREAD_INLINE Real& corner_force(int quad, int row, int corner) const {
    return forces_[(row * 4 + corner) * part_.quads + quad];
  }

  TREAD_INLINE std::int64_t state_place(const MarchQuad& quad, int value) const {
    return ((std::int64_t{block_.tile[at_]} * block_.quads + quad.place) * kValues + value) * kLanes +
           block_.slot[at_] % kLanes;
  }

  TREAD_INLINE State load_state(const MarchQuad& quad) const {
    State state{};
    if constexpr (kValues > 0) {
      Real values[kValues];
      for (int i = 0; i < kValues; ++i) values[i] = fields_.state[state_place(quad, i)];
      std::memcpy(&state, values, sizeof values);
    }
    return state;
  }

  TREAD_INLINE void store_state(const MarchQuad& quad, const State& state) const {
    if constexpr (kValues > 0) {
      Real values[kValues];
      std::memcpy(values, &state, sizeof values);
      for (int i = 0; i < kValues; ++i) fields_.moved_state[state_place(quad, i)] = values[i];
    }
  }

  /// Adds what the elements on both sides of the station have for a node; keeps what belongs to the next one.
  TREAD_INLINE void close_node(int node, bool exists, bool own) const {
    Real s[3] = {};
    Real d[3] = {};
    if (exists) {
      const int* const corners = block_.first_corner + part_.first_node + node;
      for (int k = corners[0]; k < corners[1]; ++k)
        for (int i = first; i < 3; ++i) {
          s[i] += corner_force(block_.corners[k].quad, i, block_.corners[k].corner);
          d[i] += corner_force(block_.corners[k].quad, 3 + i, block_.corners[k].corner);
        }
      if constexpr (sweep == Sweep::revolved) {
        const int pitch_class = block_.pitch_class[at_];
        turn_to_nodes(block_.cosine[pitch_class], block_.sine[pitch_class], s, d);
      }
    }
    Real force[3] = {};
    for (int i = first; i < 3; ++i) {
      Real& carried = carry_[i * part_.own_nodes + node];
      force[i] = (s[i] - d[i]) + carried;
      carried = s[i] + d[i];
    }
    if (own) finish_node(section_node(node), force);
  }

  /// Moves a node or stores its force.
  TREAD_INLINE void finish_node(int section, const Real (&force)[3]) const {
    const std::int64_t at = slot(section, at_);
    const std::int64_t group = at / kLanes;
    const int host = fields_.group_mark[group];
    if (host >= 0 && fields_.moved_u != nullptr) {
      for (int i = 0; i < 3; ++i)
        fields_.host_force[(std::int64_t{host} * 3 + i) * kLanes + at % kLanes] = force[i];
    } else if (host == kKeeps || fields_.moved_u == nullptr) {
      for (int i = 0; i < 3; ++i) fields_.force[place_in_field(at, i)] = force[i];
    } else {
      move_node(section, at, force);
    }
  }

  TREAD_INLINE void move_node(int section, std::int64_t at, const Real (&force)[3]) const {
    const int of_run = at_ - begin_;
    const Real weight[2] = {sweep == Sweep::revolved ? weights_[2 * of_run] : Real{0},
                            sweep == Sweep::revolved ? weights_[2 * of_run + 1] : Real{0}};
    move_on_device<sweep, first>(block_, fields_, section, at, weight, force);
  }

  const Team& team_;
  const MarchBlock<Real>& block_;
  const MarchFields<Real, U>& fields_;
  const MarchPart& part_;
  Real* values_ = nullptr;   ///< [sum, difference][component][node]
  Real* rates_ = nullptr;    ///< the same of what damping adds, where the law is not linear
  Real* shifts_ = nullptr;   ///< the same of the shifts of moved nodes, where there are any
  Real* forces_ = nullptr;   ///< [sum, difference][component][corner][quad]
  Real* carry_ = nullptr;    ///< [component][node]: of the elements before
  Real* weights_ = nullptr;  ///< [station of the run][along t, along r]: gravity (revolved) [m/s2]
  int begin_ = 0;            ///< first station of the run
  int at_ = 0;               ///< station at which the elements begin
  int next_ = 0;             ///< station at which they end
};

}  // namespace tread
