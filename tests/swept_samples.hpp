#pragma once
// Small distorted blocks and random fields for tests of swept kernels.

#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "core/aligned.hpp"
#include "core/mesh/swept_block.hpp"

namespace tread::samples {

inline Material steel() {
  return {"steel", 205.9e9, 0.3, 7790, 0};
}
inline Material concrete() {
  return {"concrete", 36e9, 0.2, 2400, 0};
}

struct Grid {
  int columns = 3;  ///< number of quads along p
  int rows = 2;     ///< number of quads along q
  double p = 0;     ///< first coordinate of the corner [m]
  double q = 0;
  double width = 0.03;   ///< [m]
  double height = 0.02;  ///< [m]
  double jitter = 0.2;   ///< random shift of all nodes by element size [-]
};

/// A grid of quads with randomly moved nodes and two materials.
inline Section grid_section(const Grid& grid, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> shift(-grid.jitter, grid.jitter);
  Section section;
  for (int row = 0; row <= grid.rows; ++row)
    for (int column = 0; column <= grid.columns; ++column) {
      section.p.push_back(grid.p + grid.width / grid.columns * (column + shift(random)));
      section.q.push_back(grid.q + grid.height / grid.rows * (row + shift(random)));
    }
  const int stride = grid.columns + 1;
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      const int node = row * stride + column;
      section.quads.push_back({node, node + 1, node + stride + 1, node + stride});
      section.quad_material.push_back((row + column) % 2);
    }
  return section;
}

inline std::vector<Material> materials() {
  return {steel(), concrete(), steel()};
}

inline SweptBlock extruded(double jitter = 0.2) {
  return make_swept_block("bar", Sweep::extruded, grid_section({3, 2, 0.1, -0.02, 0.03, 0.02, jitter}),
                          materials(), -0.3, {{5, 0.01, 0}, {19, 0.004, 1}, {8, 0.01, 0}, {3, 0.02, 1}});
}

inline SweptBlock revolved_open(double jitter = 0.2) {
  return make_swept_block("arc", Sweep::revolved, grid_section({3, 2, -0.01, 0.05, 0.03, 0.02, jitter}),
                          materials(), 0.3, {{9, 0.11, 0}, {8, 0.05, 1}, {3, 0.2, 0}});
}

inline SweptBlock revolved_closed(int elements = 19) {
  return make_swept_block("ring", Sweep::revolved, grid_section({2, 3, -0.01, 0.05, 0.03, 0.02, 0.2}),
                          materials(), -0.1, {{elements, 2 * std::acos(-1.0) / elements, 0}});
}

/// Moves a share of the nodes by up to `size` [m].
inline void shift_nodes(SweptBlock& block, double size, double share = 0.2, unsigned seed = 2) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> value(-1, 1);
  for (int station = 0; station < block.station_count(); ++station)
    for (int node = 0; node < block.section.nodes(); ++node)
      if (0.5 * (1 + value(random)) < share)
        block.node_shift[block.slot(node, station)] = {size * value(random), size * value(random),
                                                       size * value(random)};
}

/// Gives every node the shift of the one `period` stations before it. Shifts of the first period stay.
inline void repeat_shifts(SweptBlock& block, int period) {
  for (int station = period; station < block.station_count(); ++station)
    for (int node = 0; node < block.section.nodes(); ++node)
      block.node_shift[block.slot(node, station)] = block.node_shift[block.slot(node, station - period)];
}

/// Calls visit(block, section node, station, slot in the mesh) for every node.
template <class Visit>
void for_each_node(const Mesh& mesh, const Visit& visit) {
  for (const SweptBlock& block : mesh.blocks)
    for (int station = 0; station < block.station_count(); ++station)
      for (int node = 0; node < block.section.nodes(); ++node)
        visit(block, node, station, block.base + block.slot(node, station));
}

/// A vector field from Cartesian values field(position) at the nodes.
template <class Real = double, class Field>
AlignedVector<Real> sample(const Mesh& mesh, const Field& field) {
  AlignedVector<Real> values(static_cast<std::size_t>(3 * mesh.slots), 0);
  for_each_node(mesh, [&](const SweptBlock& block, int node, int station, std::int64_t slot) {
    const Vec3 local = to_local(block, station, 0, field(position(block, node, station)));
    for (int i = 0; i < 3; ++i) values[static_cast<std::size_t>(dof(slot, i))] = static_cast<Real>(local[i]);
  });
  return values;
}

inline constexpr double kRandomSize = 1e-5;  ///< largest component of random_field [m]

inline AlignedVector<double> random_field(const Mesh& mesh, unsigned seed = 3) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> value(-kRandomSize, kRandomSize);
  return sample(mesh, [&](const Vec3&) { return Vec3{value(random), value(random), value(random)}; });
}

/// Displacement [m] at x of a rotation by `angle` [rad] about a skew axis through the origin.
inline Vec3 rotation(const Vec3& x, double angle) {
  const Vec3 axis = {2.0 / 7, 3.0 / 7, 6.0 / 7};
  const Vec3 across = cross(axis, x);
  return std::sin(angle) * across + (1 - std::cos(angle)) * cross(axis, across);
}

/// Cartesian value of a vector field at a node.
template <class Field>
Vec3 cartesian(const SweptBlock& block, int station, std::int64_t slot, const Field& values) {
  Vec3 local;
  for (int i = 0; i < 3; ++i) local[i] = values[static_cast<std::size_t>(dof(slot, i))];
  return to_cartesian(block, station, 0, local);
}

}  // namespace tread::samples
