#pragma once
// Tiles and nodes of a march: what a team keeps for them, and the motion of nodes.
// [kernels/device/march_body.hpp]

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

/// A tile at which a team is.
struct TileAt {
  Tile tile;
  int number;
  std::int64_t group, next_group;  ///< of section node 0, of the tile and its next one
  int row, next_row;               ///< in the tables of moved nodes; -1: none near

  /// Place of a node's component 0 in a field, at the near end of a lane's element.
  TREAD_INLINE std::int64_t near_place(int section_node, int lane) const {
    return (group + section_node) * (3 * kLanes) + lane;
  }
  TREAD_INLINE std::int64_t far_place(int section_node, int lane) const {
    return lane + 1 < tile.elements ? near_place(section_node, lane + 1)
                                    : (next_group + section_node) * (3 * kLanes);
  }
};

inline constexpr int kNodeValues = 6 * kLanes;  ///< sums and differences of a node

/// Sums (rows 0 ... 2) and differences (3 ... 5) of the values of a node's elements in a lane. Even and odd
/// rows change places from node to node: on a card two nodes that are read at once then seldom lie in the
/// same banks.
template <class Real>
class NodeValues {
 public:
  TREAD_INLINE NodeValues(Real* values, int node, int lane)
      : even_(values + node * kNodeValues + lane + (node & 1) * kLanes),
        odd_(values + node * kNodeValues + lane - (node & 1) * kLanes) {}
  TREAD_INLINE Real& operator[](int row) const { return (row % 2 == 0 ? even_ : odd_)[row * kLanes]; }

 private:
  Real *even_, *odd_;
};

/// Values of a node at both ends of an element, as the fields hold them.
template <class Real, class U>
struct NodeEnds {
  /// Where displacements are more precise than the elements, they are taken relative to a translation, that
  /// of MarchBlock::origin_node, so that what all nodes share is not rounded. It is the same in all parts of
  /// a section: what two of them add for an element is equal and opposite.
  static constexpr bool kRelative = !std::is_same_v<Real, U>;

  U near[3], far[3];                 ///< displacements
  U origin[3];                       ///< of the translation's node, at the near end
  Real near_added[3], far_added[3];  ///< MarchFields::added

  /// `section_node`, `origin_node`: its own, and that of the translation.
  template <int first>
  TREAD_INLINE void load(const MarchFields<Real, U>& fields, const TileAt& at, int section_node,
                         int origin_node, int lane) {
    const std::int64_t near_at = at.near_place(section_node, lane);
    const std::int64_t far_at = at.far_place(section_node, lane);
    const bool adds = fields.added != nullptr;
    for (int i = first; i < 3; ++i) {
      near[i] = fields.u[near_at + i * kLanes];
      far[i] = fields.u[far_at + i * kLanes];
      near_added[i] = adds ? fields.added[near_at + i * kLanes] : Real{};
      far_added[i] = adds ? fields.added[far_at + i * kLanes] : Real{};
    }
    if constexpr (kRelative)
      for (int i = 0; i < 3; ++i) origin[i] = fields.u[at.near_place(origin_node, lane) + i * kLanes];
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
};

/// A node before it moves.
template <class Real, class U>
struct NodeBefore {
  U u[3] = {};
  Real v[3] = {};
  Real inverse_mass = 0;
  Real radius = 0;  ///< revolved

  /// `at`: place of its component 0 in the fields.
  template <Sweep sweep, int first>
  TREAD_INLINE void load(const MarchBlock<Real>& block, const MarchFields<Real, U>& fields, int section_node,
                         std::int64_t slot, std::int64_t at) {
    if constexpr (sweep == Sweep::revolved) radius = block.radius[section_node];
    inverse_mass = fields.inverse_mass[slot];
    for (int i = first; i < 3; ++i) {
      u[i] = fields.u[at + i * kLanes];
      v[i] = fields.v[at + i * kLanes];
    }
  }
};

/// Moves a node under its force. `at`: place of its component 0 in the fields; `weight`: gravity at its
/// station (revolved), rounded [m/s2]; `held`: a bit for each component that stays zero.
template <Sweep sweep, int first, class Real, class U>
TREAD_INLINE void move_on_device(const MarchBlock<Real>& block, const MarchFields<Real, U>& fields,
                                 std::int64_t at, const Real (&weight)[2], const Real (&force)[3],
                                 unsigned held, NodeBefore<Real, U>& node) {
  if constexpr (sweep == Sweep::revolved)
    move_spinning(block.step, weight, node.radius, node.inverse_mass, force, node.u, node.v);
  else
    move_fixed<first>(block.step, node.inverse_mass, force, node.u, node.v);
  for (int i = first; i < 3; ++i) {
    const bool stays = (held >> i & 1U) != 0;
    fields.moved_u[at + i * kLanes] = stays ? U{} : node.u[i];
    fields.moved_v[at + i * kLanes] = stays ? Real{} : node.v[i];
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
