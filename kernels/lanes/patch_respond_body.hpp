#pragma once
// Sums between points and nodes of a patch, and responses of its points, for a number or for lanes.

#include "kernels/lanes/patch_loop.hpp"

namespace tread {

/// One lane of a tile.
struct OneLane {
  int lane;

  TREAD_INLINE double load(const double (&values)[kLanes]) const { return values[lane]; }
  TREAD_INLINE void store(double (&values)[kLanes], double value) const { values[lane] = value; }
};

/// Part of a point's vector in the sum of the k-th node of its cell.
template <class V>
TREAD_INLINE V node_part(const PatchWeights& weights, int k, const V& vector) {
  return weights.across[k % 4] * (weights.along[k / 4] * vector);
}

/// Weighted sum of the vectors of a cell's nodes, vector(k).
template <class V, class Vector>
TREAD_INLINE V point_sum(const PatchWeights& weights, const Vector& vector) {
  V station[4];
  for (int i = 0; i < 4; ++i)
    station[i] = (weights.across[0] * vector(4 * i) + weights.across[1] * vector(4 * i + 1)) +
                 (weights.across[2] * vector(4 * i + 2) + weights.across[3] * vector(4 * i + 3));
  return (weights.along[0] * station[0] + weights.along[1] * station[1]) +
         (weights.along[2] * station[2] + weights.along[3] * station[3]);
}

/// Scalar product of an axis and of a velocity.
template <class V, class Lane>
TREAD_INLINE V component(const Lane& lane, const double (&axis)[3][kLanes], const V (&velocity)[3]) {
  return lane.load(axis[0]) * velocity[0] + lane.load(axis[1]) * velocity[1] +
         lane.load(axis[2]) * velocity[2];
}

template <class V, class Lane>
TREAD_INLINE TractionOf<V> traction_of(const Lane& lane, const double (&values)[2][kLanes]) {
  return {lane.load(values[0]), lane.load(values[1])};
}

/// Responds to the velocities; returns the impulses by component. `lane` loads and stores the values of one
/// or of all lanes.
template <class V, class Lane>
TREAD_INLINE void respond_in(PointTile& tile, const Lane& lane, const PointIteration& iteration,
                             const V (&velocity)[3], V (&impulse)[3]) {
  V held[3] = {lane.load(tile.held[0]), lane.load(tile.held[1]), lane.load(tile.held[2])};
  const PointTraction<V> now = respond<V>(
      {lane.load(tile.gap), traction_of<V>(lane, tile.slip_before), traction_of<V>(lane, tile.shear_before),
       lane.load(tile.friction), lane.load(tile.compliance)},
      iteration.springs, iteration.dt,
      {component<V>(lane, tile.normal, velocity),
       {component<V>(lane, tile.along, velocity), component<V>(lane, tile.across, velocity)}},
      {held[0], {held[1], held[2]}});
  const V response[3] = {now.pressure, now.shear.along, now.shear.across};
  V change{};
  for (int c = 0; c < 3; ++c) {
    const V difference = response[c] - held[c];
    change += difference * difference;
    const V step = iteration.weight * difference + iteration.momentum * (held[c] - lane.load(tile.before[c]));
    lane.store(tile.before[c], held[c]);
    held[c] += step;
    lane.store(tile.held[c], held[c]);
    lane.store(tile.response[c], response[c]);
  }
  lane.store(tile.change, change);
  for (int c = 0; c < 3; ++c)
    impulse[c] =
        -lane.load(tile.impulse) * (held[0] * lane.load(tile.normal[c]) + held[1] * lane.load(tile.along[c]) +
                                    held[2] * lane.load(tile.across[c]));
}

}  // namespace tread
