// Stations of rail and wheel: no element much shorter than its neighbours, wherever run and zone end.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "drivers/engine/model/model.hpp"
#include "drivers/engine/model/station_plan.hpp"
#include "tests/tyre_scene.hpp"

namespace tread {
namespace {

double shortest(const std::vector<Segment>& segments) {
  double least = 1e30;
  for (const Segment& s : segments) least = std::min(least, s.pitch);
  return least;
}

TEST(StationPlan, HasNoSliverWhereverTheRunEnds) {
  const MeshSizes sizes{2.2e-3, 45e-3, 10e-3, 65e-3, 2, 4, 4, 14e-3};
  const Span zone{0.1, 0.4};
  for (double end = 0.02; end < 0.6; end += 0.37e-3) {
    const Span run{-0.04, end};
    EXPECT_GE(shortest(plan_rail({-0.5, 1}, run, {zone}, sizes).fine), 0.45 * sizes.contact) << end;
    EXPECT_GE(0.43 * shortest(plan_tyre_part(0.43, run, {zone}, 0.05, sizes).tread), 0.45 * sizes.contact)
        << end;
  }
}

TEST(StationPlan, HasNoSliverAtTheEndsOfABodyAndAroundATyre) {
  const MeshSizes sizes{2.2e-3, 45e-3, 10e-3, 65e-3, 2, 4, 4, 14e-3};
  const Span zone{0.1, 0.4};
  const Span run{-0.0427, 0.5};
  for (double beyond = 0; beyond < 0.03; beyond += 0.13e-3) {
    const Span rail{run.first - beyond, run.last + beyond};
    EXPECT_GE(shortest(plan_rail(rail, run, {zone}, sizes).fine), 0.45 * sizes.contact) << beyond;
    EXPECT_GE(0.43 * shortest(plan_tyre_part(0.43, run, {zone}, 0.04 + beyond, sizes).tread),
              0.45 * sizes.contact)
        << beyond;
  }
  for (double way = 0.05; way < 3; way += 0.83e-3)
    EXPECT_GE(0.43 * shortest(plan_tyre(0.43, {-0.0427, way}, {{0.0, way - 0.0427}}, sizes).tread),
              0.45 * sizes.contact)
        << way;
}

/// Largest pitch that meets [first, last] of the stations from `start` on.
double largest_pitch(double start, const std::vector<Segment>& segments, double first, double last) {
  double largest = 0;
  double at = start;
  for (const Segment& s : segments) {
    const double end = at + s.elements * s.pitch;
    if (at < last - 1e-9 && end > first + 1e-9) largest = std::max(largest, s.pitch);
    at = end;
  }
  return largest;
}

double length_of(const std::vector<Segment>& segments) {
  double sum = 0;
  for (const Segment& s : segments) sum += s.elements * s.pitch;
  return sum;
}

/// Rail and wheel are fine where they meet in every zone, coarser between, and nest.
TEST(StationPlan, IsFineInEveryZone) {
  constexpr double kRadius = 0.43;
  constexpr double kTurn = 2 * std::numbers::pi;
  const Span rail{-1, 12};
  const Span run{-0.04, 9};
  for (const MeshSizes& sizes : {MeshSizes{2.2e-3, 45e-3, 10e-3, 65e-3, 2, 4, 4, 14e-3},
                                 MeshSizes{1.1e-3, 25e-3, 8e-3, 40e-3, 3, 6, 4, 16e-3}})
    for (const double other : {0.2, 1.05, 1.31, 4.0, 8.93}) {
      SCOPED_TRACE(other);
      std::vector<Span> zones = {{0.6, 1}, {other, other + 0.13}};
      if (zones[1].first < zones[0].first) std::swap(zones[0], zones[1]);
      const NestedSegments plan = plan_rail(rail, run, zones, sizes);
      EXPECT_NEAR(length_of(plan.fine), 13, 1e-9);
      EXPECT_NEAR(length_of(plan.coarse), 13, 1e-9);
      EXPECT_GE(shortest(plan.fine), 0.45 * sizes.contact);
      const WheelPlan wheel = plan_wheel(kRadius, zones, sizes);
      EXPECT_NEAR(length_of(wheel.tread), kTurn, 1e-9);
      EXPECT_NEAR(length_of(wheel.disc), kTurn, 1e-9);
      for (const Span& zone : zones) {
        const double end = std::min(zone.last, run.last);
        EXPECT_LE(largest_pitch(rail.first, plan.fine, zone.first, end), 1.001 * sizes.contact);
        // x meets the wheel at the angle -x / R, which returns after a turn.
        const double from = std::fmod(-end / kRadius - wheel.start + 40 * kTurn, kTurn);
        const double to = from + (end - zone.first) / kRadius;
        double largest = largest_pitch(0, wheel.tread, from, std::min(to, kTurn));
        if (to > kTurn) largest = std::max(largest, largest_pitch(0, wheel.tread, 0, to - kTurn));
        EXPECT_LE(kRadius * largest, 1.01 * sizes.contact);
      }
      EXPECT_GT(largest_pitch(rail.first, plan.fine, 2, 3), 1.5 * sizes.contact);
    }
}

/// The rail has the approach pitch within the margin of a zone and twice it beyond, in head and base.
TEST(StationPlan, IsCoarseBeyondTheMargin) {
  const Span rail{-1, 12};
  const Span run{-0.04, 9};
  const Span zone{5, 5.2};
  for (MeshSizes sizes : {MeshSizes{2.2e-3, 45e-3, 10e-3, 65e-3, 2, 4, 4, 14e-3},
                          MeshSizes{1.1e-3, 25e-3, 8e-3, 40e-3, 3, 6, 4, 16e-3}})
    for (const double margin : {0.05, 0.3, 0.7, 4.0}) {
      SCOPED_TRACE(margin);
      sizes.margin = margin;
      const double approach = 1.01 * sizes.contact * sizes.approach_ratio;
      const double coarse = sizes.contact * sizes.coarse_ratio;
      const NestedSegments plan = plan_rail(rail, run, {zone}, sizes);
      EXPECT_NEAR(length_of(plan.fine), 13, 1e-9);
      EXPECT_NEAR(length_of(plan.coarse), 13, 1e-9);
      for (std::size_t i = 0; i < plan.fine.size(); ++i)
        EXPECT_NEAR(plan.fine[i].elements * plan.fine[i].pitch,
                    plan.coarse[i].elements * plan.coarse[i].pitch, 1e-12);
      EXPECT_LE(
          largest_pitch(rail.first, plan.fine, zone.first - margin, std::min(zone.last + margin, run.last)),
          approach);
      EXPECT_NEAR(largest_pitch(rail.first, plan.fine, 0, zone.first - margin - 0.2), coarse, 0.02 * coarse);
      EXPECT_NEAR(largest_pitch(rail.first, plan.coarse, 0, zone.first - margin - 0.2), 2 * coarse,
                  0.04 * coarse);
    }
}

/// Elements that would be longer than the patch are not made.
TEST(StationPlan, CoarseMeshesStayAsTheyAre) {
  MeshSizes sizes{4e-3, 45e-3, 10e-3, 65e-3, 2, 4, 4, 24e-3};
  sizes.margin = 0.1;
  const NestedSegments plan = plan_rail({-1, 12}, {-0.04, 9}, {{5, 5.2}}, sizes);
  EXPECT_LE(largest_pitch(-1, plan.fine, 0, 9), 1.001 * sizes.contact * sizes.approach_ratio);
}

/// Places of the rail meet the wheel anywhere between those of the stated spin and of rolling.
TEST(StationPlan, ArcsFollowTheSpin) {
  const auto arc = [](const char* creepage) {
    const Scene scene = samples::tyre_scene({"motion.speed=100 m/s", "motion.duration=10 ms",
                                             "rail.length=2 m", fmt::format("motion.creepage={}", creepage)});
    return arc_of(scene, {0.48, 0.62});
  };
  for (const char* small : {"0", "0.002", "-0.005"}) {
    EXPECT_EQ(arc(small).first, 0.48) << small;
    EXPECT_EQ(arc(small).last, 0.62) << small;
  }
  const Span locked = arc("-2");
  EXPECT_LT(locked.first, -0.01);
  EXPECT_GT(locked.first, -0.02);
  EXPECT_EQ(locked.last, 0.62);
  const Span driven = arc("1");  // three turns a turn of rolling
  EXPECT_EQ(driven.first, 0.48);
  EXPECT_NEAR(driven.last, 3 * 0.62, 1e-12);
}

TEST(StationPlan, ALockedWheelIsFineWhereItSlides) {
  const std::vector<std::vector<std::string>> bores = {
      {}, {"wheel.bore=guided", "wheel.overhang=60 mm", "scene.gravity=0 m/s2"}};
  for (std::vector<std::string> keys : bores) {
    keys.insert(keys.end(), {"motion.creepage=-2", "motion.duration=1 ms", "solution_zone.length=20 mm"});
    const Model model(samples::tyre_scene(keys));
    const StationFinder stations(model.mesh.blocks[static_cast<std::size_t>(model.index.tread)]);
    for (const double x : {-7e-3, 0.0, 7e-3, 60e-3})
      EXPECT_LE(model.wheel_radius() * stations.find(-x / model.wheel_radius()).pitch,
                1.01 * model.sizes.contact)
          << keys.front() << " at " << x;
  }
}

/// Zones whose arcs overlap after a turn.
TEST(StationPlan, ATyreIsFineAllAroundWhereArcsOverlap) {
  const MeshSizes sizes{2.2e-3, 45e-3, 10e-3, 65e-3, 2, 4, 4, 14e-3};
  const WheelPlan plan = plan_tyre(0.43, {0, 4}, {{0.05, 0.1}, {3, 3.1}}, sizes);
  EXPECT_NEAR(length_of(plan.tread), 2 * std::numbers::pi, 1e-9);
  EXPECT_LE(0.43 * largest_pitch(0, plan.tread, 0, 7), 1.001 * sizes.contact);
}

TEST(StationPlan, APartOfATyreIsNoRing) {
  const MeshSizes sizes{2.2e-3, 45e-3, 10e-3, 65e-3, 2, 4, 4, 14e-3};
  const WheelPlan plan = plan_tyre_part(0.43, {0, 9}, {{0.05, 0.1}}, 0.1, sizes);
  EXPECT_NEAR(length_of(plan.tread), 1.5 * std::numbers::pi, 1e-9);
}

TEST(StationPlan, ATyreIsFineInEveryZone) {
  constexpr double kRadius = 0.43;
  const MeshSizes sizes{2.2e-3, 45e-3, 10e-3, 65e-3, 2, 4, 4, 14e-3};
  const std::vector<Span> zones = {{0.05, 0.1}, {0.1005, 0.15}, {0.4, 0.5}};
  const Span run{0, 0.8};
  for (const WheelPlan& plan :
       {plan_tyre(kRadius, run, zones, sizes), plan_tyre_part(kRadius, run, zones, 0.05, sizes)}) {
    for (const Span& zone : zones)
      EXPECT_LE(kRadius * largest_pitch(plan.start, plan.tread, -zone.last / kRadius, -zone.first / kRadius),
                1.001 * sizes.contact);
    EXPECT_GE(kRadius * shortest(plan.tread), 0.45 * sizes.contact);
    EXPECT_GT(kRadius * largest_pitch(plan.start, plan.tread, -0.3 / kRadius, -0.25 / kRadius),
              1.5 * sizes.contact);
  }
}

}  // namespace
}  // namespace tread
