#pragma once
// Points of the contact patch: sums over their nodes, their responses, and sums of the nodes over their
// points.

#include "core/mesh/swept_block.hpp"
#include "kernels/contact/friction/point_response.hpp"

namespace tread {

/// Three Cartesian components and a zero.
struct alignas(32) PatchVector {
  double value[4] = {};
};

/// Terms of weighted sums of vectors.
struct PatchTerms {
  const int* number;  ///< of the vector
  const double* weight;
};

/// Terms of a point's velocity: nodes that carry it, on the wheel and on the rail.
inline constexpr int kLinkedNodes = 32;

/// kLanes points, a lane each; unused lanes hold zeros.
struct alignas(64) PointTile {
  double normal[3][kLanes], along[3][kLanes], across[3][kLanes];  ///< Cartesian
  double impulse[kLanes];                                         ///< of a unit traction: dt A [m2 s]
  double gap[kLanes];                                             ///< PointStep
  double slip_before[2][kLanes];
  double shear_before[2][kLanes];
  double friction[kLanes];
  double compliance[kLanes];
  double held[3][kLanes];      ///< traction under which an iteration sees the motion: pressure, shear [Pa]
  double response[3][kLanes];  ///< traction of the last iteration [Pa]
  double change[kLanes];       ///< square of the difference of both [Pa2]
};

/// An iteration of kLanes points.
struct PointIteration {
  PointSprings springs;
  double dt;        ///< [s]
  double momentum;  ///< share of the response's last change that `held` gets beyond the response
};

/// Sets response, change and held tractions of a tile with `points` points, and the impulses of the held
/// tractions on the wheel [N s]. `terms`: kLinkedNodes a point; `change`: of the nodes' velocities; `free`:
/// the points' velocities without contact [m/s].
using PatchRespond = void (*)(PointTile& tile, int points, const PointIteration& iteration, PatchTerms terms,
                              const PatchVector* change, const PatchVector* free, PatchVector* impulse);

/// start + the weighted sum of `count` terms, added over four partial sums.
using PatchSum = PatchVector (*)(PatchTerms terms, int count, const PatchVector* vectors,
                                 const PatchVector& start);

}  // namespace tread
