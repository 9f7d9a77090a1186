#pragma once
// The march of a team of threads over its part of a block: internal force, and motion of the nodes that
// nothing but elements acts on. Written once for a GPU and for its emulation. [docs/records/device.md]
//
// A team has `block()`, its number; `share<T>(n)`, memory that its threads share; `for_each(n, body)`, which
// calls body(0) ... body(n - 1) in any order, by any thread, and ends when all have ended; and
// `fetch_ahead<bytes>(n, place)`, which brings what lies from place(0) ... place(n - 1) on nearer, if
// anything.

#include <cstddef>
#include <cstdint>

#include "core/inline.hpp"
#include "kernels/device/march_node.hpp"
#include "kernels/element/element_body.hpp"
#include "kernels/element/law_body.hpp"
#include "kernels/material/laws.hpp"

namespace tread {

template <class Real, class U, Sweep sweep, bool finite_rotation, int first, template <class> class Law,
          class Team>
class March {
 public:
  static constexpr bool kLinear = Law<Real>::kLinear;

  TREAD_INLINE March(const Team& team, const MarchBlock<Real>& block, const MarchFields<Real, U>& fields)
      : team_(team),
        block_(block),
        fields_(fields),
        run_(block.run_of(team.block())),
        part_number_(block.part_of(team.block())),
        part_(block.part[part_number_]),
        room_(team, block, part_) {}

  /// Bytes that the threads of a team share at most.
  static std::size_t shared_bytes(const MarchBlock<Real>& block) {
    return room_bytes(block, kLinear, sweep == Sweep::revolved);
  }

  TREAD_INLINE void run() {
    if (block_.leaves_out(run_)) return;
    const MarchLanes all{0, 3};
    first_tile_ = run_ * block_.run_tiles;
    const int end =
        first_tile_ + block_.run_tiles < block_.tiles ? first_tile_ + block_.run_tiles : block_.tiles;
    copy_tables(end);
    fetch_motion(first_tile_);
    team_.for_each(kNodeStride * (part_.own_nodes + 1), [&](int i) { room_.sums[i] = 0; });
    lead_in(first_tile_ > 0 || block_.closed == 0 ? first_tile_ - 1 : block_.tiles - 1);
    TileAt to = enter(first_tile_);
    team_.for_each(kLanes * part_.nodes, [&](int i) { open_node(to, all.item(i), all.lane(i)); });
    for (int tile = first_tile_; tile < end; ++tile) {
      const TileAt at = to;
      if (tile + 1 < end) fetch_motion(tile + 1);
      team_.template fetch_ahead<kLanes * sizeof(Real)>(part_.own_nodes, [&](int node) {
        return fields_.inverse_mass + at.slot(room_.section_node[node], 0);
      });
      add_elements(at, all, true);
      if (tile + 1 < end) {
        to = enter(tile + 1);
        team_.for_each(kLanes * part_.nodes, [&](int i) {
          const int node = all.item(i);
          const int lane = all.lane(i);
          NodeEnds<Real, U> ends;  // loads of both nodes wait at once
          load_ends(to, node, lane, ends);
          if (node < part_.own_nodes) close_node(at, node, lane);
          keep_ends(to, node, lane, ends);
        });
      } else {
        team_.for_each(kLanes * part_.own_nodes, [&](int i) { close_node(at, all.item(i), all.lane(i)); });
      }
      new_carry_ = 3 - new_carry_;
    }
  }

 private:
  static constexpr int kValues = kStateValues<Law>;
  using State = typename Law<Real>::template State<Real>;
  using Room = MarchRoom<Real, kLinear, sweep == Sweep::revolved>;

  /// By one loop, so that the loads of all wait at once.
  TREAD_INLINE void copy_tables(int end) {
    const int weighed = sweep == Sweep::revolved ? kLanes * (end - first_tile_) : 0;
    const int* const of_colour = block_.first_of_colour + std::int64_t{part_number_} * (block_.colours + 1);
    int most = block_.colours + 1;
    for (const int items : {weighed, part_.quads, part_.nodes}) most = most < items ? items : most;
    team_.for_each(most, [&](int i) {
      if (i < part_.quads) room_.quads[i] = block_.part_quads[part_.first_quad + i];
      if (i < part_.nodes) room_.section_node[i] = block_.part_nodes[part_.first_node + i];
      if (i <= block_.colours) room_.first_of_colour[i] = of_colour[i];
      if (i >= weighed) return;
      const Tile& tile = block_.tile[first_tile_ + i / kLanes];
      if (i % kLanes < tile.stations) weigh(block_, tile.first_station + i % kLanes, room_.weights + 2 * i);
    });
  }

