#pragma once
// The hot loop: internal force of all elements that start in one tile or in two of them abreast, and the
// motion of their nodes. Its source is compiled once per instruction set; the widest one that the processor
// has is chosen at run time.
//
// Real is what elements compute in and what velocities, forces and masses are stored in; U is what
// displacements are stored in. Where U is wider, an element's differences are formed in U before they are
// rounded. [theory.md, Precision]

#include <cstddef>
#include <span>
#include <type_traits>
#include <vector>

#include "kernels/element/element.hpp"
#include "kernels/element/front_plan.hpp"
#include "kernels/lanes/patch_loop.hpp"
#include "kernels/lanes/tie_sum.hpp"
#include "kernels/update/node_motion_body.hpp"

namespace tread {

/// Motion of the nodes of a tile over a step; pointers are to the tile's section node 0.
template <class Real, class U>
struct TileMotion {
  StepConstants<Real> step;
  U* u = nullptr;                           ///< displacement [m]
  Real* v = nullptr;                        ///< velocity [m/s]
  const Real* inverse_mass = nullptr;       ///< 0 where nothing moves: unused lanes, secondary nodes [1/kg]
  const unsigned char* deferred = nullptr;  ///< by section node: more is added to its force before it moves
  const Real* radius = nullptr;             ///< by section node (revolved) [m]
  Real weight[2][kLanes] = {};              ///< gravity along t and r (revolved) [m/s2]
};

/// Tiles that a loop takes at once at the most.
inline constexpr int kTilesAbreast = 2;

/// Values that a tile, or a tile and the one that follows it in memory and along the sweep, read and write;
/// `u`, `added`, `f` point to the first one's section node 0. Vector fields: per section node three
/// components of kLanes values.
template <class Real, class U>
struct TileView {
  const U* u = nullptr;         ///< displacement [m]
  const Real* added = nullptr;  ///< velocity [m/s] or lag [m], times TileElements::damping; null: no damping
  const U* u_next = nullptr;    ///< the same of the tile that holds the last element's far station
  const Real* added_next = nullptr;
  Real* f = nullptr;  ///< force, overwritten [N]
  /// By tile: null, or: nodes move as soon as their force is complete, and only deferred ones store it in
  /// `f`.
  const TileMotion<Real, U>* motion[kTilesAbreast] = {};
  const Real* carry_in =
      nullptr;  ///< force of the preceding element on lane 0: [section node][3] behind kLanes of padding [N]
  Real* carry_out = nullptr;  ///< force of the last tile's last element on the station behind it [N]
  int elements = 0;           ///< of the last tile, 1 ... kLanes; another one has kLanes
  int tiles = 1;
  std::ptrdiff_t stride = 0;  ///< from a tile's vector fields to those of the tile behind it in memory
  /// State of the tiles' elements, [tile][quad in the plan's order][value][lane]; null where the law has
  /// none.
  const Real* state = nullptr;
  Real* advanced_state = nullptr;  ///< where `force` writes the state that the strain leads to
};

/// Shifts of the stations of a node from their swept places, in their own bases; unused lanes hold zeros.
/// [m]
template <class Real>
struct LaneShifts {
  Real shift[3][kLanes];
};

/// Coefficients of the elements of a tile, in the order of the plan's quads.
template <class Real>
struct TileElements {
  const FrontPlan::Quad* quads = nullptr;
  const FrontPlan::Node* open = nullptr;
  const FrontPlan::Node* close = nullptr;
  int origin_node = 0;  ///< BlockElements::origin_node
  int quad_count = 0;
  int slots = 0;  ///< of the front
  const SweptConstants<Real>* swept = nullptr;
  const void* laws = nullptr;  ///< of a law that is not linear: ElementLaw by quad
  /// Nonzero for elements that touch moved nodes, the same in all tiles; null if none does.
  const unsigned char* perturbed = nullptr;
  /// By tile and section node: index into `shifts`, or -1 if no such element is at the node.
  const int* shifted[kTilesAbreast] = {};
  const int* shifted_next = nullptr;  ///< of the tile that holds the last element's far station; null: 0
  const LaneShifts<Real>* shifts = nullptr;  ///< the first one is zero
  double damping = 0;  ///< factor of TileView::added: of the velocity [s] or of the lag [-]
  double cosine = 1;   ///< of half the pitch (revolved)
  double sine = 0;
};

/// Values of kLanes per tile and node of the front: sum and difference of the displacements, and of the
/// forces; then, for all nodes, of the shifts.
inline constexpr int kFrontValues = 12 * kLanes;
inline constexpr int kShiftValues = 6 * kLanes;

/// And of what adds to the displacements for damping, where a law is not linear.
inline constexpr int kRateValues = 6 * kLanes;

/// `front` is scratch of plan.slots * kTilesAbreast * (kFrontValues + kShiftValues) values aligned to 64
/// bytes; for a law that is not linear with kRateValues more.
template <class Real, class U>
using TileForce = void (*)(const TileElements<Real>& elements, const TileView<Real, U>& view, Real* front);

/// Strain and hourglass energy. [J]
struct DeformationEnergy {
  double strain = 0;  ///< stored by the law of the one-point stress
  double hourglass = 0;
  double dissipated = 0;  ///< by the law so far

