// A march over a block on an emulated device.

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <set>
#include <span>

#include "core/error.hpp"
#include "kernels/blocks/internal_force.hpp"
#include "kernels/device/block_march.hpp"
#include "kernels/device/march_node.hpp"
#include "tests/swept_samples.hpp"

namespace tread {
namespace {

/// Mixed precision rounds displacements relative to a translation, which is turned from station to station.
TEST(March, ATranslationMakesNoForceInMixedPrecision) {
  const auto device = emulated_device({.cut = {64, 2, 1}});
  const auto copy = [&](const auto& values) {
    return DeviceArray<std::decay_t<decltype(values[0])>>(*device, std::span(values.data(), values.size()));
  };
  for (const SweptBlock& block :
       {samples::revolved_open(), samples::revolved_closed(), samples::extruded()}) {
    Mesh mesh;
    mesh.add(block);
    const BasicInternalForce<float, double> internal(mesh);
    BlockMarch<float> march(*device, internal.elements(0), 0, {});
    const auto nodes = static_cast<std::size_t>(mesh.slots);
    const auto u = copy(samples::sample(mesh, [](const Vec3&) { return Vec3{2e-3, 1e-3, -3e-3}; }));
    auto v = copy(AlignedVector<float>(3 * nodes, 0));
    const auto inverse_mass = copy(AlignedVector<float>(nodes, 1));
    const auto mark = copy(AlignedVector<int>(nodes / kLanes, kMoves));
    DeviceArray<double> moved_u(*device, 3 * nodes);
    MarchFields<float, double> fields;
    fields.u = u.data();
    fields.moved_u = moved_u.data();
    fields.v = fields.moved_v = v.data();
    fields.inverse_mass = inverse_mass.data();
    fields.group_mark = mark.data();
    StepLoads loads;
    loads.dt = 1;
    device->kernels<float, double>().march({.sweep = block.sweep}, march.at(loads), fields);
    device->wait();
    AlignedVector<float> force(3 * nodes);
    v.download(force.data());
    for (const float component : force) EXPECT_LT(std::abs(component), 1e-6) << block.name;
  }
}

/// The cut leaves the bits alone. [tests/equivalence/test_device.cpp]
TEST(March, PartsFitTheMemoryOfATeam) {
  Mesh mesh;
  mesh.add(make_swept_block("bar", Sweep::extruded, samples::grid_section({.columns = 23, .rows = 17}),
                            samples::materials(), 0, {{8, 0.01, 0}}));
  const InternalForce internal(mesh);
  StepLoads loads;
  loads.dt = 1;
  const auto block_of = [&](const Emulation& emulation) {
    const auto device = emulated_device(emulation);
    return BlockMarch<double>(*device, internal.elements(0), 0, {}).at(loads);
  };
  const MarchBlock<double> unbounded = block_of({});
  const std::size_t needed = room_bytes(unbounded, true, false);
  EXPECT_EQ(block_of({.team_bytes = needed}).parts, unbounded.parts);
  for (const std::size_t bytes : {needed - 1, needed / 2, needed / 4}) {
    const MarchBlock<double> block = block_of({.team_bytes = bytes});
    EXPECT_LE(room_bytes(block, true, false), bytes);
    EXPECT_GT(block.parts, unbounded.parts);
  }
}

/// All stretches of open blocks and of full turns, whose last run may be short.
TEST(March, RunsNearAStretchAreThoseOfItsTilesAndTheirNeighbours) {
  for (const int run_tiles : {1, 2, 3, 4})
    for (const int tiles : {3, 5, 6, 7, 9})
      for (const bool closed : {false, true}) {
        const auto device = emulated_device({.cut = {64, 20, run_tiles}});
        Mesh mesh;
        mesh.add(closed ? samples::revolved_closed(kLanes * tiles)
                        : make_swept_block("bar", Sweep::extruded, samples::grid_section({}),
                                           samples::materials(), 0, {{kLanes * (tiles - 1), 0.01, 0}}));
        ASSERT_EQ(std::ssize(mesh.blocks.front().tiles), tiles);
        const InternalForce internal(mesh);
        const BlockMarch<double> march(*device, internal.elements(0), 0, {});
        const int runs = (tiles + run_tiles - 1) / run_tiles;
        for (int first = 0; first < tiles; ++first)
          for (int count = 1; count <= (closed ? tiles : tiles - first); ++count) {
            std::set<int> expected;
            for (int tile = first - 1; tile <= first + count; ++tile)
              if (closed || (tile >= 0 && tile < tiles)) expected.insert((tile + tiles) % tiles / run_tiles);
            const MarchRuns near = march.near({first, count});
            std::set<int> found;
            for (int i = 0; i < near.count; ++i) found.insert((near.first + i) % runs);
            EXPECT_LE(near.count, runs);
            if (count + 2 < tiles) {
              EXPECT_EQ(found, expected) << first << " + " << count << " of " << tiles << " by " << run_tiles;
            } else {
              EXPECT_EQ(near.count, runs);
            }
          }
      }
}

/// Places in fields have 32 bits on a device.
TEST(March, FieldsOfTooManyValuesAreRefused) {
  const auto device = emulated_device();
  Mesh mesh;
  mesh.add(samples::extruded());
  mesh.blocks.front().base = std::int64_t{1} << 31;
  const InternalForce internal(mesh);
  EXPECT_THROW(BlockMarch<double>(*device, internal.elements(0), 0, {}), ResourceError);
}

}  // namespace
}  // namespace tread
