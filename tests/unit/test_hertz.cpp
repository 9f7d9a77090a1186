#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/math/hertz.hpp"

namespace tread {
namespace {

const double kModulus = contact_modulus(205.9e9, 0.3);
constexpr double kLoad = 87564.06;

TEST(Hertz, ModulusOfTwoSteelBodies) {
  EXPECT_NEAR(kModulus, 205.9e9 / (2 * 0.91), 1);
}

TEST(Hertz, CircularPatchIsThatOfTheClosedForm) {
  constexpr double radius = 0.43;
  const HertzPatch patch = hertz(radius, radius, kModulus, kLoad);
  const double a = std::cbrt(0.75 * kLoad * radius / kModulus);
  EXPECT_NEAR(patch.semi_axis_x / a, 1, 1e-6);
  EXPECT_NEAR(patch.semi_axis_y / a, 1, 1e-6);
  EXPECT_NEAR(patch.approach / (a * a / radius), 1, 1e-6);
  EXPECT_NEAR(patch.max_pressure / (1.5 * kLoad / (std::numbers::pi * a * a)), 1, 1e-6);
  EXPECT_NEAR(patch.semi_axis_x, 6.2964e-3, 5e-8);
  EXPECT_NEAR(patch.max_pressure, 1054.6e6, 5e4);
  EXPECT_NEAR(patch.approach, 92.2e-6, 5e-8);
}

TEST(Hertz, EllipticPatchOfTheWheelOnTheRail) {
  // Reference values come from elliptic integrals evaluated separately, to seven digits.
  const HertzPatch patch = hertz(0.43, 0.3, kModulus, kLoad);
  EXPECT_NEAR(patch.semi_axis_x, 6.673e-3, 5e-7);
  EXPECT_NEAR(patch.semi_axis_y, 5.250e-3, 5e-7);
  EXPECT_NEAR(patch.max_pressure, 1193.3e6, 5e4);
  EXPECT_NEAR(patch.approach, 97.72e-6, 5e-9);
}

TEST(Hertz, AxesSwapWithTheRadii) {
  const HertzPatch a = hertz(0.43, 0.3, kModulus, kLoad);
  const HertzPatch b = hertz(0.3, 0.43, kModulus, kLoad);
  EXPECT_DOUBLE_EQ(a.semi_axis_x, b.semi_axis_y);
  EXPECT_DOUBLE_EQ(a.semi_axis_y, b.semi_axis_x);
  EXPECT_DOUBLE_EQ(a.approach, b.approach);
}

TEST(Hertz, GrowsWithTheCubeRootAndGoesOverSmoothlyToTheCircle) {
  const HertzPatch once = hertz(0.43, 0.3, kModulus, kLoad);
  const HertzPatch eight = hertz(0.43, 0.3, kModulus, 8 * kLoad);
  EXPECT_NEAR(eight.semi_axis_x / once.semi_axis_x, 2, 1e-12);
  EXPECT_NEAR(eight.max_pressure / once.max_pressure, 2, 1e-12);
  EXPECT_NEAR(eight.approach / once.approach, 4, 1e-12);
  const HertzPatch circle = hertz(0.43, 0.43, kModulus, kLoad);
  for (const double off : {1e-12, 1e-9, 1e-7, 1e-6, 1e-5, 1e-4}) {
    const HertzPatch near = hertz(0.43 * (1 + off), 0.43, kModulus, kLoad);
    EXPECT_NEAR(near.approach / circle.approach, 1 - off / 6, 1e-7) << off;
    EXPECT_GE(near.semi_axis_x, near.semi_axis_y);
    EXPECT_NEAR(near.semi_axis_x / near.semi_axis_y, 1 + 2 * off / 3, 1e-6) << off;
  }
}

TEST(Hertz, SlenderPatchNearsALine) {
  const HertzPatch patch = hertz(1e4, 0.3, kModulus, kLoad);
  EXPECT_GT(patch.semi_axis_x, 100 * patch.semi_axis_y);
  // Load per length at the middle is 3/4 of the total over the semi-axis: line contact of that load.
  const double line = 0.75 * kLoad / patch.semi_axis_x;
  EXPECT_NEAR(line_load(0.3, kModulus, patch.semi_axis_y) / line, 1, 2e-3);
  EXPECT_NEAR(line_semi_axis(0.3, kModulus, line) / patch.semi_axis_y, 1, 1e-3);
}

}  // namespace
}  // namespace tread
