#pragma once
// Tiles and nodes of a march: what a team keeps for them, and the motion of nodes.
// [kernels/device/march_body.hpp]

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "core/inline.hpp"
#include "kernels/device/march_layout.hpp"
#include "kernels/element/element_body.hpp"

namespace tread {

/// 1 << shift lanes of a tile from `from` on.
struct MarchLanes {
  int from, shift;

  TREAD_INLINE int item(int i) const { return i >> shift; }
  TREAD_INLINE int lane(int i) const { return from + (i & ((1 << shift) - 1)); }
};

/// Place of a value in a field, of fewer than 2^32 values [BlockMarch]: shorter arithmetic than with 64 bits.
using MarchPlace = std::uint32_t;

/// A tile at which a team is.
struct TileAt {
  Tile tile;
  int number;
  MarchPlace group, next_group;  ///< of section node 0, of the tile and its next one
  int row, next_row;             ///< in the tables of moved nodes; -1: none near

  TREAD_INLINE MarchPlace slot(int section_node, int lane) const {
    return (group + section_node) * kLanes + lane;
  }
  /// Place of a node's component 0 in a field, at the near end of a lane's element.
  TREAD_INLINE MarchPlace near_place(int section_node, int lane) const {
    return (group + section_node) * (3 * kLanes) + lane;
  }
  TREAD_INLINE MarchPlace far_place(int section_node, int lane) const {
    return lane + 1 < tile.elements ? near_place(section_node, lane) + 1
                                    : (next_group + section_node) * (3 * kLanes);
  }
};

inline constexpr int kNodeValues = 6 * kLanes;  ///< sums and differences of a node

/// From node to node; nodes whose numbers differ modulo 4 (of 8-byte values: 2) lie in different banks of a
/// card.
inline constexpr int kNodeStride = kNodeValues + kLanes;

/// Sums (rows 0 ... 2) and differences (3 ... 5) of the values of a node's elements in a lane.
template <class Real>
class NodeValues {
 public:
  TREAD_INLINE NodeValues(Real* values, int node, int lane) : first_(values + node * kNodeStride + lane) {}
  TREAD_INLINE Real& operator[](int row) const { return first_[row * kLanes]; }

 private:
  Real* first_;
};

/// Memory that the threads of a team share.
template <class Real, bool linear, bool revolved>
struct MarchRoom {
  Real* values;             ///< of the part's nodes [NodeValues]
  Real* rates = nullptr;    ///< the same of what damping adds, where the law is not linear
  Real* sums;               ///< of the forces on own nodes [NodeValues], then a place that stays zero
  Real* weights = nullptr;  ///< [station of the run][along t, along r]: gravity (revolved) [m/s2]
  MarchQuad* quads;         ///< of the part
  int* section_node;        ///< of the part's nodes
  int* first_of_colour;     ///< among the part's quads, and one more

  template <class Team>
  TREAD_INLINE MarchRoom(const Team& team, const MarchBlock<Real>& block, const MarchPart& part) {
    values = team.template share<Real>(kNodeStride * part.nodes);
    if constexpr (!linear) rates = team.template share<Real>(kNodeStride * part.nodes);
    sums = team.template share<Real>(kNodeStride * (part.own_nodes + 1));
    if constexpr (revolved) weights = team.template share<Real>(2 * kLanes * block.run_tiles);
    quads = team.template share<MarchQuad>(part.quads);
    section_node = team.template share<int>(part.nodes);
    first_of_colour = team.template share<int>(block.colours + 1);
  }
};

/// Bytes of a MarchRoom for the largest part of a block.
template <class Real>
std::size_t room_bytes(const MarchBlock<Real>& block, bool linear, bool revolved) {
  const int of_nodes = (linear ? 1 : 2) * block.most_nodes + block.most_own_nodes + 1;
  const int reals = kNodeStride * of_nodes + (revolved ? 2 * kLanes * block.run_tiles : 0);
  return sizeof(Real) * static_cast<std::size_t>(reals) +
         sizeof(MarchQuad) * static_cast<std::size_t>(block.most_quads) +
         sizeof(int) * static_cast<std::size_t>(block.most_nodes + block.colours + 1);
}

/// Values of a node at both ends of an element, as the fields hold them.
template <class Real, class U>
struct NodeEnds {
  /// Where displacements are more precise than the elements, they are taken relative to a translation, that
  /// of MarchBlock::origin_node, so that what all nodes share is not rounded. It is the same in all parts of
  /// a section: what two of them add for an element is equal and opposite.
  static constexpr bool kRelative = !std::is_same_v<Real, U>;

  U near[3], far[3];                 ///< displacements
  U origin[3];                       ///< of the translation's node, at the near end
  Real near_added[3], far_added[3];  ///< MarchFields::added, if any

