// Averages at the nodes of the rail's surface keep what the points carry: force, work, area.

#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <vector>

#include "kernels/contact/patch_nodes.hpp"

namespace tread {
namespace {

/// Uneven cells: six stations, four rows.
SurfaceGrid uneven_grid() {
  SurfaceGrid grid;
  grid.first_edge = 3;
  grid.x = {0, 1e-3, 2.5e-3, 3e-3, 5e-3, 6e-3};
  grid.y = {-2e-3, -1e-3, 0.5e-3, 2e-3};
  grid.length = {0.5e-3, 1.25e-3, 1e-3, 1.25e-3, 1.5e-3, 0.5e-3};
  grid.width = {0.5e-3, 1.25e-3, 1.5e-3, 0.75e-3};
  grid.quad = {0, 1, 2};
  return grid;
}

/// Points anywhere on the faces between stations 1 and 4, some without pressure.
std::vector<ContactPoint> scattered_points() {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<ContactPoint> points(40);
  for (std::size_t i = 0; i < points.size(); ++i) {
    ContactPoint& point = points[i];
    point = ContactPoint{};
    point.face = {1 + static_cast<int>(i % 3), 3 + static_cast<int>(i % 2)};
    const double along = unit(random);
    const double across = unit(random);
    point.face_share = {(1 - along) * (1 - across), (1 - along) * across, along * (1 - across),
                        along * across};
    point.area = 1e-7 * (1 + unit(random));
    point.frictional_work = unit(random);
    point.pressure = i % 5 == 0 ? 0 : 1e9 * unit(random);
    if (point.pressure <= 0) continue;
    point.shear = {2e8 * (unit(random) - 0.5), 1e8 * (unit(random) - 0.5)};
    point.slips = i % 2 == 0;
  }
  return points;
}

TEST(PatchNodes, KeepForceWorkAndArea) {
  constexpr int kFirst = 1;
  constexpr int kLast = 4;
  const std::vector<ContactPoint> points = scattered_points();
  double normal = 0, along = 0, across = 0, work = 0, area = 0, slipping = 0;
  for (const ContactPoint& point : points) {
    work += point.area * point.frictional_work;
    if (point.pressure <= 0) continue;
    normal += point.area * point.pressure;
    along += point.area * point.shear.along;
    across += point.area * point.shear.across;
    area += point.area;
    if (point.slips) slipping += point.area;
  }
  PatchNodes nodes(uneven_grid(), kLast - kFirst + 2);
  nodes.average(kFirst, kLast, points);
  for (int station = kFirst; station <= kLast; ++station)
    for (int row = 0; row < nodes.grid().rows(); ++row) {
      const NodalContact& node = nodes.at(station, row);
      const double cell = nodes.grid().area(station, row);
      normal -= cell * node.pressure;
      along -= cell * node.shear.along;
      across -= cell * node.shear.across;
      work -= cell * node.frictional_work;
      area -= cell * node.touching;
      slipping -= cell * node.slipping;
    }
  EXPECT_NEAR(normal, 0, 1e-9);  // of kilonewtons
  EXPECT_NEAR(along, 0, 1e-10);
  EXPECT_NEAR(across, 0, 1e-10);
  EXPECT_NEAR(work, 0, 1e-18);
  EXPECT_NEAR(area, 0, 1e-18);
  EXPECT_NEAR(slipping, 0, 1e-18);
}

TEST(PatchNodes, SlipSpeedIsTheMeanOfWhatTouches) {
  std::vector<ContactPoint> points = scattered_points();
  for (ContactPoint& point : points) {
    point.slip_speed = {0.3, -0.1};
    if (point.pressure <= 0) point.slip_speed = {50, 50};
  }
  PatchNodes nodes(uneven_grid(), 5);
  nodes.average(1, 4, points);
  for (int station = 1; station <= 4; ++station)
    for (int row = 0; row < 3; ++row) {
      ASSERT_GT(nodes.at(station, row).touching, 0);
      EXPECT_NEAR(nodes.at(station, row).slip_speed.along, 0.3, 1e-14);
      EXPECT_NEAR(nodes.at(station, row).slip_speed.across, -0.1, 1e-14);
    }
}

}  // namespace
}  // namespace tread
