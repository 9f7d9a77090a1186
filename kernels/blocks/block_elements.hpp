#pragma once
// The elements of a block: coefficients by quad and pitch class, elements with moved nodes, tiles that the
// loop takes together.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/aligned.hpp"
#include "core/mesh/node_field.hpp"
#include "core/mesh/swept_block.hpp"
#include "kernels/element/element_body.hpp"
#include "kernels/element/front_plan.hpp"
#include "kernels/lanes/tile_force.hpp"
#include "kernels/material/law_state.hpp"

namespace tread {

/// An element and where its coefficients are.
struct ElementPlace {
  int quad = 0;
  int station = 0;  ///< where the element starts
  int place = 0;    ///< of the quad in the front plan
  int pitch_class = 0;
  bool perturbed = false;  ///< it touches moved nodes
};

/// Station at which the element that starts at `station` ends.
inline int far_station(const SweptBlock& block, int station) {
  return station + 1 == block.station_count() ? 0 : station + 1;
}

template <class Real>
class BlockElements {
 public:
  /// Elements of one pitch class, in the order of the plan's quads.
  struct Class {
    double cosine = 1;  ///< of half the pitch
    double sine = 0;
    AlignedVector<SweptConstants<Real>> constants;
    AlignedVector<std::byte> laws;  ///< ElementLaw by place; empty for a linear law
  };

  /// Moved nodes and the elements at them; rows belong to the tiles that have any. `perturbed` is empty where
  /// none has.
  struct MovedNodes {
    const std::vector<int>& row;                  ///< by tile, or -1
    const std::vector<unsigned char>& perturbed;  ///< [row][place]
    const std::vector<int>& shifted;              ///< [row][section node]: index into `shifts`, or -1
    const AlignedVector<LaneShifts<Real>>& shifts;
  };

  /// Keeps a reference to the mesh. InputError lists the elements that their shape, or the shift of their
  /// nodes, turns inside out.
  BlockElements(const Mesh& mesh, int block);

  const SweptBlock& block() const { return mesh_->blocks[static_cast<std::size_t>(block_)]; }
  const FrontPlan& plan() const { return plan_; }
  const Class& elements(const ElementPlace& at) const {
    return classes_[static_cast<std::size_t>(at.pitch_class)];
  }
  const std::vector<Class>& classes() const { return classes_; }
  MovedNodes moved_nodes() const { return {row_, perturbed_, shifted_, shifts_}; }
  /// Section node whose displacement mixed precision takes out of all others, as a translation: a corner of
  /// the smallest quad. Rounding is least near it, and matters most in small elements.
  int origin_node() const { return origin_node_; }
  /// Number of the law in Laws.
  int law() const { return law_; }
  /// Tile whose last element ends in this tile, or -1.
  int previous(int tile) const { return previous_[static_cast<std::size_t>(tile)]; }
  /// Returns true if the loop takes the tile behind this one along where it can.
  bool joins_next(int tile) const { return joins_next_[static_cast<std::size_t>(tile)] != 0; }

  /// Elements of `tiles` tiles as the loop reads them; `damping`: factor of the velocity [s] or of the lag
  /// [-].
  TileElements<Real> tile_elements(int tile, int tiles, double damping) const;
  /// First value of a tile in the block's LawState.
  std::int64_t state_place(int tile) const;

  ElementPlace locate(int quad, int station) const;
  ElementGeometry geometry(const ElementPlace& at) const;
  /// Index into the shifts of moved nodes, 0 where there is none.
  int shift_entry(int section_node, int station) const;
  /// Values of a vector field at an element's nodes; the pointer is that of the whole field.
  void gather(const ElementPlace& at, ConstNodeField u, Real (&values)[8][3]) const;
  /// Sums and differences of the values value(node, component) at both ends of an element, in its middle
  /// frame.
  template <class Value>
  void spread(const ElementPlace& at, const Value& value, Real (&s)[4][3], Real (&d)[4][3]) const;
  /// visit(element), of the type that it has.
  template <class Visit>
  void with_element(const ElementPlace& at, const Visit& visit) const;
  /// visit(place) for all elements.
  template <class Visit>
  void for_each_element(const Visit& visit) const;

  std::int64_t perturbed_elements() const;
  /// Time of a tile in force and motion, in units of its own. [docs/records/performance.md, Kernels]
  std::int64_t cost(int tile) const;
  std::int64_t bytes() const;

