#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "kernels/contact/friction/friction_law.hpp"

namespace tread {
namespace {

constexpr ElasticStick kStick{2e13};
constexpr double kFriction = 0.4;
constexpr double kPressure = 1e9;

double size(const Traction& t) {
  return std::hypot(t.along, t.across);
}

/// A step without compliance, and its changes of the energies [J/m2].
struct Step {
  Traction traction;
  double work;  ///< work of the mid-step traction
  double dissipation;
};

Step advance(double friction, const Traction& before, const Traction& slip, double pressure) {
  const Traction t = kStick.traction<double>(before, slip, friction * pressure, 0);
  return {t, 0.5 * ((before.along + t.along) * slip.along + (before.across + t.across) * slip.across),
          kStick.dissipation(before, t, slip)};
}

TEST(ElasticStick, SticksBelowTheLimit) {
  const auto result = advance(kFriction, {1e8, 0}, {2e-6, -3e-6}, kPressure);
  EXPECT_DOUBLE_EQ(result.traction.along, 1e8 + 2e13 * 2e-6);
  EXPECT_DOUBLE_EQ(result.traction.across, -2e13 * 3e-6);
  EXPECT_NEAR(result.dissipation, 0, 1e-15 * result.work);
  EXPECT_GT(result.work, 0);
}

TEST(ElasticStick, SlipsAtTheLimitAlongTheTrialTraction) {
  const auto result = advance(kFriction, {}, {3e-4, 4e-4}, kPressure);
  EXPECT_NEAR(size(result.traction), 0.4e9, 1e-6);
  EXPECT_NEAR(result.traction.across / result.traction.along, 4.0 / 3, 1e-14);
  // The work is the slipped distance times the mean traction, less the energy stored in the stick.
  EXPECT_NEAR(result.work, 0.5 * 0.4e9 * 5e-4, 1e-9);
  EXPECT_NEAR(result.dissipation, result.work - 0.5 * 0.4e9 * 0.4e9 / 2e13, 1e-9);
}

TEST(ElasticStick, SteadySlipDissipatesTractionTimesWay) {
  const Traction limit{0.4e9, 0};
  const auto result = advance(kFriction, limit, {1e-6, 0}, kPressure);
  EXPECT_DOUBLE_EQ(result.traction.along, 0.4e9);
  EXPECT_NEAR(result.dissipation, 0.4e9 * 1e-6, 1e-9);
}

TEST(ElasticStick, ReleaseGivesBackNothing) {
  const auto result = advance(kFriction, {1e8, 2e8}, {1e-7, 0}, 0);
  EXPECT_EQ(result.traction.along, 0);
  EXPECT_EQ(result.traction.across, 0);
  EXPECT_GT(result.dissipation, 0);
  const auto still = advance(kFriction, {1e8, 2e8}, {}, 0);
  EXPECT_EQ(still.work, 0);
  EXPECT_DOUBLE_EQ(still.dissipation, 0.5 * 5e16 / 2e13);
  EXPECT_EQ(size(advance(kFriction, {}, {}, 0).traction), 0);
}

TEST(ElasticStick, FrictionlessContactCarriesNoShear) {
  const auto result = advance(0, {}, {1e-5, 1e-5}, kPressure);
  EXPECT_EQ(size(result.traction), 0);
  EXPECT_EQ(result.dissipation, 0);
  EXPECT_TRUE(std::isfinite(result.work));
}

TEST(ElasticStick, ComplianceGivesTheTractionOfTheSlipThatIsLeft) {
  constexpr double compliance = 3e-13;
  const Traction before{1e8, -5e7};
  for (const Traction free : {Traction{2e-6, -3e-6}, Traction{9e-4, 4e-4}}) {
    constexpr double limit = kFriction * kPressure;
    const Traction result = kStick.traction<double>(before, free, limit, compliance);
    const Traction left{free.along - compliance * result.along, free.across - compliance * result.across};
    const Traction same = kStick.traction<double>(before, left, limit, 0);
    EXPECT_NEAR(size(result), size(same), 1e-6);
    if (size(result) > 0.99 * limit) continue;
    EXPECT_NEAR(result.along, same.along, 1e-7);
    EXPECT_NEAR(result.across, same.across, 1e-7);
  }
}

TEST(ElasticStick, RandomPathsDissipateAndTheWorkCloses) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> value(-1, 1);
  Traction traction;
  double pressure = 0;
  double work = 0;
  double dissipated = 0;
  double scale = 0;
  for (int step = 0; step < 20000; ++step) {
    const double before = pressure;
    pressure = std::max(0.0, pressure + 2e7 * (value(random) + (step % 400 < 200 ? 0.5 : -0.5)));
    const Traction slip{4e-7 * value(random) + 2e-7, 4e-7 * value(random)};
    const auto result = advance(kFriction, traction, slip, pressure);
    EXPECT_LE(size(result.traction), 0.4 * pressure * (1 + 1e-15));
    // A step that lowers the pressure and turns the shear round counts the release at the new direction.
    const double squared = traction.along * traction.along + traction.across * traction.across;
    const double turned =
        kStick.tangential_penalty * (traction.along * slip.along + traction.across * slip.across);
    if (pressure >= before || squared + turned >= 0) {
      EXPECT_GE(result.dissipation, -1e-14 * scale);
    }
    if (size(result.traction) < kSlipping * kFriction * pressure) {
      EXPECT_NEAR(result.dissipation, 0, 1e-13 * (scale + std::abs(result.work)));
    }
    traction = result.traction;
    work += result.work;
    dissipated += result.dissipation;
    scale = std::max(scale, std::abs(work));
  }
  EXPECT_NEAR(work, dissipated + kStick.stored(traction), 1e-12 * scale);
  EXPECT_GT(dissipated, 0.5 * scale);
}

}  // namespace
}  // namespace tread
