#pragma once
// The hot loop: internal force of all elements that start in one tile, and the motion of its nodes. Its
// source is compiled once per instruction set; the widest one that the processor has is chosen at run time.

#include <cstddef>
#include <span>
#include <vector>

#include "kernels/element.hpp"
#include "kernels/front_plan.hpp"
#include "kernels/lanes/tie_sum.hpp"
#include "kernels/node_motion_body.hpp"

namespace tread {

/// How the nodes of a tile move over a step; pointers are to the tile's section node 0.
template <class Real>
struct TileMotion {
  StepConstants<Real> step;
  Real* u = nullptr;                        ///< displacement [m]
  Real* v = nullptr;                        ///< velocity [m/s]
  const Real* inverse_mass = nullptr;       ///< 0 where nothing moves: unused lanes, secondary nodes [1/kg]
  const unsigned char* deferred = nullptr;  ///< by section node: more is added to its force before it moves
  bool vertical_only = false;               ///< components 0 and 1 stay zero
  const Real* radius = nullptr;             ///< by section node (revolved) [m]
  Real weight[2][kLanes] = {};              ///< gravity along t and r (revolved) [m/s2]
};

/// Values that a tile reads and writes; `u`, `v`, `f` point to the tile's section node 0. Vector fields: per
/// section node three components of kLanes values.
template <class Real>
struct TileView {
  const Real* u = nullptr;       ///< displacement [m]
  const Real* v = nullptr;       ///< velocity [m/s]; used when `damped`, at hand for `motion`
  const Real* u_next = nullptr;  ///< the same of the tile that holds the last element's far station
  const Real* v_next = nullptr;
  Real* f = nullptr;  ///< force, overwritten [N]
  /// Null, or: nodes move as soon as their force is complete, and only deferred ones store it in `f`.
  const TileMotion<Real>* motion = nullptr;
  const Real* carry_in =
      nullptr;  ///< force of the preceding element on lane 0: [section node][3] behind kLanes of padding [N]
  Real* carry_out = nullptr;  ///< force of this tile's last element on the station behind it [N]
  int elements = 0;           ///< 1 ... kLanes
};

/// What the elements of a tile are made of, in the order of the plan's quads.
template <class Real>
struct TileElements {
  const FrontPlan::Quad* quads = nullptr;
  const FrontPlan::Node* open = nullptr;
  const FrontPlan::Node* close = nullptr;
  int quad_count = 0;
  const SweptConstants<Real>* swept = nullptr;
  const int* perturbed = nullptr;  ///< index into `lanes` or -1; null if all are swept
  const LanePositions<Real>* lanes = nullptr;
  Real beta = 0;    ///< stiffness-proportional damping [s]
  Real cosine = 1;  ///< of half the pitch (revolved)
  Real sine = 0;
};

/// Values of kLanes per node of the front: sum and difference of the displacements, and of the forces.
inline constexpr int kFrontValues = 12 * kLanes;

/// `front` is scratch of plan.slots * kFrontValues values aligned to 64 bytes.
template <class Real>
using TileForce = void (*)(const TileElements<Real>& elements, const TileView<Real>& view, Real* front);

/// Strain and hourglass energy. [J]
struct DeformationEnergy {
  double strain = 0;  ///< of the one-point stress
  double hourglass = 0;
};

/// Energy of a tile's elements by the law that the variant has; reads `u` and `u_next` of the view.
template <class Real>
using TileEnergy = DeformationEnergy (*)(const TileElements<Real>& elements, const TileView<Real>& view,
                                         Real* front);

/// Moves the section nodes `nodes` of a tile by the forces `f`.
template <class Real>
using TileMove = void (*)(const TileMotion<Real>& motion, std::span<const int> nodes, const Real* f);

struct TileVariant {
  Sweep sweep = Sweep::extruded;
  bool damped = false;
  bool finite_rotation = false;
};

/// One instruction set's versions of the loops.
struct TileForces {
  const char* name;
  TileForce<double> (*in_double)(TileVariant);
  TileForce<float> (*in_float)(TileVariant);
  TileEnergy<double> (*energy_in_double)(TileVariant);
  TileEnergy<float> (*energy_in_float)(TileVariant);
  TileMove<double> (*move_in_double)(Sweep);
  TileMove<float> (*move_in_float)(Sweep);
  TieSum<double> tie_in_double;
  TieSum<float> tie_in_float;

  TileForce<double> get(TileVariant variant, double /*precision*/) const { return in_double(variant); }
  TileForce<float> get(TileVariant variant, float /*precision*/) const { return in_float(variant); }
  TileEnergy<double> energy(TileVariant variant, double /*precision*/) const {
    return energy_in_double(variant);
  }
  TileEnergy<float> energy(TileVariant variant, float /*precision*/) const {
    return energy_in_float(variant);
  }
  TileMove<double> get(Sweep sweep, double /*precision*/) const { return move_in_double(sweep); }
  TileMove<float> get(Sweep sweep, float /*precision*/) const { return move_in_float(sweep); }
};

/// The instruction sets that this program contains and this processor has: the one that the environment's
/// TREAD_INSTRUCTION_SET names, then the widest first, down to the baseline. InputError where it names none
/// of them. Results agree between them to rounding, not in bits.
const std::vector<const TileForces*>& tile_forces();

}  // namespace tread