  TREAD_INLINE TileAt enter(int tile) const {
    TileAt at{block_.tile[tile], tile, group_of(tile), 0, block_.row_of(tile), -1};
    at.next_group = at.tile.next < 0 ? at.group : group_of(at.tile.next);
    at.next_row = block_.row_of(at.tile.next);
    return at;
  }

  TREAD_INLINE MarchPlace group_of(int tile) const {
    return static_cast<MarchPlace>(block_.first_group) + static_cast<MarchPlace>(tile * block_.section_nodes);
  }

  /// Brings the motion of a tile's nodes nearer, while something else is computed.
  TREAD_INLINE void fetch_motion(int tile) const {
    const auto place = [&](int node) { return (group_of(tile) + room_.section_node[node]) * (3 * kLanes); };
    team_.template fetch_ahead<3 * kLanes * sizeof(U)>(part_.nodes,
                                                       [&](int node) { return fields_.u + place(node); });
    if (fields_.added != nullptr)
      team_.template fetch_ahead<3 * kLanes * sizeof(Real)>(
          part_.nodes, [&](int node) { return fields_.added + place(node); });
  }

  /// The element before the run is computed for its forces on the run's first station. No tile: there is
  /// none.
  TREAD_INLINE void lead_in(int tile) {
    const bool any = tile >= 0 && block_.tile[tile].elements > 0;
    TileAt at{};
    if (any) {
      at = enter(tile);
      const MarchLanes last{at.tile.elements - 1, 0};
      team_.for_each(part_.nodes, [&](int node) { open_node(at, node, last.from); });
      add_elements(at, last, false);
    }
    team_.for_each(part_.own_nodes, [&](int node) {
      Real onward[3] = {};
      if (any) forces_on_far(at, node, at.tile.elements - 1, onward);
      for (int i = first; i < 3; ++i) carry(node)[3 - new_carry_ + i] = onward[i];
    });
  }

  /// Adds the forces of elements of the tile. Those that share a node do so one after the other, by colour.
  TREAD_INLINE void add_elements(const TileAt& at, MarchLanes lanes, bool own) const {
    for (int colour = 0; colour < block_.colours; ++colour) {
      const int begin = room_.first_of_colour[colour];
      const int quads = room_.first_of_colour[colour + 1] - begin;
      if (quads == 0) continue;
      team_.for_each(quads << lanes.shift, [&](int i) {
        const int lane = lanes.lane(i);
        if (lane < at.tile.elements) add_element(at, room_.quads[begin + lanes.item(i)], lane, own);
      });
    }
  }

  /// Sums and differences of a node's values at both ends of an element, in its middle frame.
  template <int from>
  TREAD_INLINE void spread(const TileAt& at, const Real (&near)[3], const Real (&far)[3], Real (&s)[3],
                           Real (&d)[3]) const {
    for (int i = from; i < 3; ++i) {
      s[i] = near[i] + far[i];
      d[i] = far[i] - near[i];
    }
    if constexpr (sweep == Sweep::revolved) {
      const HalfPitch& half = block_.half_pitch[at.tile.pitch_class];
      turn_to_middle(static_cast<Real>(half.cosine), static_cast<Real>(half.sine), s, d);
    }
  }
  TREAD_INLINE void keep(const TileAt& at, const Real (&near)[3], const Real (&far)[3],
                         NodeValues<Real> to) const {
    Real s[3];
    Real d[3];
    spread<first>(at, near, far, s, d);
    for (int i = first; i < 3; ++i) {
      to[i] = s[i];
      to[3 + i] = d[i];
    }
  }

  /// Where a lane has no element, some values that no one reads.
  TREAD_INLINE void load_ends(const TileAt& at, int node, int lane, NodeEnds<Real, U>& ends) const {
    ends.template load<first>(fields_, at, room_.section_node[node], block_.origin_node, lane);
  }

  TREAD_INLINE void keep_ends(const TileAt& at, int node, int lane, const NodeEnds<Real, U>& ends) const {
    Real near[3];
    Real far[3];
    HalfPitch pitch{};
    if constexpr (sweep == Sweep::revolved) pitch = block_.half_pitch[at.tile.pitch_class];
    ends.template displacements<sweep, first>(pitch, near, far);
    if (fields_.added != nullptr) {
      Real near_rate[3];
      Real far_rate[3];
      for (int i = first; i < 3; ++i) {
        near_rate[i] = block_.damping * ends.near_added[i];
        far_rate[i] = block_.damping * ends.far_added[i];
      }
      if constexpr (kLinear) {
        for (int i = first; i < 3; ++i) {
          near[i] += near_rate[i];
          far[i] += far_rate[i];
        }
      } else {
        keep(at, near_rate, far_rate, NodeValues<Real>(room_.rates, node, lane));
      }
    }
    keep(at, near, far, NodeValues<Real>(room_.values, node, lane));
  }

