#pragma once
// Included by one source per instruction set; internal linkage keeps the versions apart.

#include "kernels/lanes/patch_loop.hpp"
#include "kernels/lanes/registers.hpp"

namespace tread {
namespace {

using PatchRegister = Vector<double, 4>::type;

inline void cell_to_nodes(const CellPoints& cell, const PatchVector* of_points, PatchVector* sums) {
  PatchRegister sum[kCellNodes] = {};
  for (int p = 0; p < cell.count; ++p) {
    const PatchWeights& weights = cell.weights[p];
    const PatchRegister vector = load<PatchRegister>(of_points[cell.number[p]].value);
    for (int i = 0; i < 4; ++i) {
      const PatchRegister part = weights.along[i] * vector;
      for (int j = 0; j < 4; ++j) sum[4 * i + j] += weights.across[j] * part;
    }
  }
  for (int k = 0; k < kCellNodes; ++k) store(sums[k].value, sum[k]);
}

inline void cell_to_points(const CellPoints& cell, const int* node, const PatchVector* of_nodes,
                           PatchVector* of_points) {
  PatchRegister vector[kCellNodes];
  for (int k = 0; k < kCellNodes; ++k) vector[k] = load<PatchRegister>(of_nodes[node[k]].value);
  for (int p = 0; p < cell.count; ++p) {
    const PatchWeights& weights = cell.weights[p];
    PatchRegister station[4];
    for (int i = 0; i < 4; ++i) {
      const PatchRegister* v = vector + 4 * i;
      station[i] = (weights.across[0] * v[0] + weights.across[1] * v[1]) +
                   (weights.across[2] * v[2] + weights.across[3] * v[3]);
    }
    store(of_points[cell.number[p]].value,
          (weights.along[0] * station[0] + weights.along[1] * station[1]) +
              (weights.along[2] * station[2] + weights.along[3] * station[3]));
  }
}

using TileLanes = Vector<double, kLanes>::type;

TREAD_INLINE TileLanes lanes_of(const double (&values)[kLanes]) {
  return load<TileLanes>(values);
}

TREAD_INLINE TractionOf<TileLanes> lanes_of(const double (&values)[2][kLanes]) {
  return {lanes_of(values[0]), lanes_of(values[1])};
}

/// Scalar product of an axis and of velocities by lane.
TREAD_INLINE TileLanes component(const double (&axis)[3][kLanes], const double (&velocity)[3][kLanes]) {
  return lanes_of(axis[0]) * lanes_of(velocity[0]) + lanes_of(axis[1]) * lanes_of(velocity[1]) +
         lanes_of(axis[2]) * lanes_of(velocity[2]);
}

/// Responds to the velocities; returns the impulses by component.
TREAD_INLINE void respond_lanes(PointTile& tile, const PointIteration& iteration,
                                const double (&velocity)[3][kLanes], double (&impulse)[3][kLanes]) {
  TileLanes held[3] = {lanes_of(tile.held[0]), lanes_of(tile.held[1]), lanes_of(tile.held[2])};
  const PointTraction<TileLanes> now = respond<TileLanes>(
      {lanes_of(tile.gap), lanes_of(tile.slip_before), lanes_of(tile.shear_before), lanes_of(tile.friction),
       lanes_of(tile.compliance)},
      iteration.springs, iteration.dt,
      {component(tile.normal, velocity), {component(tile.along, velocity), component(tile.across, velocity)}},
      {held[0], {held[1], held[2]}});
  const TileLanes response[3] = {now.pressure, now.shear.along, now.shear.across};
  TileLanes change{};
  for (int c = 0; c < 3; ++c) {
    const TileLanes difference = response[c] - held[c];
    change += difference * difference;
    held[c] = response[c] + iteration.momentum * (response[c] - lanes_of(tile.response[c]));
    store(tile.held[c], held[c]);
    store(tile.response[c], response[c]);
  }
  store(tile.change, change);
  for (int c = 0; c < 3; ++c)
    store(impulse[c],
          -lanes_of(tile.impulse) * (held[0] * lanes_of(tile.normal[c]) + held[1] * lanes_of(tile.along[c]) +
                                     held[2] * lanes_of(tile.across[c])));
}

inline void patch_respond(PointTile& tile, int points, const PointIteration& iteration,
                          const PatchVelocities& velocities, PatchVector* impulse) {
  double vector[3][kLanes] = {};  // velocities, then impulses
  for (int l = 0; l < points; ++l)
    for (int c = 0; c < 3; ++c)
      vector[c][l] =
          velocities.free[l].value[c] + velocities.change[0][l].value[c] + velocities.change[1][l].value[c];
  respond_lanes(tile, iteration, vector, vector);
  for (int l = 0; l < points; ++l)
    store(impulse[l].value, PatchRegister{vector[0][l], vector[1][l], vector[2][l], 0});
}

}  // namespace
}  // namespace tread
