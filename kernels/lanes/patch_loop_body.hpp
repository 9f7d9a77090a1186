#pragma once
// Included by one source per instruction set; internal linkage keeps the versions apart.

#include "kernels/lanes/patch_loop.hpp"
#include "kernels/lanes/registers.hpp"

namespace tread {
namespace {

using PatchRegister = Vector<double, 4>::type;

TREAD_INLINE PatchRegister sum_terms(PatchTerms terms, int count, const PatchVector* vectors,
                                     PatchRegister start) {
  constexpr int kSums = 4;  // so that additions wait less for one another
  PatchRegister part[kSums] = {start};
  int k = 0;
  for (; k + kSums <= count; k += kSums)
    for (int i = 0; i < kSums; ++i)
      part[i] += terms.weight[k + i] * load<PatchRegister>(vectors[terms.number[k + i]].value);
  for (int i = 0; k + i < count; ++i)
    part[i] += terms.weight[k + i] * load<PatchRegister>(vectors[terms.number[k + i]].value);
  return (part[0] + part[1]) + (part[2] + part[3]);
}

inline PatchVector patch_sum(PatchTerms terms, int count, const PatchVector* vectors,
                             const PatchVector& start) {
  PatchVector sum;
  store(sum.value, sum_terms(terms, count, vectors, load<PatchRegister>(start.value)));
  return sum;
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

inline void patch_respond(PointTile& tile, int points, const PointIteration& iteration, PatchTerms terms,
                          const PatchVector* change, const PatchVector* free, PatchVector* impulse) {
  double vector[3][kLanes] = {};  // velocities, then impulses
  for (int l = 0; l < points; ++l) {
    const PatchTerms own{terms.number + l * kLinkedNodes, terms.weight + l * kLinkedNodes};
    const PatchRegister v = sum_terms(own, kLinkedNodes, change, load<PatchRegister>(free[l].value));
    for (int c = 0; c < 3; ++c) vector[c][l] = v[c];
  }
  respond_lanes(tile, iteration, vector, vector);
  for (int l = 0; l < points; ++l)
    store(impulse[l].value, PatchRegister{vector[0][l], vector[1][l], vector[2][l], 0});
}

}  // namespace
}  // namespace tread