  /// `section_node`, `origin_node`: its own, and that of the translation.
  template <int first>
  TREAD_INLINE void load(const MarchFields<Real, U>& fields, const TileAt& at, int section_node,
                         int origin_node, int lane) {
    const MarchPlace near_at = at.near_place(section_node, lane);
    const MarchPlace far_at = at.far_place(section_node, lane);
    take<first>(fields.u + near_at, near);
    take<first>(fields.u + far_at, far);
    if constexpr (kRelative) take<0>(fields.u + at.near_place(origin_node, lane), origin);
    if (fields.added == nullptr) return;
    take<first>(fields.added + near_at, near_added);
    take<first>(fields.added + far_at, far_added);
  }

  /// Displacements for the elements, of this pitch (revolved).
  template <Sweep sweep, int first>
  TREAD_INLINE void displacements(const HalfPitch& pitch, Real (&of_near)[3], Real (&of_far)[3]) const {
    U far_origin[3] = {};
    if constexpr (kRelative) {
      for (int i = 0; i < 3; ++i) far_origin[i] = origin[i];
      if constexpr (sweep == Sweep::revolved) turn_to_far_end(pitch.cosine, pitch.sine, far_origin);
    }
    for (int i = first; i < 3; ++i) {
      of_near[i] = static_cast<Real>(near[i] - (kRelative ? origin[i] : U{}));
      of_far[i] = static_cast<Real>(far[i] - far_origin[i]);
    }
  }

 private:
  template <int first, class T>
  TREAD_INLINE static void take(const T* from, T (&values)[3]) {
    for (int i = first; i < 3; ++i) values[i] = from[i * kLanes];
  }
};

/// A node before it moves.
template <class Real, class U>
struct NodeBefore {
  U u[3] = {};
  Real v[3] = {};
  Real inverse_mass = 0;
  Real radius = 0;  ///< revolved

  /// `at`: place of its component 0 in the fields.
  template <Sweep sweep, int first, class Place>
  TREAD_INLINE void load(const MarchBlock<Real>& block, const MarchFields<Real, U>& fields, int section_node,
                         Place slot, Place at) {
    if constexpr (sweep == Sweep::revolved) radius = block.radius[section_node];
    inverse_mass = fields.inverse_mass[slot];
    const U* const of_u = fields.u + at;
    const Real* const of_v = fields.v + at;
    for (int i = first; i < 3; ++i) {
      u[i] = of_u[i * kLanes];
      v[i] = of_v[i * kLanes];
    }
  }
};

/// Moves a node under its force. `at`: place of its component 0 in the fields; `weight`: gravity at its
/// station (revolved), rounded [m/s2]; `held`: a bit for each component that stays zero.
template <Sweep sweep, int first, class Real, class U, class Place>
TREAD_INLINE void move_on_device(const MarchBlock<Real>& block, const MarchFields<Real, U>& fields, Place at,
                                 const Real (&weight)[2], const Real (&force)[3], unsigned held,
                                 NodeBefore<Real, U>& node) {
  if constexpr (sweep == Sweep::revolved)
    move_spinning(block.step, weight, node.radius, node.inverse_mass, force, node.u, node.v);
  else
    move_fixed<first>(block.step, node.inverse_mass, force, node.u, node.v);
  U* const to_u = fields.moved_u + at;
  Real* const to_v = fields.moved_v + at;
  if (held != 0)
    for (int i = first; i < 3; ++i) {
      if ((held >> i & 1U) == 0) continue;
      node.u[i] = 0;
      node.v[i] = 0;
    }
  for (int i = first; i < 3; ++i) {
    to_u[i * kLanes] = node.u[i];
    to_v[i * kLanes] = node.v[i];
  }
}

/// State of a law in a lane, of values V: its values, kLanes apart.
template <class State, int kValues, class V, class Real>
TREAD_INLINE State load_state(const Real* from) {
  State state{};
  if constexpr (kValues > 0) {
    V values[kValues];
    for (int i = 0; i < kValues; ++i) values[i] = from[i * kLanes];
    std::memcpy(&state, values, sizeof values);
  }
  return state;
}
template <int kValues, class State, class Real>
TREAD_INLINE void store_state(Real* to, const State& state) {
  if constexpr (kValues > 0) {
    Real values[kValues];
    std::memcpy(values, &state, sizeof values);
    for (int i = 0; i < kValues; ++i) to[i * kLanes] = values[i];
  }
}

/// Gravity at a station of a revolved block, rounded [m/s2].
template <class Real>
TREAD_INLINE void weigh(const MarchBlock<Real>& block, int station, Real* weight) {
  const GravityInSweep gravity = gravity_in_sweep(block.gravity, block.angle[station] + block.frame_angle);
  weight[0] = static_cast<Real>(gravity.along);
  weight[1] = static_cast<Real>(gravity.outwards);
}

}  // namespace tread
