// The path of general hexahedra beside the swept one, and an exported scene that comes back through a file.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include "core/mesh/structured.hpp"
#include "core/parallel/parallel.hpp"
#include "drivers/results/frame_files.hpp"
#include "io/mesh/imported_mesh.hpp"
#include "kernels/blocks/internal_force.hpp"
#include "kernels/element/hexahedron.hpp"
#include "kernels/hexahedra/body_force.hpp"
#include "kernels/hexahedra/hex_force.hpp"
#include "tests/exported_deck.hpp"
#include "tests/field_differences.hpp"
#include "tests/measured.hpp"
#include "tests/swept_samples.hpp"

namespace tread {
namespace {

std::size_t index(std::int64_t i) {
  return static_cast<std::size_t>(i);
}

/// Blocks whose elements have the swept shape, small and with more elements than a chunk holds.
std::vector<SweptBlock> blocks() {
  std::vector<SweptBlock> list = {samples::extruded(), samples::revolved_open(), samples::revolved_closed(),
                                  samples::revolved_closed(7)};
  list.push_back(make_swept_block("long", Sweep::extruded,
                                  samples::grid_section({9, 7, 0, 0, 0.09, 0.07, 0.2}), samples::materials(),
                                  0, {{80, 0.01, 0}}));
  return list;
}

/// Rows of Cartesian values of a block's nodes, in the order of hexahedra_of.
std::vector<double> cartesian_values(const SweptBlock& block, const AlignedVector<double>& field) {
  std::vector<double> values;
  for (int station = 0; station < block.station_count(); ++station)
    for (int node = 0; node < block.section.nodes(); ++node) {
      const Vec3 at = samples::cartesian(block, station, block.base + block.slot(node, station), field);
      values.insert(values.end(), {at.x, at.y, at.z, 0.0});
    }
  return values;
}

/// A swept block, and the same elements one by one.
struct BothPaths {
  explicit BothPaths(const SweptBlock& block) {
    mesh.add(block);
    hexahedra = hexahedra_of(mesh.blocks[0]);
    swept.emplace(mesh);
    general.emplace(hexahedra, block.materials);
  }
  const SweptBlock& block() const { return mesh.blocks[0]; }

