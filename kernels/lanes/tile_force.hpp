#pragma once
// The hot loop: internal force of all elements that start in one tile. Its source is compiled once per
// instruction set; the widest one that the processor has is chosen at run time.

#include <cstddef>
#include <vector>

#include "kernels/element.hpp"
#include "kernels/front_plan.hpp"

namespace tread {

/// Values that a tile reads and writes; `u`, `v`, `f` point to the tile's section node 0. Vector fields: per
/// section node three components of kLanes values.
template <class Real>
struct TileView {
  const Real* u = nullptr;       ///< displacement [m]
  const Real* v = nullptr;       ///< velocity [m/s]; used when `damped`
  const Real* u_next = nullptr;  ///< the same of the tile that holds the last element's far station
  const Real* v_next = nullptr;
  Real* f = nullptr;  ///< force, overwritten [N]
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

struct TileVariant {
  Sweep sweep = Sweep::extruded;
  bool damped = false;
  bool finite_rotation = false;
};

/// One instruction set's versions of the loop.
struct TileForces {
  const char* name;
  TileForce<double> (*in_double)(TileVariant);
  TileForce<float> (*in_float)(TileVariant);

  TileForce<double> get(TileVariant variant, double /*precision*/) const { return in_double(variant); }
  TileForce<float> get(TileVariant variant, float /*precision*/) const { return in_float(variant); }
};

/// The instruction sets that this program contains and this processor has: the one that the environment's
/// TREAD_INSTRUCTION_SET names, then the widest first, down to the baseline. InputError where it names none
/// of them. Results agree between them to rounding, not in bits.
const std::vector<const TileForces*>& tile_forces();

}  // namespace tread