  DeformationEnergy& operator+=(const DeformationEnergy& o) {
    strain += o.strain;
    hourglass += o.hourglass;
    dissipated += o.dissipated;
    return *this;
  }
};

/// Energy of a tile's elements by the law that the variant has; reads `u`, `u_next` and `state` of the view.
template <class Real, class U>
using TileEnergy = DeformationEnergy (*)(const TileElements<Real>& elements, const TileView<Real, U>& view,
                                         Real* front);

/// Moves the section nodes `nodes` of a tile by the forces `f`.
template <class Real, class U>
using TileMove = void (*)(const TileMotion<Real, U>& motion, std::span<const int> nodes, const Real* f);

struct TileVariant {
  Sweep sweep = Sweep::extruded;
  bool damped = false;
  bool finite_rotation = false;
  bool vertical_only = false;  ///< components 0 and 1 are zero: extruded and linear only
  /// Number in Laws. One that is not linear has loops for extruded blocks at small strain and for revolved
  /// ones with finite rotation, whatever the other members say.
  int law = 0;
};

/// The loops of one precision.
template <class Real, class U>
struct TileLoops {
  TileForce<Real, U> (*force)(TileVariant);
  TileEnergy<Real, U> (*energy)(TileVariant);
  TileMove<Real, U> (*move)(TileVariant);
  int tiles;  ///< that `force` takes at once
};

/// One instruction set's versions of the loops.
struct TileForces {
  const char* name;
  TileLoops<double, double> in_double;
  TileLoops<float, double> mixed;
  TileLoops<float, float> single;
  TieSum<double> tie_in_double;
  TieSum<float> tie_in_float;
  PatchRespond patch_respond;
  CellToNodes cell_to_nodes;
  CellToPoints cell_to_points;

  template <class Real, class U>
  const TileLoops<Real, U>& loops() const {
    if constexpr (std::is_same_v<Real, double>)
      return in_double;
    else if constexpr (std::is_same_v<U, double>)
      return mixed;
    else
      return single;
  }
  void sum(const TieTile& tile, bool add, double* field) const { tie_in_double(tile, add, field); }
  void sum(const TieTile& tile, bool add, float* field) const { tie_in_float(tile, add, field); }
};

/// The instruction sets that this program contains and this processor has: the one that the environment's
/// TREAD_INSTRUCTION_SET names, then the widest first, down to the baseline. InputError where it names none
/// of them. Results agree between them to rounding, not in bits.
const std::vector<const TileForces*>& tile_forces();

}  // namespace tread
