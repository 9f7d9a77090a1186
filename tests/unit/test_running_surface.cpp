// Depths of running surfaces: slopes against differences, wheels that return after a turn, room of the
// search.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "core/running_surface.hpp"
#include "drivers/engine/model/surfaces.hpp"

namespace tread {
namespace {

constexpr double kRadius = 0.43;

std::vector<double> some_x() {
  return {-0.02, -0.008, 0, 0.005, 0.03};
}

DepthShapePointer some_map() {
  std::vector<double> depth;
  for (const double y : {-0.01, 0.002, 0.02})
    for (const double x : some_x()) depth.push_back(1e-4 * std::sin(80 * x) * (1 + 30 * y));
  return measured_map(some_x(), {-0.01, 0.002, 0.02}, depth, 1e-3);
}

std::vector<DepthShapePointer> all_shapes() {
  return {dip(1e-3, 0.08, false),
          dip(-2e-4, 0.08, true),
          dent(1e-4, 0.05, 0.03, 2e-3),
          waves(1e-4, 0.02, 3),
          waves(-2e-5, 0.013, 2),
          chord_flat(0.05, kRadius),
          measured_profile(some_x(), {1e-4, 0, -2e-5, 3e-5, 5e-5}),
          some_map()};
}

TEST(RunningSurface, SlopesAreThoseOfTheDepths) {
  constexpr double kStep = 1e-7;
  for (const DepthShapePointer& shape : all_shapes())
    for (double x = -0.0451; x < 0.07; x += 0.00317)
      for (const double y : {-0.0113, 0.0007, 0.0097}) {
        const SurfaceDepth here = shape->at(x, y);
        const double along = (shape->at(x + kStep, y).depth - shape->at(x - kStep, y).depth) / (2 * kStep);
        const double across = (shape->at(x, y + kStep).depth - shape->at(x, y - kStep).depth) / (2 * kStep);
        EXPECT_NEAR(here.along, along, 2e-6) << x << " " << y;
        EXPECT_NEAR(here.across, across, 2e-6) << x << " " << y;
        EXPECT_LE(here.depth, shape->bounds().deepest + 1e-12);
        EXPECT_GE(here.depth, -shape->bounds().highest - 1e-12);
        EXPECT_LE(std::abs(here.along), shape->bounds().steepest * (1 + 1e-9));
      }
}

TEST(RunningSurface, ChordIsStraight) {
  const DepthShapePointer flat = chord_flat(0.06, kRadius);
  EXPECT_NEAR(flat->bounds().deepest, kRadius - std::sqrt(kRadius * kRadius - 0.03 * 0.03), 1e-15);
  for (const double x : {0.0, 0.004, -0.021, 0.0299}) {
    const double radius = kRadius - flat->at(x, 0).depth;
    EXPECT_NEAR(radius * std::cos(x / kRadius), kRadius - flat->bounds().deepest, 1e-15);
  }
}

TEST(RunningSurface, WheelReturnsAfterATurn) {
  RunningSurface wheel(kRadius);
  wheel.add(dip(1e-3, 0.1, false), 0.7);
  wheel.add(waves(1e-5, 2 * std::numbers::pi * kRadius / 7, 7), 0.1);
  const double turn = 2 * std::numbers::pi * kRadius;
  for (double x = -1; x < 2; x += 0.0317) {
    EXPECT_NEAR(wheel.at(x, 0).depth, wheel.at(x + 3 * turn, 0).depth, 1e-15);
    EXPECT_NEAR(wheel.at(x, 0).depth, wheel.view().around(-x / kRadius, 0).depth, 1e-15);
  }
  EXPECT_NEAR(wheel.at(0.7, 0).depth, 1e-3 + wheel.at(0.7 - turn / 7, 0).depth, 1e-15);
}

TEST(RunningSurface, DepthsAreSummed) {
  RunningSurface rail;
  EXPECT_TRUE(rail.smooth());
  rail.add(dip(1e-3, 0.1, false), 1);
  rail.add(dent(1e-4, 0.05, 0.03, 0), 1.01);
  EXPECT_NEAR(rail.at(1.02, 0.003).depth,
              dip(1e-3, 0.1, false)->at(0.02, 0).depth + dent(1e-4, 0.05, 0.03, 0)->at(0.01, 0.003).depth,
              1e-15);
}

TEST(RunningSurface, RoomIsWhatAWheelFindsWithinReach) {
  // A long slope of 1/1000 needs little room although it leads down by a metre; a dent needs its depth.
  RunningSurface slope;
  slope.add(measured_profile({0, 1000}, {0, 1}), 0);
  EXPECT_LT(slope.room(kRadius, 4e-4), 1e-4);
  RunningSurface hole;
  hole.add(dent(2e-4, 0.01, 0.01, 0), 0);
  EXPECT_DOUBLE_EQ(hole.room(kRadius, 4e-4), 2e-4);
}

TEST(RunningSurface, MeasuredWheelIsClosed) {
  Scene scene;
  scene.wheel.emplace();
  SurfaceSpec& measured = scene.surfaces["out_of_round"];
  measured.kind = "profile";
  measured.on = "wheel";
  measured.file_x = {0, 1, 2};
  measured.file_depth = {1e-5, 3e-5, -2e-5};
  const RunningSurface wheel = wheel_surface(scene);
  const double turn = std::numbers::pi * scene.wheel->diameter;
  EXPECT_NEAR(wheel.at(1, 0).depth, 3e-5, 1e-15);
  EXPECT_NEAR(wheel.at(turn, 0).depth, 1e-5, 1e-15);
  for (double x = 2; x < turn; x += 0.01) {
    EXPECT_GE(wheel.at(x, 0).depth, -2e-5);
    EXPECT_LE(std::abs(wheel.at(x + 1e-3, 0).depth - wheel.at(x, 0).depth), 1e-7);
  }
}

}  // namespace
}  // namespace tread
