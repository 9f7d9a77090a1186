#pragma once
// Points of the contact patch: their responses, sums over their nodes, and sums of the nodes over their
// points.

#include "core/mesh/swept_block.hpp"
#include "kernels/contact/friction/point_response.hpp"

namespace tread {

/// Three Cartesian components and a zero.
struct alignas(32) PatchVector {
  double value[4] = {};
};

/// Nodes of a cell: 4 stations x 4 nodes across.
inline constexpr int kCellNodes = 16;

/// Weights of a cell's nodes in a point: those of its stations times those of a station's nodes.
struct PatchWeights {
  double along[4], across[4];
};

/// Points that the same nodes of a body carry.
struct CellPoints {
  int count;
  const int* number;            ///< of the point
  const PatchWeights* weights;  ///< of the nodes
};

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
  double before[3][kLanes];    ///< that of the iteration before [Pa]
  double response[3][kLanes];  ///< traction of the last iteration [Pa]
  double change[kLanes];       ///< square of the difference of both [Pa2]
};

/// An iteration of kLanes points.
struct PointIteration {
  PointSprings springs;
  double dt;        ///< [s]
  double weight;    ///< share of the response's difference from `held` that `held` gets
  double momentum;  ///< likewise of its own last change
};

/// Velocities of the points of a tile, those of the wheel against the rail: without contact, and its changes
/// by contact in both bodies. [m/s]
struct PatchVelocities {
  const PatchVector* free;
  const PatchVector* change[2];
};

/// Sets response, change and held tractions of a tile with `points` points, and the impulses of the held
/// tractions on the wheel [N s].
using PatchRespond = void (*)(PointTile& tile, int points, const PointIteration& iteration,
                              const PatchVelocities& velocities, PatchVector* impulse);

/// Sets `sums` of kCellNodes nodes to the weighted sums over the points of a cell.
using CellToNodes = void (*)(const CellPoints& cell, const PatchVector* of_points, PatchVector* sums);

/// Sets the points of a cell to the weighted sums over its nodes, `node` their numbers.
using CellToPoints = void (*)(const CellPoints& cell, const int* node, const PatchVector* of_nodes,
                              PatchVector* of_points);

}  // namespace tread