  Mesh mesh;
  HexMesh hexahedra;
  std::optional<InternalForce> swept;
  std::optional<HexForce> general;
};

TEST(Hexahedra, ForceIsThatOfTheSweptPath) {
  for (const SweptBlock& block : blocks()) {
    BothPaths paths(block);
    for (const auto& [size, radians] : {std::pair(1e-5, 0.0), {1e-5, 0.1}, {1e-4, 1.0}}) {
      const double angle = radians;
      auto u = samples::random_field(paths.mesh);
      for (double& value : u) value *= size / samples::kRandomSize;
      const auto turned =
          samples::sample(paths.mesh, [&](const Vec3& x) { return samples::rotation(x, angle); });
      for (std::size_t i = 0; i < u.size(); ++i) u[i] += turned[i];
      const auto v = samples::random_field(paths.mesh, 4);
      for (const bool finite_rotation : {false, true})
        for (const double beta : {0.0, 0.25}) {
          paths.swept->set_finite_rotation(0, finite_rotation);
          paths.general->set_finite_rotation(finite_rotation);
          paths.swept->set_beta(0, beta);
          paths.general->set_damping(beta);
          AlignedVector<double> expected(u.size());
          paths.swept->internal_force(u.data(), v.data(), expected.data());
          const std::vector<double> at = cartesian_values(paths.block(), u);
          const std::vector<double> speed = cartesian_values(paths.block(), v);
          for (const char* set : HexForce::instruction_sets()) {
            paths.general->use_instruction_set(set);
            std::vector<double> f(at.size(), 1e300);
            paths.general->internal_force(at.data(), speed.data(), f.data());
            EXPECT_LT(samples::relative_difference(f, cartesian_values(paths.block(), expected)), 1e-12)
                << block.name << " " << angle << " " << finite_rotation << " " << set;
          }
        }
    }
  }
}

TEST(Hexahedra, EnergyMassDiagonalAndFrequencyAreThoseOfTheSweptPath) {
  for (const SweptBlock& block : blocks()) {
    const BothPaths paths(block);
    const auto u = samples::random_field(paths.mesh);
    const std::vector<double> at = cartesian_values(paths.block(), u);
    const DeformationEnergy expected = paths.swept->energy(0, u.data());
    const DeformationEnergy energy = paths.general->energy(at.data());
    EXPECT_NEAR(energy.strain / expected.strain, 1, 1e-12) << block.name;
    EXPECT_NEAR(energy.hourglass / expected.hourglass, 1, 1e-12) << block.name;

    std::vector<double> mass(index(paths.mesh.slots), 0.0);
    paths.swept->lumped_mass(mass.data());
    const std::vector<double> general_mass = paths.general->lumped_mass();
    for (int station = 0; station < block.station_count(); ++station)
      for (int node = 0; node < block.section.nodes(); ++node) {
        const double swept_mass = mass[index(paths.block().slot(node, station))];
        ASSERT_NEAR(general_mass[index(station * block.section.nodes() + node)] / swept_mass, 1, 1e-13);
      }
    EXPECT_NEAR(paths.general->max_frequency().omega / paths.swept->max_frequency(0).omega, 1, 1e-10)
        << block.name;

    const std::vector<double> diagonal = paths.general->diagonal();
    std::vector<double> unit(at.size(), 0.0), f(at.size());
    for (std::size_t i = 0; i < unit.size(); i += 97) {
      if (i % kHexNodeValues == 3) continue;
      unit[i] = 1;
      paths.general->apply(unit.data(), f.data());
      unit[i] = 0;
      ASSERT_NEAR(f[i] / diagonal[i], 1, 1e-12) << block.name;
    }
  }
}

/// Lists the corners of some elements from another face on, as meshers do.
void turn_numbering(HexMesh& mesh) {
  constexpr std::array<std::array<std::size_t, 8>, 3> kTurns = {
      {{1, 2, 3, 0, 5, 6, 7, 4}, {0, 4, 5, 1, 3, 7, 6, 2}, {3, 7, 4, 0, 2, 6, 5, 1}}};
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    if (e % 4 == 3) continue;
    const HexCorners before = mesh.elements[e];
    for (std::size_t k = 0; k < 8; ++k) mesh.elements[e][k] = before[kTurns[e % 4][k]];
    ASSERT_GT(hex_shape(mesh.corners(e)).smallest_jacobian, 0) << e;
  }
}

/// Elements that no sweep makes: every node is moved.
TEST(Hexahedra, ForceOfDistortedElementsIsThatOfTheOracle) {
  HexMesh mesh = hexahedra_of(samples::extruded());
  turn_numbering(mesh);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> shift(-5e-4, 5e-4), motion(-1e-5, 1e-5);
  for (Vec3& node : mesh.nodes)
    for (int i = 0; i < 3; ++i) node[i] += shift(random);
  HexForce general(mesh, samples::materials());
  std::vector<double> u(kHexNodeValues * mesh.nodes.size());
  for (std::size_t i = 0; i < u.size(); ++i) u[i] = i % kHexNodeValues == 3 ? 0.0 : motion(random);
  for (const bool finite_rotation : {false, true}) {
    std::vector<GeneralForce::Element> elements;
    for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
      const auto corners = mesh.corners(e);
      GeneralForce::Element element{
          {}, {corners, corners, samples::materials()[index(mesh.part[e])], finite_rotation}};
      std::copy_n(mesh.elements[e].begin(), 8, element.node.begin());
      elements.push_back(element);
    }
    std::vector<Vec3> at(mesh.nodes.size());
    for (std::size_t n = 0; n < at.size(); ++n) at[n] = {u[4 * n], u[4 * n + 1], u[4 * n + 2]};
    std::vector<double> expected;
    for (const Vec3& force : GeneralForce(elements).apply(at))
      expected.insert(expected.end(), {force.x, force.y, force.z, 0.0});
    general.set_finite_rotation(finite_rotation);
    for (const char* set : HexForce::instruction_sets()) {
      general.use_instruction_set(set);
      std::vector<double> f(u.size());
      general.internal_force(u.data(), nullptr, f.data());
      EXPECT_LT(samples::relative_difference(f, expected), 1e-12) << set;
    }
  }
}