  TREAD_INLINE void open_node(const TileAt& at, int node, int lane) const {
    NodeEnds<Real, U> ends;
    load_ends(at, node, lane, ends);
    keep_ends(at, node, lane, ends);
  }

  TREAD_INLINE void shift(int row, int section, int lane, Real (&value)[3]) const {
    const LaneShifts<Real>& shift = block_.shift(row, section);
    for (int i = 0; i < 3; ++i) value[i] = shift.shift[i][lane];
  }

  /// take(component, sums, differences) of the values at a quad's nodes, components from the first one on.
  template <int from, class Take>
  TREAD_INLINE static void with_corners(const MarchQuad& quad, int lane, Real* values, const Take& take) {
    const NodeValues<Real> node[4] = {
        NodeValues<Real>(values, quad.node[0], lane), NodeValues<Real>(values, quad.node[1], lane),
        NodeValues<Real>(values, quad.node[2], lane), NodeValues<Real>(values, quad.node[3], lane)};
    for (int i = from; i < 3; ++i) {
      Real s[4];
      Real d[4];
      for (int j = 0; j < 4; ++j) {
        s[j] = node[j][i];
        d[j] = node[j][3 + i];
      }
      take(i, s, d);
    }
  }

  /// Amplitudes of the shifts of a quad's nodes.
  TREAD_INLINE void shifts(const TileAt& at, const MarchQuad& quad, int lane,
                           Real (&of_modes)[3][kModes]) const {
    const bool inside = lane + 1 < at.tile.elements;
    Real s[3][4];
    Real d[3][4];
    for (int j = 0; j < 4; ++j) {
      const int section = room_.section_node[quad.node[j]];
      Real near[3];
      Real far[3];
      shift(at.row, section, lane, near);
      shift(inside ? at.row : at.next_row, section, inside ? lane + 1 : 0, far);
      Real sum[3];
      Real difference[3];
      spread<0>(at, near, far, sum, difference);
      for (int i = 0; i < 3; ++i) {
        s[i][j] = sum[i];
        d[i][j] = difference[i];
      }
    }
    for (int i = 0; i < 3; ++i) to_modes(s[i], d[i], of_modes[i]);
  }

  TREAD_INLINE void add_element(const TileAt& at, const MarchQuad quad, int lane, bool own) const {
    const int place = at.tile.pitch_class * block_.quads + static_cast<int>(quad.place);
    const SweptConstants<Real> constants = block_.constants[place];  // a copy: its loads wait at once
    if (block_.perturbs(at.row, quad.place)) {
      Real of_modes[3][kModes];
      shifts(at, quad, lane, of_modes);
      add_element(at, quad, place, lane, own, PerturbedElement<Real, Real>(constants, of_modes));
    } else {
      add_element(at, quad, place, lane, own, SweptElement<sweep, Real>{constants});
    }
  }

  template <class Element>
  TREAD_INLINE void add_element(const TileAt& at, const MarchQuad& quad, int place, int lane, bool own,
                                const Element& element) const {
    // Read again, and not passed: a card then has 5 % fewer instructions.
    const SweptConstants<Real> constants = block_.constants[place];
    Strain<Real> strain;
    Strain<Real> force;
    with_corners<first>(quad, lane, room_.values, [&](int i, const Real(&s)[4], const Real(&d)[4]) {
      element.strain(i, s, d, strain);
    });
    if constexpr (kLinear) {
      strain_forces<finite_rotation, first>(constants, element, strain, force);
    } else {
      const auto& law = static_cast<const ElementLaw<Law<Real>, Real>*>(block_.laws)[place];
      const std::int64_t of_state = (std::int64_t{at.number} * block_.quads + quad.place) * kValues;
      auto state = load_state<State, kValues, Real>(fields_.state + of_state * kLanes + lane);
      Strain<Real> rate;
      if (fields_.added != nullptr)
        with_corners<first>(quad, lane, room_.rates, [&](int i, const Real(&s)[4], const Real(&d)[4]) {
          element.strain(i, s, d, rate);
        });
      law_forces<finite_rotation>(constants, law, element, strain, fields_.added != nullptr ? &rate : nullptr,
                                  state, force);
      if (own && quad.own != 0) store_state<kValues>(fields_.moved_state + of_state * kLanes + lane, state);
    }
    add_forces(quad, lane, element, force);
  }

