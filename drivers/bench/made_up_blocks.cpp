#include "drivers/bench/made_up_blocks.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tread {

namespace {

constexpr double kSize = 1.1e-3;  ///< size of elements [m]
constexpr double kRadius = 0.4;   ///< radius of revolved blocks' inner side [m]
constexpr double kShift = 0.02;   ///< displacement of shifted nodes, by element size [-]
constexpr int kColumns = 21;      ///< columns of quads: 21 x 19 make the 400 of a rail's section
constexpr int kRows = 19;
constexpr int kTieRatio = 3;

Material steel() {
  return {"steel", 205.9e9, 0.3, 7790, 0};
}

/// A grid of square quads. Its lowest line is the path "bottom", its highest "top".
Section grid_section(int columns, int rows, double size, double q) {
  Section section;
  for (int row = 0; row <= rows; ++row)
    for (int column = 0; column <= columns; ++column) {
      if (row == 0) section.paths["bottom"].push_back(section.nodes());
      if (row == rows) section.paths["top"].push_back(section.nodes());
      section.p.push_back(size * column);
      section.q.push_back(q + size * row);
    }
  const int stride = columns + 1;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const int node = row * stride + column;
      section.quads.push_back({node, node + 1, node + stride + 1, node + stride});
      section.quad_material.push_back(0);
    }
  return section;
}

int stations_for(std::int64_t elements, const Section& section) {
  return static_cast<int>(
      std::max<std::int64_t>(4, (elements + static_cast<std::int64_t>(section.quads.size()) / 2) /
                                    static_cast<std::int64_t>(section.quads.size())));
}

/// Calls visit(slot, smooth values between -1 and 1) for every node of a block.
template <class Visit>
void for_each_node(const SweptBlock& block, const Visit& visit) {
  for (int station = 0; station < block.station_count(); ++station)
    for (int node = 0; node < block.section.nodes(); ++node) {
      const double at = 0.37 * station + 0.59 * node;
      visit(block.slot(node, station), Vec3{std::sin(at), std::cos(1.3 * at), std::sin(0.7 * at + 1)});
    }
}

}  // namespace

Mesh made_up_mesh(Sweep sweep, bool shifted, std::int64_t elements) {
  const bool revolved = sweep == Sweep::revolved;
  Section section = grid_section(kColumns, kRows, kSize, revolved ? kRadius : 0.0);
  const int along = stations_for(elements, section);
  const double pitch = revolved ? 2 * std::numbers::pi / along : kSize;
  SweptBlock block =
      make_swept_block("made up", sweep, std::move(section), {steel()}, 0, {{along, pitch, 0}});
  if (shifted)
    for_each_node(block, [&](std::int64_t slot, const Vec3& value) {
      block.node_shift[slot] = kShift * kSize * value;
    });
  Mesh mesh;
  mesh.add(std::move(block));
  return mesh;
}

MadeUpTie made_up_tie(std::int64_t elements) {
  const double coarse = kTieRatio * kSize;
  Section above = grid_section(kColumns, kRows, kSize, 0);
  Section below = grid_section(kColumns / kTieRatio, kTieRatio, coarse, -kTieRatio * coarse);
  const int along = (stations_for(elements, above) + kTieRatio - 1) / kTieRatio;
  MadeUpTie blocks;
  blocks.tie.secondary = blocks.mesh.add(make_swept_block("fine", Sweep::extruded, std::move(above),
                                                          {steel()}, 0, {{kTieRatio * along, kSize, 0}}));
  blocks.tie.secondary_path = "bottom";
  blocks.tie.primary = blocks.mesh.add(
      make_swept_block("coarse", Sweep::extruded, std::move(below), {steel()}, 0, {{along, coarse, 0}}));
  blocks.tie.primary_path = "top";
  return blocks;
}

template <class Real>
AlignedVector<Real> made_up_field(const Mesh& mesh, double size) {
  AlignedVector<Real> field(static_cast<std::size_t>(3 * mesh.slots), 0);
  for (const SweptBlock& block : mesh.blocks)
    for_each_node(block, [&](std::int64_t slot, const Vec3& value) {
      for (int c = 0; c < 3; ++c)
        field[static_cast<std::size_t>(dof(block.base + slot, c))] = static_cast<Real>(size * value[c]);
    });
  return field;
}

template <class Real>
AlignedVector<Real> made_up_inverse_mass(const Mesh& mesh) {
  AlignedVector<Real> inverse_mass(static_cast<std::size_t>(mesh.slots), 0);
  for (const SweptBlock& block : mesh.blocks)
    for_each_node(block, [&](std::int64_t slot, const Vec3& /*value*/) {
      inverse_mass[static_cast<std::size_t>(block.base + slot)] = Real(1e5);
    });
  return inverse_mass;
}

template AlignedVector<double> made_up_field<double>(const Mesh& mesh, double size);
template AlignedVector<float> made_up_field<float>(const Mesh& mesh, double size);
template AlignedVector<double> made_up_inverse_mass<double>(const Mesh& mesh);
template AlignedVector<float> made_up_inverse_mass<float>(const Mesh& mesh);

}  // namespace tread
