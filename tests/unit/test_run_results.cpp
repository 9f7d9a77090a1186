#include <gtest/gtest.h>

#include <vector>

#include "drivers/results/run_results.hpp"

namespace tread {
namespace {

constexpr double kForce = 25e3;  // [N]

/// Samples of a wheel that rolls 1 m and does the frictional work `creepage` times |F_L| times its way.
std::vector<Sample> rolling(double force, double creepage) {
  std::vector<Sample> samples;
  for (int i = 0; i <= 100; ++i) {
    Sample sample;
    sample.wheel_x = 0.01 * i;
    sample.vertical_force = 80e3;
    sample.longitudinal_force = force;
    sample.energy.frictional_work = creepage * kForce * sample.wheel_x;
    samples.push_back(sample);
  }
  return samples;
}

TEST(CreepageOfWork, IsTheWorkPerWayOverTheForce) {
  EXPECT_NEAR(creepage_of_work(rolling(kForce, 0.0027), 0.2, 0.8).value(), 0.0027, 1e-12);
  EXPECT_NEAR(creepage_of_work(rolling(-kForce, 0.0027), 0.2, 0.8).value(), -0.0027, 1e-12);  // braking
}

TEST(CreepageOfWork, IsAbsentWithoutForceOrWay) {
  EXPECT_FALSE(creepage_of_work(rolling(0, 0), 0.2, 0.8));
  EXPECT_FALSE(creepage_of_work(rolling(0.004 * 80e3, 0.0027), 0.2, 0.8));  // work of spin
  EXPECT_TRUE(creepage_of_work(rolling(0.006 * 80e3, 0.0027), 0.2, 0.8));
  EXPECT_FALSE(creepage_of_work(rolling(kForce, 0.0027), 2.0, 3.0));
  EXPECT_FALSE(creepage_of_work({}, 0.2, 0.8));
}

TEST(Traction, IsSteadyIfItsHalvesAgree) {
  RunResults results;
  results.traction_coefficient = 0.3;
  results.traction_drift = 0.0149;
  EXPECT_TRUE(traction_is_steady(results));
  results.traction_drift = -0.0151;
  EXPECT_FALSE(traction_is_steady(results));
  // A wheel that rolls freely has no traction to compare with.
  results.traction_coefficient = 0.001;
  results.traction_drift = 0.0049;
  EXPECT_TRUE(traction_is_steady(results));
}

}  // namespace
}  // namespace tread