/// Two bricks and an element whose corner between them is nearly flat, in a plane field u_x(x, y).
double change_beside_a_flat_corner(double flatness, const std::function<double(double, double)>& field) {
  constexpr double h = 10e-3;
  const std::vector<std::array<double, 2>> plane = {
      {0, 0}, {-h, 0}, {-h, h}, {0, h}, {-h, -h}, {0, -h}, {flatness * h, -0.5 * h}, {h, 0.7 * h}};
  HexBody body;
  for (const double z : {0.0, h})
    for (const auto& [x, y] : plane) body.mesh.nodes.push_back({x, y, z});
  for (const auto& quad : std::vector<std::array<int, 4>>{{1, 0, 3, 2}, {4, 5, 0, 1}, {0, 6, 7, 3}}) {
    HexCorners& corners = body.mesh.elements.emplace_back();
    for (std::size_t k = 0; k < 4; ++k) {
      corners[k] = quad[k];
      corners[k + 4] = quad[k] + static_cast<int>(plane.size());
    }
  }
  std::vector<double> values(index(3 * body.slots()), 0.0);
  for (std::size_t node = 0; node < body.mesh.nodes.size(); ++node)
    values[index(dof(body.slot(static_cast<std::int64_t>(node)), 0))] =
        field(body.mesh.nodes[node].x, body.mesh.nodes[node].y);
  return along_motion(body, values.data()).front().x;
}

TEST(AlongMotion, AFlatCornerCountsForLittle) {
  const auto linear = [](double x, double y) { return 1e-3 * x + 2e-3 * y; };
  const auto bent = [](double x, double y) { return 1e-3 * x + 0.05 * y * y; };
  for (const double flatness : {0.1, 0.01}) {
    EXPECT_NEAR(change_beside_a_flat_corner(flatness, linear), 1e-3, 1e-12) << flatness;
    const double change = change_beside_a_flat_corner(flatness, bent);
    measured(fmt::format("flatness {}: change / exact - 1", flatness), change / 1e-3 - 1);
    EXPECT_NEAR(change, 1e-3, 0.4e-3) << flatness;
  }
}

TEST(AlongMotion, IsExactForAParabolaOnBricksOfTwoLengths) {
  const auto parabola = [](double x) { return 0.3 * x + 2 * x * x; };
  HexBody body;
  body.mesh = hexahedra_of(make_swept_block("bricks", Sweep::extruded, rectangle(0, 0.02, 2, 0, 0.01, 1),
                                            samples::materials(), 0, {{1, 0.01, 0}, {1, 0.025, 0}}));
  std::vector<double> values(index(3 * body.slots()), 0.0);
  for (std::size_t node = 0; node < body.mesh.nodes.size(); ++node)
    values[index(dof(body.slot(static_cast<std::int64_t>(node)), 0))] = parabola(body.mesh.nodes[node].x);
  const std::vector<Vec3> change = along_motion(body, values.data());
  int between = 0;
  for (std::size_t node = 0; node < change.size(); ++node) {
    if (std::abs(body.mesh.nodes[node].x - 0.01) > 1e-6) continue;
    ++between;
    EXPECT_NEAR(change[node].x, 0.3 + 4 * 0.01, 1e-12);
  }
  EXPECT_EQ(between, 6);
}

