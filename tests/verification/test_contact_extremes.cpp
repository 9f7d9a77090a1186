// The wheel off the rail, beyond adhesion, and at rest. [limits.md]

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "drivers/verify/ride.hpp"
#include "drivers/verify/tyre_on_block.hpp"
#include "tests/measured.hpp"
#include "tests/tyre_scene.hpp"

namespace tread {
namespace {

const ProgressText kSilent = [](const std::string&) {};

TEST(Extremes, WheelThatLeavesTheRailLandsWithoutGainOfEnergy) {
  Model model(samples::tyre_scene(
      {"scene.element_size=6 mm", "motion.duration=1.6 ms", "corrugation.depth=0.5 mm",
       "corrugation.wavelength=80 mm", "corrugation.start=50 mm", "corrugation.length=80 mm",
       "solution_zone.length=90 mm", "motion.traction.mu=0.2", "motion.traction.ramp=0.2 ms"}));
  const RunResults run = ride(model, 400, kSilent);
  int off = 0;
  bool landed = false;
  for (const Sample& s : run.samples) {
    if (s.patch_area > 0) {
      landed = landed || off > 0;
      continue;
    }
    ++off;
    EXPECT_EQ(s.vertical_force, 0);
    EXPECT_EQ(s.longitudinal_force, 0);
    EXPECT_EQ(s.energy.penalty, 0);
    EXPECT_EQ(s.max_pressure, 0);
  }
  measured("samples off the rail", off);
  measured("energy error", run.energy_error);
  EXPECT_GT(off, 20);
  EXPECT_TRUE(landed);
  EXPECT_LT(run.energy_error, 0.01);
  EXPECT_LT(run.momentum_error, 1e-5);
  EXPECT_EQ(count_not_finite(model, run), 0);
}

/// A torque of four times the limit of adhesion, in either direction.
class BeyondAdhesion : public ::testing::TestWithParam<double> {};

TEST_P(BeyondAdhesion, ForceStaysAtTheLimitAndTheRestSpinsTheWheel) {
  const double torque = GetParam() * 4 * 0.5 * 88.4e3 * 0.43;
  Model model(samples::tyre_scene({"scene.element_size=6 mm", "motion.duration=0.8 ms", "motion.speed=20 m/s",
                                   "motion.traction.torque=" + std::to_string(torque) + " N m",
                                   "motion.traction.ramp=0.1 ms"}));
  const RunResults run = ride(model, 400, kSilent);
  const auto mean = [&](const auto& value) { return since(run, 0.5e-3, value).mean; };
  const double normal = mean([](const Sample& s) { return s.vertical_force; });
  const double force = mean([](const Sample& s) { return s.longitudinal_force; });
  measured("F_L / (f F_N)", force / (0.5 * normal));
  measured("angular momentum error", angular_momentum_error(model, run));
  EXPECT_NEAR(force / (0.5 * normal), GetParam(), 0.005);
  EXPECT_LT(angular_momentum_error(model, run), 0.005);
  EXPECT_LT(run.energy_error, 0.01);
}

INSTANTIATE_TEST_SUITE_P(Extremes, BeyondAdhesion, ::testing::Values(1.0, -1.0));

TEST(Extremes, StandingWheelHasNoCreepage) {
  Model model(
      samples::tyre_scene({"scene.element_size=6 mm", "motion.duration=0.05 ms", "motion.speed=0 m/s"}));
  const RunResults run = ride(model, 50, kSilent);
  for (const Sample& s : run.samples) EXPECT_EQ(s.creepage_mean, 0);
  EXPECT_EQ(count_not_finite(model, run), 0);
  EXPECT_NEAR(run.samples.back().vertical_force, model.wheel_load(), 1e-3 * model.wheel_load());
}

TEST(Extremes, LineContactOnASmallWheelIsSearchedForFarEnough) {
  // The patch ends 8 mm from the axis, where the undeformed surfaces are 0.3 mm apart.
  TyreOnBlock bodies;
  bodies.radius = 0.1;
  bodies.crown_radius = 0;
  bodies.elastic = {{205.9e9, 0.3}, {205.9e9, 0.3}};
  bodies.element_size = 2e-3;
  bodies.load = 113.7e3;
  bodies.thickness = 0.05;
  Model model(bodies.scene());
  const Preload preload = solve_preload(model, {}, kSilent);
  const double half = preload.contact.area / (2 * bodies.element_size);
  measured("half length of the patch / Hertz", half / bodies.hertz_patch().semi_axis_x);
  EXPECT_NEAR(half, bodies.hertz_patch().semi_axis_x, 0.1 * half);
}

}  // namespace
}  // namespace tread