 private:
  void build_swept();
  void build_perturbed();
  void mark_perturbed();
  void store_shifts();
  void join_tiles();
  bool perturbed(int tile, int place) const;
  HexNodes element_nodes(const ElementPlace& at) const;
  Real shift(int section_node, int station, int component) const;

  const Mesh* mesh_;
  int block_;
  int law_;
  FrontPlan plan_;
  int origin_node_ = 0;
  std::vector<int> place_;  ///< of each quad in the plan's order
  std::vector<Class> classes_;
  std::vector<int> previous_;
  std::vector<unsigned char> joins_next_;
  std::vector<int> row_;                  ///< by tile: of what follows, or -1: no moved node near
  std::vector<unsigned char> perturbed_;  ///< [row][place]: elements touch moved nodes
  std::vector<int> shifted_;              ///< [row][section node]: index into `shifts_`, or -1
  AlignedVector<LaneShifts<Real>> shifts_;
};

/// Component i of values at the four corners.
template <class Real>
struct CornerComponent {
  Real value[4];
  CornerComponent(int i, const Real (&at)[4][3]) : value{at[0][i], at[1][i], at[2][i], at[3][i]} {}
};

/// Strain of sums and differences at the four corners.
template <class Element, class Real>
Strain<Real> element_strain(const Element& element, const Real (&s)[4][3], const Real (&d)[4][3]) {
  Strain<Real> result;
  for (int i = 0; i < 3; ++i)
    element.strain(i, CornerComponent<Real>(i, s).value, CornerComponent<Real>(i, d).value, result);
  return result;
}

/// Sums and differences at the four corners of the forces conjugate to a strain.
template <class Element, class Real>
void element_forces(const Element& element, const Strain<Real>& force, Real (&s)[4][3], Real (&d)[4][3]) {
  for (int i = 0; i < 3; ++i) {
    Real sum[4];
    Real difference[4];
    element.forces(i, force, sum, difference);
    for (int j = 0; j < 4; ++j) {
      s[j][i] = sum[j];
      d[j][i] = difference[j];
    }
  }
}

/// Sums and differences of the values at both ends of an element, in its middle frame.
template <class Real>
template <class Value>
void BlockElements<Real>::spread(const ElementPlace& at, const Value& value, Real (&s)[4][3],
                                 Real (&d)[4][3]) const {
  const Class& elements = classes_[static_cast<std::size_t>(at.pitch_class)];
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 3; ++i) {
      s[j][i] = value(j, i) + value(j + 4, i);
      d[j][i] = value(j + 4, i) - value(j, i);
    }
    if (block().sweep == Sweep::revolved)
      turn_to_middle(static_cast<Real>(elements.cosine), static_cast<Real>(elements.sine), s[j], d[j]);
  }
}

/// visit(element), of the type that it has.
template <class Real>
template <class Visit>
void BlockElements<Real>::with_element(const ElementPlace& at, const Visit& visit) const {
  const SweptBlock& swept = block();
  const Class& elements = classes_[static_cast<std::size_t>(at.pitch_class)];
  const SweptConstants<Real>& constants = elements.constants[static_cast<std::size_t>(at.place)];
  if (at.perturbed) {
    Real s[4][3];
    Real d[4][3];
    Real shifts[3][kModes];
    const auto at_node = [&](int node, int i) {
      return shift(swept.section.quads[static_cast<std::size_t>(at.quad)][static_cast<std::size_t>(node % 4)],
                   node < 4 ? at.station : far_station(swept, at.station), i);
    };
    spread(at, at_node, s, d);
    for (int i = 0; i < 3; ++i)
      to_modes(CornerComponent<Real>(i, s).value, CornerComponent<Real>(i, d).value, shifts[i]);
    visit(PerturbedElement<Real, Real>(constants, shifts));
  } else if (swept.sweep == Sweep::revolved) {
    visit(SweptElement<Sweep::revolved, Real>{constants});
  } else {
    visit(SweptElement<Sweep::extruded, Real>{constants});
  }
}

template <class Real>
template <class Visit>
void BlockElements<Real>::for_each_element(const Visit& visit) const {
  const SweptBlock& swept = block();
  for (const Tile& tile : swept.tiles)
    for (const FrontPlan::Quad& entry : plan_.quads)
      for (int lane = 0; lane < tile.elements; ++lane) visit(locate(entry.quad, tile.first_station + lane));
}

extern template class BlockElements<double>;
extern template class BlockElements<float>;

}  // namespace tread
