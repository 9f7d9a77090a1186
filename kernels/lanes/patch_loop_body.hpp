#pragma once
// Included by one source per instruction set; internal linkage keeps the versions apart.

#include "kernels/lanes/patch_loop.hpp"
#include "kernels/lanes/patch_respond_body.hpp"
#include "kernels/lanes/registers.hpp"

namespace tread {
namespace {

using PatchRegister = Vector<double, 4>::type;

inline void cell_to_nodes(const CellPoints& cell, const PatchVector* of_points, PatchVector* sums) {
  PatchRegister sum[kCellNodes] = {};
  for (int p = 0; p < cell.count; ++p) {
    const PatchRegister vector = load<PatchRegister>(of_points[cell.number[p]].value);
    for (int k = 0; k < kCellNodes; ++k) sum[k] += node_part(cell.weights[p], k, vector);
  }
  for (int k = 0; k < kCellNodes; ++k) store(sums[k].value, sum[k]);
}

inline void cell_to_points(const CellPoints& cell, const int* node, const PatchVector* of_nodes,
                           PatchVector* of_points) {
  PatchRegister vector[kCellNodes];
  for (int k = 0; k < kCellNodes; ++k) vector[k] = load<PatchRegister>(of_nodes[node[k]].value);
  for (int p = 0; p < cell.count; ++p)
    store(of_points[cell.number[p]].value,
          point_sum<PatchRegister>(cell.weights[p], [&](int k) { return vector[k]; }));
}

using TileLanes = Vector<double, kLanes>::type;

/// All lanes of a tile.
struct AllLanes {
  TREAD_INLINE TileLanes load(const double (&values)[kLanes]) const { return tread::load<TileLanes>(values); }
  TREAD_INLINE void store(double (&values)[kLanes], const TileLanes& value) const {
    tread::store(values, value);
  }
};

inline void patch_respond(PointTile& tile, int points, const PointIteration& iteration,
                          const PatchVelocities& velocities, PatchVector* impulse) {
  double vector[3][kLanes] = {};  // velocities, then impulses
  for (int l = 0; l < points; ++l)
    for (int c = 0; c < 3; ++c)
      vector[c][l] =
          velocities.free[l].value[c] + velocities.change[0][l].value[c] + velocities.change[1][l].value[c];
  constexpr AllLanes kAll{};
  const TileLanes velocity[3] = {kAll.load(vector[0]), kAll.load(vector[1]), kAll.load(vector[2])};
  TileLanes impulses[3];
  respond_in(tile, kAll, iteration, velocity, impulses);
  for (int c = 0; c < 3; ++c) kAll.store(vector[c], impulses[c]);
  for (int l = 0; l < points; ++l)
    store(impulse[l].value, PatchRegister{vector[0][l], vector[1][l], vector[2][l], 0});
}

}  // namespace
}  // namespace tread
