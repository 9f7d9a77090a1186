#pragma once
// The nodes of a tile, or of two of them abreast, while their quads are computed: opened with their
// displacements, closed with their forces. Internal linkage keeps the versions of the instruction sets apart.

#include <cstddef>
#include <type_traits>

#include "kernels/element/element_body.hpp"
#include "kernels/lanes/move_node.hpp"
#include "kernels/lanes/registers.hpp"
#include "kernels/lanes/shuffles.hpp"
#include "kernels/lanes/tile_force.hpp"

namespace tread {
namespace {

/// The lanes of all tiles abreast are one row of registers. Components before `first` are zero. `rated`:
/// damping has rows of its own where the view has velocities; `damped`: it adds to the displacements.
template <class Real, class U, Sweep sweep, bool damped, bool rated, int first>
class TileFront {
 public:
  static constexpr int kRateRow = kFrontValues / kLanes;  ///< of a node's values
  static constexpr int kNodeValues = kFrontValues + (rated ? kRateValues : 0);
  static constexpr int kTiles = kFitting<Real> > kLanes ? kTilesAbreast : 1;
  static constexpr int kAbreast = kTiles * kLanes;
  static constexpr int kWidth = kFitting<Real> < kAbreast ? kFitting<Real> : kAbreast;
  static constexpr int kParts = kAbreast / kWidth;
  using Register = typename Vector<Real, kWidth>::type;
  using Half = typename Vector<Real, kLanes>::type;  ///< where a register holds two tiles

 protected:
  TileFront(const TileElements<Real>& elements, const TileView<Real, U>& view, Real* front)
      : elements_(elements), view_(view), front_(front), count_((view.tiles - 1) * kLanes + view.elements) {
    if constexpr (kRelative) place_origin();
  }

  /// Displacements are taken relative to a translation, so that what all nodes share is not rounded.
  static constexpr bool kRelative = !std::is_same_v<Real, U>;

  /// The translation is the displacement of one section node at each station. It rises along an element by
  /// the difference of that at the far end from that at the near end, turned into the far end's basis.
  TREAD_INLINE void place_origin() {
    const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(elements_.origin_node) * 3 * kLanes;
    for (int i = 0; i < 3; ++i) {
      for (int station = 0; station < kAbreast; ++station)
        origin_[i][station] =
            station < count_ ? view_.u[station / kLanes * view_.stride + at + i * kLanes + station % kLanes]
                             : 0;
      far_origin_[i] = view_.u_next[at + i * kLanes];
    }
    for (int station = 0; station < kAbreast; ++station) {
      U near[3];
      for (int i = 0; i < 3; ++i) near[i] = origin_[i][station];
      if constexpr (sweep == Sweep::revolved)
        turn_to_far_end(static_cast<U>(elements_.cosine), static_cast<U>(elements_.sine), near);
      for (int i = 0; i < 3; ++i) {
        const U far = station + 1 < count_ ? origin_[i][station + 1] : far_origin_[i];
        rise_[i][station] = station < count_ ? static_cast<Real>(far - near[i]) : 0;
      }
    }
  }

  /// Lists by node or quad that the loop reads once a step: deferred nodes and quads with moved nodes of the
  /// tiles that come next, whose rows lie behind these, and the shifts' numbers in the tile behind each.
  /// Behind the last row there is nothing to fetch, and nothing is read.
  TREAD_INLINE void prefetch_marks() const {
    const int nodes = elements_.quads[elements_.quad_count - 1].closed;
    const TileMotion<Real, U>* const last = view_.motion[view_.tiles - 1];
    if (last != nullptr) prefetch_row(last->deferred + nodes, view_.tiles * nodes);
    if (elements_.perturbed != nullptr)
      prefetch_row(elements_.perturbed + view_.tiles * elements_.quad_count, elements_.quad_count);
    for (int tile = 0; tile < kTiles && tile < view_.tiles; ++tile)
      if (const int* const shifted = shifted_behind(tile)) prefetch_row(shifted, nodes);
  }

  /// A node's displacements in the next tile and what adds to them, in this tile its forces, or its masses
  /// and velocities: all that comes from memory, in an order that the processor does not foresee.
  TREAD_INLINE void prefetch(int node) const {
    const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(node) * 3 * kLanes;
    const bool adds = damped || (rated && view_.added != nullptr);
    for (int tile = 0; tile < kTiles && tile < view_.tiles; ++tile) {
      prefetch_vector<0, first>(next(view_.u, view_.u_next, tile) + at);
      if (adds) prefetch_vector<0, first>(next(view_.added, view_.added_next, tile) + at);
      if (const int* const shifted = shifted_behind(tile); shifted != nullptr && shifted[node] > 0)
        prefetch_vector<0>(elements_.shifts[shifted[node]].shift[0]);
      if (!moves_at_once(node, tile)) {
        prefetch_vector<1>(view_.f + tile * view_.stride + at);
        continue;
      }
      const TileMotion<Real, U>& motion = *view_.motion[tile];
      __builtin_prefetch(motion.inverse_mass + static_cast<std::ptrdiff_t>(node) * kLanes);
      const bool loaded = adds && motion.v == view_.added + tile * view_.stride;
      if (!loaded) prefetch_vector<1, first>(motion.v + at);
    }
  }

