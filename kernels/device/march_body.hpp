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
    values_ = team.template share<Real>(kOfNode * part_.nodes);
    if constexpr (!kLinear) rates_ = team.template share<Real>(kOfNode * part_.nodes);
    if (block.row != nullptr) shifts_ = team.template share<Real>(kOfNode * part_.nodes);
    sums_ = team.template share<Real>(kOfNode * part_.own_nodes);
    carry_ = team.template share<Real>(6 * part_.own_nodes);
    if constexpr (sweep == Sweep::revolved) weights_ = team.template share<Real>(2 * kLanes);
  }

  /// Bytes that the threads of a team share at most.
  static std::size_t shared_bytes(const MarchBlock<Real>& block) {
    const int values = 1 + (kLinear ? 0 : 1) + (block.row != nullptr ? 1 : 0);
    return sizeof(Real) * static_cast<std::size_t>(kOfNode * values * block.most_nodes +
                                                   (kOfNode + 6) * block.most_own_nodes + 2 * kLanes);
  }

  TREAD_INLINE void run() {
    const int begin = team_.block() / block_.parts * block_.run_tiles;
    const int end = begin + block_.run_tiles < block_.tiles ? begin + block_.run_tiles : block_.tiles;
    lead_in(begin > 0 || block_.closed == 0 ? begin - 1 : block_.tiles - 1);
    for (int tile = begin; tile < end; ++tile) {
      enter(tile);
      add_elements(Lanes{0, 3}, true);
      team_.for_each(kLanes * part_.own_nodes, [&](int i) { close_node(i / kLanes, i % kLanes); });
      old_carry_ = 3 * part_.own_nodes - old_carry_;
    }
  }

 private:
  static constexpr bool kLinear = Law<Real>::kLinear;
  static constexpr bool kRelative = !std::is_same_v<Real, U>;
  static constexpr int kValues = kStateValues<Law>;
  static constexpr int kOfNode = 6 * kLanes;  ///< sums and differences of a node
  using State = typename Law<Real>::template State<Real>;

  /// 1 << shift lanes of a tile from `from` on.
  struct Lanes {
    int from, shift;

    TREAD_INLINE int node(int i) const { return i >> shift; }
    TREAD_INLINE int lane(int i) const { return from + (i & ((1 << shift) - 1)); }
  };

  TREAD_INLINE void enter(int tile) {
    at_ = tile;
    tile_ = block_.tile[tile];
    first_slot_ = block_.base + std::int64_t{tile} * block_.section_nodes * kLanes;
    next_slot_ = block_.base + std::int64_t{tile_.next} * block_.section_nodes * kLanes;
  }

  /// The element before the run is computed for its forces on the run's first station. No tile: there is
  /// none.
  TREAD_INLINE void lead_in(int tile) {
    const bool any = tile >= 0 && block_.tile[tile].elements > 0;
    if (any) {
      enter(tile);
      add_elements(Lanes{tile_.elements - 1, 0}, false);
    }
    team_.for_each(part_.own_nodes, [&](int node) {
      Real onward[3] = {};
      if (any) forces_on_far(node, tile_.elements - 1, onward);
      for (int i = first; i < 3; ++i) carry_[i * part_.own_nodes + node] = onward[i];
    });
  }

  TREAD_INLINE int section_node(int node) const { return block_.part_nodes[part_.first_node + node]; }
  TREAD_INLINE std::int64_t near_slot(int section, int lane) const {
    return first_slot_ + std::int64_t{section} * kLanes + lane;
  }
  /// Slot at the far end of an element.
  TREAD_INLINE std::int64_t far_slot(int section, int lane) const {
    return lane + 1 < tile_.elements ? near_slot(section, lane + 1)
                                     : next_slot_ + std::int64_t{section} * kLanes;
  }

  /// Adds the forces of elements of the tile. Those that share a node do so one after the other, by colour.
  TREAD_INLINE void add_elements(Lanes lanes, bool own) {
    team_.for_each(part_.nodes << lanes.shift, [&](int i) { open_node(lanes.node(i), lanes.lane(i)); });
    const int* const of_colour =
        block_.first_of_colour +
        static_cast<std::ptrdiff_t>(team_.block() % block_.parts) * (block_.colours + 1);
    for (int colour = 0; colour < block_.colours; ++colour) {
      const int begin = of_colour[colour];
      const int quads = of_colour[colour + 1] - begin;
      if (quads == 0) continue;
      team_.for_each(quads << lanes.shift, [&](int i) {
        const int lane = lanes.lane(i);
        if (lane < tile_.elements) add_element(part_.first_quad + begin + lanes.node(i), lane, own);
      });
    }
  }

  /// Place of a value of a node, row 0 ... 5: three sums, three differences.
  TREAD_INLINE static int place(int nodes, int row, int node, int lane) {
    return (row * nodes + node) * kLanes + lane;
  }

  /// Sums and differences of a node's values at both ends of an element, in its middle frame.
  template <int from>
  TREAD_INLINE void spread(const Real (&near)[3], const Real (&far)[3], int node, int lane, Real* to) const {
    Real s[3];
    Real d[3];
    for (int i = from; i < 3; ++i) {
      s[i] = near[i] + far[i];
      d[i] = far[i] - near[i];
    }
    if constexpr (sweep == Sweep::revolved)
      turn_to_middle(block_.cosine[tile_.pitch_class], block_.sine[tile_.pitch_class], s, d);
    for (int i = from; i < 3; ++i) {
      to[place(part_.nodes, i, node, lane)] = s[i];
      to[place(part_.nodes, 3 + i, node, lane)] = d[i];
    }
  }

  TREAD_INLINE void open_node(int node, int lane) const {
    if (node < part_.own_nodes)
      for (int row = 0; row < 6; ++row) sums_[place(part_.own_nodes, row, node, lane)] = 0;
    if constexpr (sweep == Sweep::revolved)
      if (node == 0 && lane < tile_.stations) weigh(block_, tile_.first_station + lane, weights_ + 2 * lane);
    if (lane >= tile_.elements) return;
    const int section = section_node(node);
    const std::int64_t near_at = near_slot(section, lane);
    const std::int64_t far_at = far_slot(section, lane);
    Real near[3];
    Real far[3];
    displacements(near_at, far_at, lane, near, far);
    if (fields_.added != nullptr) {
      Real near_rate[3];
      Real far_rate[3];
      for (int i = first; i < 3; ++i) {
        near_rate[i] = block_.damping * fields_.added[place_in_field(near_at, i)];
        far_rate[i] = block_.damping * fields_.added[place_in_field(far_at, i)];
      }
      if constexpr (kLinear) {
        for (int i = first; i < 3; ++i) {
          near[i] += near_rate[i];
          far[i] += far_rate[i];
        }
      } else {
        spread<first>(near_rate, far_rate, node, lane, rates_);
      }
    }
    spread<first>(near, far, node, lane, values_);
    if (shifts_ != nullptr && row() >= 0) open_shift(node, section, lane);
  }

  /// Where displacements are more precise than the elements, they are taken relative to a translation, that
  /// of the part's first node, so that what all nodes share is not rounded.
  TREAD_INLINE void displacements(std::int64_t near_at, std::int64_t far_at, int lane, Real (&near)[3],
                                  Real (&far)[3]) const {
    U origin[3] = {};
    U far_origin[3] = {};
    if constexpr (kRelative) {
      const std::int64_t of = near_slot(section_node(0), lane);
      for (int i = 0; i < 3; ++i) far_origin[i] = origin[i] = fields_.u[place_in_field(of, i)];
      if constexpr (sweep == Sweep::revolved) {
        const U c = block_.cosine[tile_.pitch_class];
        const U w = block_.sine[tile_.pitch_class];
        for (int half = 0; half < 2; ++half) {
          const U t = c * far_origin[0] - w * far_origin[2];
          far_origin[2] = c * far_origin[2] + w * far_origin[0];
          far_origin[0] = t;
        }
      }
    }
    for (int i = first; i < 3; ++i) {
      near[i] = static_cast<Real>(fields_.u[place_in_field(near_at, i)] - origin[i]);
      far[i] = static_cast<Real>(fields_.u[place_in_field(far_at, i)] - far_origin[i]);
    }
  }

  /// Row of the tile in the tables of moved nodes, where there are any; -1: none near.
  TREAD_INLINE int row() const { return block_.row[at_]; }

  TREAD_INLINE void open_shift(int node, int section, int lane) const {
    Real near[3];
    Real far[3];
    const bool inside = lane + 1 < tile_.elements;
    shift(row(), section, lane, near);
    shift(inside ? row() : block_.row[tile_.next], section, inside ? lane + 1 : 0, far);
    spread<0>(near, far, node, lane, shifts_);
  }

  TREAD_INLINE void shift(int row, int section, int lane, Real (&value)[3]) const {
    const int entry = row < 0 ? 0 : block_.shifted[std::int64_t{row} * block_.section_nodes + section];
    for (int i = 0; i < 3; ++i) value[i] = block_.shifts[entry > 0 ? entry : 0].shift[i][lane];
  }

  /// Modal amplitudes of component i of the nodes' values.
  TREAD_INLINE void amplitudes(const MarchQuad& quad, int lane, const Real* values, int i,
                               Real (&a)[kModes]) const {
    Real s[4];
    Real d[4];
    for (int j = 0; j < 4; ++j) {
      s[j] = values[place(part_.nodes, i, quad.node[j], lane)];
      d[j] = values[place(part_.nodes, 3 + i, quad.node[j], lane)];
    }
    to_modes(s, d, a);
  }

  template <class Element>
  TREAD_INLINE void deform(const MarchQuad& quad, int lane, const Real* values, const Element& element,
                           Strain<Real>& strain) const {
    for (int i = first; i < 3; ++i) {
      Real a[kModes];
      amplitudes(quad, lane, values, i, a);
      element.strain(i, a, strain);
    }
  }

  TREAD_INLINE void add_element(int index, int lane, bool own) const {
    const MarchQuad& quad = block_.part_quads[index];
    const std::int64_t at = std::int64_t{tile_.pitch_class} * block_.quads + quad.place;
    const SweptConstants<Real>& constants = block_.constants[at];
    const int moved = block_.row != nullptr ? row() : -1;
    if (moved >= 0 && block_.perturbed[std::int64_t{moved} * block_.quads + quad.place] != 0) {
      Real shift[3][kModes];
      for (int i = 0; i < 3; ++i) amplitudes(quad, lane, shifts_, i, shift[i]);
      add_element(quad, at, lane, own, PerturbedElement<Real, Real>(constants, shift));
    } else {
      add_element(quad, at, lane, own, SweptElement<sweep, Real>{constants});
    }
  }

  template <class Element>
  TREAD_INLINE void add_element(const MarchQuad& quad, std::int64_t at, int lane, bool own,
                                const Element& element) const {
    const SweptConstants<Real>& constants = block_.constants[at];
    Strain<Real> strain;
    Strain<Real> force;
    deform(quad, lane, values_, element, strain);
    if constexpr (kLinear) {
      strain_forces<finite_rotation, first>(constants, element, strain, force);
    } else {
      const auto& law = static_cast<const ElementLaw<Law<Real>, Real>*>(block_.laws)[at];
      State state = load_state(quad, lane);
      Strain<Real> rate;
      if (fields_.added != nullptr) deform(quad, lane, rates_, element, rate);
      law_forces<finite_rotation>(constants, law, element, strain, fields_.added != nullptr ? &rate : nullptr,
                                  state, force);
      if (own && quad.own != 0) store_state(quad, lane, state);
    }
    for (int i = first; i < 3; ++i) {
      Real s[4];
      Real d[4];
      Real a[kModes];
      element.forces(i, force, a);
      from_modes(a, s, d);
      for (int j = 0; j < 4; ++j) {
        if (quad.node[j] >= part_.own_nodes) continue;
        sums_[place(part_.own_nodes, i, quad.node[j], lane)] += s[j];
        sums_[place(part_.own_nodes, 3 + i, quad.node[j], lane)] += d[j];
      }
    }
  }

  TREAD_INLINE std::int64_t state_place(const MarchQuad& quad, int value, int lane) const {
    return ((std::int64_t{at_} * block_.quads + quad.place) * kValues + value) * kLanes + lane;
  }

  TREAD_INLINE State load_state(const MarchQuad& quad, int lane) const {
    State state{};
    if constexpr (kValues > 0) {
      Real values[kValues];
      for (int i = 0; i < kValues; ++i) values[i] = fields_.state[state_place(quad, i, lane)];
      std::memcpy(&state, values, sizeof values);
    }
    return state;
  }

  TREAD_INLINE void store_state(const MarchQuad& quad, int lane, const State& state) const {
    if constexpr (kValues > 0) {
      Real values[kValues];
      std::memcpy(values, &state, sizeof values);
      for (int i = 0; i < kValues; ++i) fields_.moved_state[state_place(quad, i, lane)] = values[i];
    }
  }

  /// Forces of an element's quads on a node, sums and differences, in the nodes' own bases.
  TREAD_INLINE void forces(int node, int lane, Real (&s)[3], Real (&d)[3]) const {
    for (int i = first; i < 3; ++i) {
      s[i] = sums_[place(part_.own_nodes, i, node, lane)];
      d[i] = sums_[place(part_.own_nodes, 3 + i, node, lane)];
    }
    if constexpr (sweep == Sweep::revolved)
      turn_to_nodes(block_.cosine[tile_.pitch_class], block_.sine[tile_.pitch_class], s, d);
  }

  TREAD_INLINE void forces_on_far(int node, int lane, Real (&force)[3]) const {
    Real s[3] = {};
    Real d[3] = {};
    forces(node, lane, s, d);
    for (int i = first; i < 3; ++i) force[i] = s[i] + d[i];
  }

  /// Adds what the elements on both sides of a station have for a node; keeps what belongs to the next tile.
  TREAD_INLINE void close_node(int node, int lane) const {
    if (lane >= tile_.stations) return;
    Real s[3] = {};
    Real d[3] = {};
    if (lane < tile_.elements) forces(node, lane, s, d);
    Real before[3] = {};
    if (lane > 0) forces_on_far(node, lane - 1, before);
    Real force[3] = {};
    for (int i = first; i < 3; ++i) {
      if (lane == 0) before[i] = carry_[old_carry_ + i * part_.own_nodes + node];
      if (lane == tile_.stations - 1)
        carry_[3 * part_.own_nodes - old_carry_ + i * part_.own_nodes + node] = s[i] + d[i];
      force[i] = (s[i] - d[i]) + before[i];
    }
    finish_node(section_node(node), lane, force);
  }

  /// Moves a node or stores its force.
  TREAD_INLINE void finish_node(int section, int lane, const Real (&force)[3]) const {
    const std::int64_t at = near_slot(section, lane);
    const std::int64_t group = at / kLanes;
    const int host = fields_.group_mark[group];
    if (host >= 0 && fields_.moved_u != nullptr) {
      for (int i = 0; i < 3; ++i) fields_.host_force[(std::int64_t{host} * 3 + i) * kLanes + lane] = force[i];
    } else if (host == kKeeps || fields_.moved_u == nullptr) {
      for (int i = 0; i < 3; ++i) fields_.force[place_in_field(at, i)] = force[i];
    } else {
      move_node(section, lane, at, force);
    }
  }

  TREAD_INLINE void move_node(int section, int lane, std::int64_t at, const Real (&force)[3]) const {
    const Real weight[2] = {sweep == Sweep::revolved ? weights_[2 * lane] : Real{0},
                            sweep == Sweep::revolved ? weights_[2 * lane + 1] : Real{0}};
    move_on_device<sweep, first>(block_, fields_, section, at, weight, force);
  }

  const Team& team_;
  const MarchBlock<Real>& block_;
  const MarchFields<Real, U>& fields_;
  const MarchPart& part_;
  Real* values_ = nullptr;   ///< of the part's nodes, by place()
  Real* rates_ = nullptr;    ///< the same of what damping adds, where the law is not linear
  Real* shifts_ = nullptr;   ///< the same of the shifts of moved nodes, where there are any
  Real* sums_ = nullptr;     ///< of the forces on own nodes, by place()
  Real* carry_ = nullptr;    ///< of two tiles in turn, [component][own node]: of the element before a tile
  Real* weights_ = nullptr;  ///< [lane][along t, along r]: gravity (revolved) [m/s2]
  int old_carry_ = 0;        ///< place of the carry of the tile before
  int at_ = 0;               ///< number of the tile
  Tile tile_;
  std::int64_t first_slot_ = 0,
               next_slot_ = 0;  ///< of section node 0 at lane 0, of the tile and its next one
};

}  // namespace tread