/// Rows of a mesh. Each element stands in a row or in the rest, once, and between nodes of its own.
std::vector<ElementRow> checked_rows(const HexMesh& mesh) {
  std::vector<std::int32_t> all(mesh.elements.size()), rest;
  std::iota(all.begin(), all.end(), 0);
  std::vector<ElementRow> rows = find_rows(mesh, all, rest);
  std::vector<std::int32_t> found = rest;
  for (const ElementRow& row : rows)
    for (std::size_t i = 0; i < 8; ++i) {
      found.push_back(row.element[i]);
      EXPECT_EQ(mesh.part[index(row.element[i])], mesh.part[index(row.element[0])]);
      HexCorners corners;
      for (std::size_t k = 0; k < 8; ++k) corners[k] = row.line[k % 4][i + k / 4];
      HexCorners stated = mesh.elements[index(row.element[i])];
      std::array<Vec3, 8> at;
      for (std::size_t k = 0; k < 8; ++k) at[k] = mesh.nodes[index(corners[k])];
      EXPECT_GT(hex_shape(at).smallest_jacobian, 0);
      std::sort(corners.begin(), corners.end());
      std::sort(stated.begin(), stated.end());
      EXPECT_EQ(corners, stated);
    }
  std::sort(found.begin(), found.end());
  EXPECT_EQ(found, all);
  return rows;
}

TEST(Hexahedra, RowsHoldElementsThatShareFaces) {
  HexMesh mesh = hexahedra_of(samples::extruded());
  turn_numbering(mesh);
  EXPECT_GT(checked_rows(mesh).size(), 4U);
}

/// A single line of elements: a tail, an element, a loop about a hole, the same element crosswise, a tail.
/// `length`: elements of the loop and of either tail.
HexMesh curled_line(int length) {
  using Edge = std::array<std::int32_t, 2>;
  HexMesh mesh;
  mesh.parts = {"curl"};
  const auto node = [&](double x, double y) {  // and the node above it
    mesh.nodes.insert(mesh.nodes.end(), {Vec3{x, y, 0}, Vec3{x, y, 1}});
    return static_cast<std::int32_t>(mesh.nodes.size()) - 2;
  };
  const auto join = [&](const std::vector<Edge>& edges) {
    for (std::size_t i = 1; i < edges.size(); ++i) {
      const auto [a, b] = edges[i - 1];
      const auto [d, c] = edges[i];
      mesh.elements.push_back({a, b, c, d, a + 1, b + 1, c + 1, d + 1});
      mesh.part.push_back(0);
    }
  };
  const auto tail = [&](const Edge& root, double side) {
    std::vector<Edge> edges = {root};
    for (int i = 1; i <= length; ++i) {
      Edge& edge = edges.emplace_back();
      for (std::size_t k = 0; k < 2; ++k)
        edge[k] = node(mesh.nodes[index(root[k])].x + 0.7 * i, mesh.nodes[index(root[k])].y + 0.8 * side * i);
    }
    return edges;
  };
  std::vector<Edge> loop;
  for (int i = 0; i <= length; ++i) {
    const double inner = 2 * std::numbers::pi * i / length;
    const double outer = 0.4 + (2 * std::numbers::pi - 0.8) * i / length;
    loop.push_back({i < length ? node(std::cos(inner), std::sin(inner)) : loop[0][0],
                    node(2 * std::cos(outer), 2 * std::sin(outer))});
  }
  const std::int32_t tip = node(2.7, 0);
  std::vector<Edge> line = tail({loop.back()[1], tip}, -1);
  std::reverse(line.begin(), line.end());
  line.insert(line.end(), loop.begin(), loop.end());
  join(line);
  join(tail({loop.front()[1], tip}, 1));
  return mesh;
}

TEST(Hexahedra, RowsOfALineThatCrossesItselfHoldAnElementOnce) {
  // The element where the line crosses itself comes twice within eight, or in two eights.
  for (const int length : {3, 7}) checked_rows(curled_line(length));
}

