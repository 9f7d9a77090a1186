#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "core/parallel/parallel.hpp"
#include "kernels/blocks/internal_force.hpp"
#include "kernels/element/hexahedron.hpp"
#include "tests/field_differences.hpp"
#include "tests/swept_samples.hpp"

namespace tread {
namespace {

using samples::cartesian;
using samples::for_each_node;

std::size_t index(std::int64_t i) {
  return static_cast<std::size_t>(i);
}

/// The general elements of a block; nodes are numbered by slot relative to the block's base.
std::vector<GeneralForce::Element> general_elements(const SweptBlock& block, bool finite_rotation) {
  SweptBlock plain = block;
  plain.node_shift.clear();
  std::vector<GeneralForce::Element> elements;
  const int stations = block.station_count();
  for (int station = 0; station < (block.closed ? stations : stations - 1); ++station)
    for (int quad = 0; quad < static_cast<int>(block.section.quads.size()); ++quad) {
      GeneralForce::Element element;
      const Tile& tile = block.tiles[index(block.tile_of_station[index(station)])];
      for (int node = 0; node < 8; ++node) {
        const int at = node < 4 ? station : (station + 1) % stations;
        const int section_node = block.section.quads[index(quad)][index(node % 4)];
        element.node[index(node)] = static_cast<int>(block.slot(section_node, at));
        element.shape.nodes[index(node)] = position(block, section_node, at);
        element.shape.reference[index(node)] = position(plain, section_node, at);
      }
      element.shape.material = block.material(quad, tile.pitch_class);
      element.shape.finite_rotation = finite_rotation;
      elements.push_back(element);
    }
  return elements;
}

struct Case {
  const char* name;
  SweptBlock block;
};

std::vector<Case> cases() {
  std::vector<Case> list = {{"extruded", samples::extruded()},
                            {"revolved open", samples::revolved_open()},
                            {"revolved closed", samples::revolved_closed()},
                            {"revolved closed in one tile", samples::revolved_closed(7)},
                            {"revolved closed in full tiles", samples::revolved_closed(16)}};
  const std::size_t swept = list.size();
  for (std::size_t i = 0; i < swept; ++i) {
    list.push_back(list[i]);
    samples::shift_nodes(list.back().block, 1e-3);
  }
  list.push_back({"revolved closed, repeating shifts", samples::revolved_closed(48)});
  samples::shift_nodes(list.back().block, 1e-3);
  samples::repeat_shifts(list.back().block, 6);
  return list;
}

/// Random displacement of the given size [m] on top of a rotation by `angle` [rad].
AlignedVector<double> random_motion(const Mesh& mesh, double size, double angle) {
  auto u = samples::random_field(mesh);
  for (double& value : u) value *= size / samples::kRandomSize;
  const auto rotation = samples::sample(mesh, [&](const Vec3& x) { return samples::rotation(x, angle); });
  for (std::size_t i = 0; i < u.size(); ++i) u[i] += rotation[i];
  return u;
}

/// Nodal values of a block by slot; zero where a slot has no node.
std::vector<Vec3> cartesian_values(const SweptBlock& block, const AlignedVector<double>& u) {
  std::vector<Vec3> values(index(block.slots()));
  for (int station = 0; station < block.station_count(); ++station)
    for (int node = 0; node < block.section.nodes(); ++node) {
      const std::int64_t slot = block.slot(node, station);
      values[index(slot)] = cartesian(block, station, block.base + slot, u);
    }
  return values;
}

struct Motion {
  double size;   ///< size of the random part; elements measure 4 to 20 mm [m]
  double angle;  ///< angle of the rigid part [rad]
};
constexpr Motion kMotions[] = {{1e-6, 0}, {1e-5, 0}, {1e-3, 0}, {1e-5, 0.1}, {1e-4, 1}};

TEST(SweptEqualsGeneral, ForceOfARandomDisplacement) {
  for (const Case& c : cases()) {
    Mesh mesh;
    mesh.add(c.block);
    const SweptBlock& block = mesh.blocks[0];
    InternalForce force(mesh);
    for (const bool finite_rotation : {false, true}) {
      force.set_finite_rotation(0, finite_rotation);
      const GeneralForce general(general_elements(block, finite_rotation));
      for (const Motion& motion : kMotions) {
        const auto u = random_motion(mesh, motion.size, motion.angle);
        const auto expected = general.apply(cartesian_values(block, u));
        for (const char* set : InternalForce::instruction_sets()) {
          force.use_instruction_set(set);
          AlignedVector<double> f(u.size(), 1e300);
          force.internal_force(u.data(), nullptr, f.data());
          EXPECT_LT(samples::relative_difference(cartesian_values(block, f), expected), 1e-12)
              << c.name << " " << finite_rotation << " " << set << " " << motion.size << " " << motion.angle;
          if (finite_rotation) continue;
          AlignedVector<double> linear(u.size());
          force.set_finite_rotation(0, true);
          force.apply(u.data(), linear.data());
          force.set_finite_rotation(0, false);
          EXPECT_EQ(std::memcmp(f.data(), linear.data(), f.size() * sizeof(double)), 0) << c.name;
        }
      }
    }
  }
}

TEST(SweptEqualsGeneral, StressAtTheCentre) {
  for (const Case& c : cases()) {
    Mesh mesh;
    mesh.add(c.block);
    const SweptBlock& block = mesh.blocks[0];
    InternalForce force(mesh);
    for (const bool finite_rotation : {false, true}) {
      force.set_finite_rotation(0, finite_rotation);
      const auto u = random_motion(mesh, 1e-5, finite_rotation ? 0.1 : 0);
      const auto elements = general_elements(block, finite_rotation);
      const auto nodal = cartesian_values(block, u);
      const std::size_t quads = block.section.quads.size();
      for (std::size_t e = 0; e < elements.size(); ++e) {
        std::array<Vec3, 8> displacement;
        for (std::size_t node = 0; node < 8; ++node)
          displacement[node] = nodal[index(elements[e].node[node])];
        const auto expected = hexahedron_stress(elements[e].shape, displacement);
        const auto stress =
            force.stress(0, static_cast<int>(e % quads), static_cast<int>(e / quads), u.data());
        EXPECT_NEAR(von_mises(stress) / von_mises(expected), 1, 1e-11) << c.name;
        EXPECT_NEAR((stress[0] + stress[1] + stress[2]) / von_mises(expected),
                    (expected[0] + expected[1] + expected[2]) / von_mises(expected), 1e-11)
            << c.name;
      }
    }
  }
}

/// All samples as blocks of one mesh.
Mesh all_blocks() {
  Mesh mesh;
  for (const Case& c : cases()) mesh.add(c.block);
  return mesh;
}

TEST(InternalForceThreads, SameBitsForAnyNumber) {
  const Mesh mesh = all_blocks();
  InternalForce force(mesh);
  force.set_beta(1, 1e-7);
  force.set_beta(2, 1e-7);
  force.set_finite_rotation(2, true);
  force.set_finite_rotation(7, true);
  const auto u = samples::random_field(mesh);
  const auto v = samples::random_field(mesh, 4);
  AlignedVector<double> one(u.size());
  set_threads(1);
  force.internal_force(u.data(), v.data(), one.data());
  for (const int count : {2, 3, 5, 16}) {
    set_threads(count);
    AlignedVector<double> many(u.size(), 1e300);
    force.internal_force(u.data(), v.data(), many.data());
    EXPECT_EQ(std::memcmp(one.data(), many.data(), one.size() * sizeof(double)), 0) << count;
    AlignedVector<double> by_block(u.size(), 1e300);
    for (int block = 0; block < static_cast<int>(mesh.blocks.size()); ++block)
      force.internal_force(block, u.data(), v.data(), by_block.data());
    EXPECT_EQ(std::memcmp(one.data(), by_block.data(), one.size() * sizeof(double)), 0) << count;
  }
  set_threads(1);
}

TEST(InternalForceLanes, UnusedOnesStayZero) {
  const Mesh mesh = all_blocks();
  const InternalForce force(mesh);
  const auto u = samples::random_field(mesh);
  AlignedVector<double> f(u.size(), 1e300);
  force.apply(u.data(), f.data());
  AlignedVector<double> used(u.size(), 0);
  for_each_node(mesh, [&](const SweptBlock&, int, int, std::int64_t slot) {
    for (int i = 0; i < 3; ++i) used[index(dof(slot, i))] = 1;
  });
  int unused = 0;
  for (std::size_t i = 0; i < f.size(); ++i) {
    if (used[i] != 0) continue;
    ++unused;
    EXPECT_EQ(f[i], 0);
  }
  EXPECT_GT(unused, 0);
}

TEST(InternalForceShifts, AreStoredOnceWhereTilesRepeat) {
  const auto bytes = [](const SweptBlock& block) {
    Mesh mesh;
    mesh.add(block);
    return InternalForce(mesh).bytes();
  };
  SweptBlock ring = samples::revolved_closed(48);
  samples::shift_nodes(ring, 1e-3, 1);
  const std::int64_t all = bytes(ring);
  samples::repeat_shifts(ring, 6);
  // 48 stations in 6 tiles; 6 stations repeat after 3 of them.
  const auto shifts = static_cast<std::int64_t>(sizeof(LaneShifts<double>)) * ring.section.nodes();
  EXPECT_EQ(all - bytes(ring), 3 * shifts);
}

TEST(InternalForceDamping, ActsOnDisplacementPlusBetaVelocity) {
  const Mesh mesh = all_blocks();
  InternalForce force(mesh);
  const double beta = 0.25;
  force.set_beta(0, beta);
  force.set_beta(6, beta);
  force.set_finite_rotation(6, true);
  const auto u = samples::random_field(mesh);
  const auto v = samples::random_field(mesh, 4);
  auto sum = u;
  for (const int damped : {0, 6}) {
    const SweptBlock& block = mesh.blocks[index(damped)];
    for (std::int64_t i = 3 * block.base; i < 3 * (block.base + block.slots()); ++i)
      sum[index(i)] += beta * v[index(i)];
  }
  AlignedVector<double> expected(u.size());
  AlignedVector<double> f(u.size());
  force.internal_force(sum.data(), nullptr, expected.data());
  force.internal_force(u.data(), v.data(), f.data());
  EXPECT_LT(samples::relative_difference(f, expected), 1e-14);
}

TEST(InternalForceSingle, AgreesToItsPrecision) {
  const Mesh mesh = all_blocks();
  InternalForce force(mesh);
  BasicInternalForce<float> single(mesh);
  const auto u = samples::random_field(mesh);
  const AlignedVector<float> u_single(u.begin(), u.end());
  for (const bool finite_rotation : {false, true}) {
    for (int block = 0; block < static_cast<int>(mesh.blocks.size()); ++block) {
      force.set_finite_rotation(block, finite_rotation);
      single.set_finite_rotation(block, finite_rotation);
    }
    AlignedVector<double> f(u.size());
    force.internal_force(u.data(), nullptr, f.data());
    for (const char* set : InternalForce::instruction_sets()) {
      single.use_instruction_set(set);
      AlignedVector<float> f_single(u.size());
      single.internal_force(u_single.data(), nullptr, f_single.data());
      EXPECT_LT(samples::relative_difference(f_single, f), 2e-6) << set;
    }
  }
}

/// Expects, where nodes move vertically only, the force of the whole element along component 2 and nothing
/// else.
template <class Real, class U>
void expect_vertical_force_alone(double tolerance) {
  Mesh whole;
  whole.add(samples::extruded());
  SweptBlock shifted = samples::extruded();
  samples::shift_nodes(shifted, 1e-3);
  whole.add(shifted);
  Mesh vertical = whole;
  for (SweptBlock& block : vertical.blocks) block.vertical_only = true;

  const auto vertical_field = [&](unsigned seed) {
    auto field = samples::random_field(whole, seed);
    for_each_node(whole, [&](const SweptBlock&, int, int, std::int64_t slot) {
      field[index(dof(slot, 0))] = field[index(dof(slot, 1))] = 0;
    });
    return field;
  };
  const auto displacement = vertical_field(3);
  const auto velocity = vertical_field(4);
  const AlignedVector<U> u(displacement.begin(), displacement.end());
  const AlignedVector<Real> v(velocity.begin(), velocity.end());
  BasicInternalForce<Real, U> all(whole);
  BasicInternalForce<Real, U> one(vertical);
  for (const double beta : {0.0, 0.25})
    for (const char* set : InternalForce::instruction_sets()) {
      for (const int block : {0, 1}) {
        all.set_beta(block, beta);
        one.set_beta(block, beta);
      }
      all.use_instruction_set(set);
      one.use_instruction_set(set);
      AlignedVector<Real> expected(u.size());
      AlignedVector<Real> f(u.size(), Real(1e30));
      all.internal_force(u.data(), v.data(), expected.data());
      one.internal_force(u.data(), v.data(), f.data());
      Real largest = 0;
      for_each_node(whole, [&](const SweptBlock&, int, int, std::int64_t slot) {
        largest = std::max(largest, std::abs(expected[index(dof(slot, 2))]));
      });
      ASSERT_GT(largest, 0);
      for (std::int64_t slot = 0; slot < whole.slots; ++slot) {
        ASSERT_EQ(f[index(dof(slot, 0))], 0) << set;
        ASSERT_EQ(f[index(dof(slot, 1))], 0) << set;
        ASSERT_NEAR(f[index(dof(slot, 2))], expected[index(dof(slot, 2))], tolerance * largest) << set;
      }
    }
}

TEST(InternalForceVertical, IsThatOfTheThirdComponentAlone) {
  expect_vertical_force_alone<double, double>(1e-15);
  expect_vertical_force_alone<float, double>(5e-7);
  expect_vertical_force_alone<float, float>(5e-7);
}

TEST(InternalForceEnergy, IsHalfTheWorkOfLinearForces) {
  const Mesh mesh = all_blocks();
  const InternalForce force(mesh);
  const auto u = samples::random_field(mesh);
  AlignedVector<double> f(u.size());
  force.apply(u.data(), f.data());
  for (int block = 0; block < static_cast<int>(mesh.blocks.size()); ++block) {
    const SweptBlock& swept = mesh.blocks[index(block)];
    double work = 0;
    for (std::int64_t i = 3 * swept.base; i < 3 * (swept.base + swept.slots()); ++i)
      work += 0.5 * u[index(i)] * f[index(i)];
    const DeformationEnergy energy = force.energy(block, u.data());
    EXPECT_GT(energy.hourglass, 0);
    EXPECT_NEAR((energy.strain + energy.hourglass) / work, 1, 1e-12);
  }
}

TEST(InternalForceDiagonal, IsThatOfTheOperator) {
  Mesh mesh;
  SweptBlock open = samples::revolved_open();
  samples::shift_nodes(open, 1e-3, 0.02);
  mesh.add(open);
  mesh.add(samples::extruded());
  const InternalForce force(mesh);
  AlignedVector<double> diagonal(index(3 * mesh.slots));
  force.diagonal(diagonal.data());
  AlignedVector<double> u(diagonal.size(), 0);
  AlignedVector<double> f(diagonal.size());
  for (std::size_t i = 0; i < u.size(); i += 7) {
    if (diagonal[i] == 0) continue;
    u[i] = 1;
    force.apply(u.data(), f.data());
    u[i] = 0;
    ASSERT_NEAR(f[i] / diagonal[i], 1, 1e-12);
  }
}

}  // namespace
}  // namespace tread