  template <class Element>
  TREAD_INLINE void add_forces(const MarchQuad& quad, int lane, const Element& element,
                               const Strain<Real>& force) const {
    const auto corner = [&](int j) {
      return NodeValues<Real>(room_.sums, quad.node[j] < part_.own_nodes ? quad.node[j] : part_.own_nodes,
                              lane);
    };
    const NodeValues<Real> sums[4] = {corner(0), corner(1), corner(2), corner(3)};
    Real kept[4];  // no choice between values: a product of 0 or 1 costs nothing beside its sum
    for (int j = 0; j < 4; ++j) kept[j] = (quad.begins >> j & 1U) == 0 ? Real{1} : Real{};
    for (int i = first; i < 3; ++i) {
      Real before[8];  // loads of all corners wait at once
      for (int j = 0; j < 4; ++j) {
        before[j] = sums[j][i];
        before[4 + j] = sums[j][3 + i];
      }
      Real s[4];
      Real d[4];
      element.forces(i, force, s, d);
      for (int j = 0; j < 4; ++j) {
        if (quad.node[j] >= part_.own_nodes) continue;
        sums[j][i] = before[j] * kept[j] + s[j];
        sums[j][3 + i] = before[4 + j] * kept[j] + d[j];
      }
    }
  }

  /// Sums and differences of the forces of a lane's elements on a node, in the nodes' own bases.
  TREAD_INLINE void forces(const TileAt& at, int node, int lane, Real (&s)[3], Real (&d)[3]) const {
    const NodeValues<Real> sums(room_.sums, node, lane);
    for (int i = first; i < 3; ++i) {
      s[i] = sums[i];
      d[i] = sums[3 + i];
    }
    if constexpr (sweep == Sweep::revolved) {
      const HalfPitch& half = block_.half_pitch[at.tile.pitch_class];
      turn_to_nodes(static_cast<Real>(half.cosine), static_cast<Real>(half.sine), s, d);
    }
  }

  /// Beside a node's sums: forces of an element on the first station of the next tile, of two tiles in turn.
  TREAD_INLINE Real* carry(int node) const { return room_.sums + node * kNodeStride + kNodeValues; }

  TREAD_INLINE void forces_on_far(const TileAt& at, int node, int lane, Real (&force)[3]) const {
    Real s[3] = {};
    Real d[3] = {};
    forces(at, node, lane, s, d);
    for (int i = first; i < 3; ++i) force[i] = s[i] + d[i];
  }

  /// Adds what the elements on both sides of a station have for a node; keeps what belongs to the next tile.
  TREAD_INLINE void close_node(const TileAt& at, int node, int lane) const {
    if (lane >= at.tile.stations) return;
    const int section = room_.section_node[node];
    const int mark = fields_.group_mark[at.group + section];
    NodeBefore<Real, U> node_before;  // loaded before the forces are at hand
    node_before.template load<sweep, first>(block_, fields_, section, at.slot(section, lane),
                                            at.near_place(section, lane));
    Real s[3] = {};
    Real d[3] = {};
    if (at.tile.elements > 0) forces(at, node, lane, s, d);
    Real before[3] = {};
    Real* const of_carry = carry(node);
    if (lane > 0)
      forces_on_far(at, node, lane - 1, before);
    else
      for (int i = first; i < 3; ++i) before[i] = of_carry[3 - new_carry_ + i];
    if (lane == at.tile.stations - 1)
      for (int i = first; i < 3; ++i) of_carry[new_carry_ + i] = s[i] + d[i];
    Real force[3] = {};
    for (int i = first; i < 3; ++i) force[i] = (s[i] - d[i]) + before[i];
    finish_node(at, section, lane, mark, force, node_before);
  }

  /// Moves a node or stores its force. `host`: of its group [MarchFields::group_mark].
  TREAD_INLINE void finish_node(const TileAt& at, int section, int lane, int host, const Real (&force)[3],
                                NodeBefore<Real, U>& before) const {
    const MarchPlace place = at.near_place(section, lane);
    if (host >= 0 || host == kKeeps) {
      Real* const to = host >= 0 ? fields_.host_force + (host * 3 * kLanes + lane) : fields_.force + place;
      for (int i = 0; i < 3; ++i) to[i * kLanes] = force[i];
    } else {
      Real weight[2] = {};
      if constexpr (sweep == Sweep::revolved)
        for (int i = 0; i < 2; ++i)
          weight[i] = room_.weights[2 * (kLanes * (at.number - first_tile_) + lane) + i];
      const unsigned held = host == kHolds ? fields_.held[at.slot(section, lane)] : 0U;
      move_on_device<sweep, first>(block_, fields_, place, weight, force, held, before);
    }
  }

  const Team& team_;
  const MarchBlock<Real>& block_;
  const MarchFields<Real, U>& fields_;
  int run_, part_number_;
  const MarchPart part_;
  const Room room_;
  int first_tile_ = 0;  ///< of the run
  int new_carry_ = 0;   ///< place of the tile's [carry]; the other: of the tile before
};

}  // namespace tread