TEST(Hexahedra, SameBitsForAnyNumberOfThreads) {
  const SweptBlock block = blocks().back();
  BothPaths paths(block);
  paths.general->set_finite_rotation(true);
  const std::vector<double> u = cartesian_values(paths.block(), samples::random_field(paths.mesh));
  set_threads(1);
  std::vector<double> one(u.size());
  paths.general->internal_force(u.data(), nullptr, one.data());
  const double energy = paths.general->energy(u.data()).strain;
  for (const int count : {2, 3, 5, 16}) {
    set_threads(count);
    std::vector<double> many(u.size(), 1e300);
    paths.general->internal_force(u.data(), nullptr, many.data());
    EXPECT_EQ(std::memcmp(one.data(), many.data(), one.size() * sizeof(double)), 0) << count;
    EXPECT_EQ(paths.general->energy(u.data()).strain, energy) << count;
  }
  set_threads(1);
}

/// A scene through `tread export` and the reader: places and elements are those of the model within the
/// deck's digits, and so are the forces on its nodes.
void expect_same_scene(const Scene& scene, int pieces) {
  const Model model(scene);
  std::string text;
  KeywordDeck deck([&](std::string_view piece) { text += piece; });
  write_keyword_deck(model, {}, "test", deck);
  MeshFaults faults;
  const ImportedMesh imported = mesh_of(text, "scene.k", {1e-3, {}, pieces}, faults);
  for (const LineFault& fault : faults.list()) ADD_FAILURE() << fault.line << ": " << fault.message;
  const HexMesh& mesh = imported.mesh;

  const double step = 1e-6;  // no matter here
  const DeckModel numbered(model, {}, step);
  const VtkGrid& grid = numbered.grid();
  ASSERT_EQ(mesh.nodes.size(), grid.points.size());
  ASSERT_EQ(8 * mesh.elements.size(), grid.connectivity.size());
  std::vector<Vec3> places;
  for (const VtkGrid::Point& point : grid.points) places.push_back(numbered.place(point));
  EXPECT_LT(samples::difference(mesh.nodes, places),
            8.7e-14);  // 15 characters of some hundred millimetres: half of 1e-10 mm along each axis
  for (std::size_t i = 0; i < grid.connectivity.size(); ++i)
    ASSERT_EQ(mesh.elements[i / 8][i % 8], grid.connectivity[i]);

  std::vector<Material> materials;
  for (const std::string& part : mesh.parts)
    materials.push_back(scene.material(part.substr(part.find(", ") + 2)));
  const HexForce general(mesh, materials);
  const auto u = samples::random_field(model.mesh);
  AlignedVector<double> expected(u.size());
  model.internal->apply(u.data(), expected.data());
  std::vector<double> at, swept;
  for (const VtkGrid::Point& point : grid.points) {
    const SweptBlock& block = model.mesh.blocks[index(point.block)];
    const Vec3 here = samples::cartesian(block, point.station, numbered.slot(point), u);
    const Vec3 force = samples::cartesian(block, point.station, numbered.slot(point), expected);
    at.insert(at.end(), {here.x, here.y, here.z, 0.0});
    swept.insert(swept.end(), {force.x, force.y, force.z, 0.0});
  }
  std::vector<double> f(at.size());
  general.apply(at.data(), f.data());
  // Half a unit of the deck's fifteenth digit in places of 0.5 m, over edges of 9 mm.
  EXPECT_LT(samples::relative_difference(f, swept), 1e-11);
}

TEST(ImportedScene, HasTheForcesOfTheExportedTyre) {
  expect_same_scene(samples::tyre(), 2);
}

TEST(ImportedScene, HasTheForcesOfTheExportedBar) {
  expect_same_scene(samples::bar(), 1);
}

}  // namespace
}  // namespace tread