  /// A tile's lanes of a node move as soon as their force is complete.
  TREAD_INLINE bool moves_at_once(int node, int tile) const {
    return view_.motion[tile] != nullptr && view_.motion[tile]->deferred[node] == 0;
  }

  /// The field of the tile behind `tile` along the sweep.
  template <class Value>
  TREAD_INLINE const Value* next(const Value* field, const Value* field_next, int tile) const {
    return tile + 1 == view_.tiles ? field_next : field + (tile + 1) * view_.stride;
  }

  /// Shifts of the tile behind `tile` along the sweep, by node; null: none.
  TREAD_INLINE const int* shifted_behind(int tile) const {
    const int behind = tile + 1;
    return behind < kTiles && behind < view_.tiles ? elements_.shifted[behind] : elements_.shifted_next;
  }

  /// A part of the lanes of a field whose first tile's values are at `at`.
  TREAD_INLINE Register load_part(const Real* at, int part) const {
    if constexpr (kWidth <= kLanes)
      return load<Register>(at + part * kWidth);
    else
      return abreast(load<Half>(at), view_.tiles > 1 ? load<Half>(at + view_.stride) : Half{});
  }

  /// Component i of the displacements, plus that of damping times the velocity or lag.
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
    if constexpr (damped) return u + static_cast<Real>(elements_.damping) * load_part(view_.added + at, part);
    return u;
  }

  /// The same at the far end of the last element.
  TREAD_INLINE Real far_displacement(std::ptrdiff_t at, int i) const {
    Real u = 0;
    if constexpr (kRelative)
      u = static_cast<Real>(view_.u_next[at] - far_origin_[i]);
    else
      u = view_.u_next[at];
    if constexpr (damped) return u + static_cast<Real>(elements_.damping) * view_.added_next[at];
    return u;
  }

  /// Opens a node in the front.
  TREAD_INLINE void open_node(const FrontPlan::Node& node) const {
    Real* const slot = corner(node.slot, 0);
    const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(node.node) * 3 * kLanes;
    spread<first>(
        slot, [&](int i, int part) { return displacement(at + i * kLanes, i, part); },
        [&](int i) { return far_displacement(at + i * kLanes, i); },
        [&](int i, int part, Register& far) {
          if constexpr (kRelative) far += load<Register>(rise_[i] + part * kWidth);
        });
    if constexpr (rated) open_rate(slot, at);
    for (int rows = 6; rows < 12; rows += 3)
      for (int value = (rows + first) * kAbreast; value < (rows + 3) * kAbreast; value += kWidth)
        store(slot + value, Register{});
    if (elements_.perturbed != nullptr && elements_.shifted[0][node.node] >= 0) open_shift(node);
  }

  /// Opens the addition to a node's displacement for damping, in rows of its own.
  TREAD_INLINE void open_rate(Real* slot, std::ptrdiff_t at) const {
    if (view_.added == nullptr) return;
    const Real damping = static_cast<Real>(elements_.damping);
    spread<first>(
        slot + kRateRow * kAbreast,
        [&](int i, int part) { return damping * load_part(view_.added + at + i * kLanes, part); },
        [&](int i) { return damping * view_.added_next[at + i * kLanes]; }, stays);
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
        [&](int i) { return far.shift[i][0]; }, stays);
  }

  /// Does not rise.
  TREAD_INLINE static void stays(int /*component*/, int /*part*/, const Register& /*values*/) {}

  /// Sums and differences of a node's values at both ends of the elements, in their middle frames:
  /// near_end(component, part) at the stations, far_end(component) behind the last element; of components
  /// from `from` on. `rise(component, part, values)` changes those at the far ends.
  template <int from, class Near, class Far, class Rise>
  TREAD_INLINE void spread(Real* to, const Near& near_end, const Far& far_end, const Rise& rise) const {
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
        rise(i, part, far[part]);
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
    const bool moves = moves_at_once(node, tile);
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
        move_node<sweep, first, Real, U>(*view_.motion[tile], node, lane, piece);
      else
        for (int i = 0; i < 3; ++i) store(f + i * kLanes + lane, i < first ? Piece{} : piece[i]);
    }
  }

  /// A corner's values in the front.
  TREAD_INLINE Real* corner(int slot, int lane) const {
    return front_ + static_cast<std::ptrdiff_t>(slot) * kTiles * kNodeValues + lane;
  }

  TREAD_INLINE Real* shift_corner(int slot, int lane) const {
    return corner(elements_.slots, lane) + static_cast<std::ptrdiff_t>(slot) * kTiles * kShiftValues;
  }

  const TileElements<Real>& elements_;
  const TileView<Real, U>& view_;
  Real* front_;
  int count_;  ///< elements abreast
  alignas(64) U origin_[3][kRelative ? kAbreast : 1];
  U far_origin_[3];
  alignas(64) Real rise_[3][kRelative ? kAbreast : 1];  ///< rise of the translation along the elements
};

}  // namespace
}  // namespace tread
