// Friction laws for single points, also in constant expressions.

#include <gtest/gtest.h>

#include <cmath>

#include "kernels/contact/friction/friction_law.hpp"

namespace tread {
namespace {

// Laws in constant expressions: what a compiler can evaluate, a device can run.

static_assert(square_root(2.25) == 1.5 && square_root(0.0) == 0);
static_assert(exponential(0) == 1 && exponential(-1e4) == 0);

constexpr Sliding slide(double speed, double x = 0, double dt = 1e-7) {
  return {{0.6 * speed, 0.8 * speed}, x, 0, dt};
}

template <class Law>
constexpr double after_one_step(const Law& law, const Sliding& sliding) {
  typename Law::State state{};
  return law.advance(state, sliding);
}

constexpr Traction stuck() {
  return ElasticStick{2e13}.traction<double>({}, {1e-6, 0}, 4e8, 0);
}
constexpr double dropped() {
  return FallingFriction{0.5, 0.2, 1.5, 1e-5}.steady(1.5) - (0.2 + 0.3 * 0.36787944117144233);
}

static_assert(stuck().along == 2e7 && stuck().across == 0);
static_assert(after_one_step(CoulombFriction{0.4}, slide(3)) == 0.4);
static_assert(dropped() < 1e-15 && dropped() > -1e-15);
static_assert(after_one_step(FallingFriction{0.5, 0.2, 1.5, 1e-5}, slide(0)) == 0.5);

constexpr double kPlaces[] = {0, 0.1, 0.15, 0.3};
constexpr double kCoefficients[] = {0.4, 0.1, 0.1, 0.5};
constexpr TableFriction kTable{kPlaces, kCoefficients, 4, 2};

static_assert(kTable.at(1) == 0.4 && kTable.at(2.12) == 0.1 && kTable.at(5) == 0.5);

TEST(ConstantMath, AgreesWithTheStandardLibrary) {
  constexpr double root = square_root(3e17);
  EXPECT_DOUBLE_EQ(root, std::sqrt(3e17));
  constexpr double tiny = square_root(3e-17);
  EXPECT_DOUBLE_EQ(tiny, std::sqrt(3e-17));
  constexpr double fall = exponential(-2.7);
  EXPECT_NEAR(fall, std::exp(-2.7), 2e-15 * fall);
  constexpr double rise = exponential(5.3);
  EXPECT_NEAR(rise, std::exp(5.3), 1e-14 * rise);
}

TEST(CoulombFriction, IsTheSameAtAnyPlaceAndSpeed) {
  for (const double speed : {0.0, 1e-3, 40.0})
    EXPECT_EQ(after_one_step(CoulombFriction{0.3}, slide(speed, speed)), 0.3);
}

TEST(TableFriction, IsLinearBetweenItsPlacesAndConstantBeyond) {
  EXPECT_EQ(after_one_step(kTable, slide(1, -7)), 0.4);
  EXPECT_NEAR(after_one_step(kTable, slide(1, 2.05)), 0.25, 1e-14);
  EXPECT_NEAR(after_one_step(kTable, slide(0, 2.1)), 0.1, 1e-14);
  EXPECT_NEAR(after_one_step(kTable, slide(1, 2.225)), 0.3, 1e-14);
  EXPECT_NEAR(after_one_step(kTable, slide(1, 2.3)), 0.5, 1e-14);
  EXPECT_EQ(after_one_step(kTable, slide(1, 9)), 0.5);
}

TEST(TableFriction, OnePlaceIsAConstant) {
  constexpr double x = 0;
  constexpr double f = 0.2;
  const TableFriction law{&x, &f, 1, 0};
  EXPECT_EQ(law.at(-1), 0.2);
  EXPECT_EQ(law.at(1), 0.2);
}

constexpr FallingFriction kFalling{0.5, 0.2, 1.5, 2e-5};

TEST(FallingFriction, FallsOverTheMemoryLength) {
  // One length of sliding leaves 1/e of the way to the steady value, in steps of any length.
  for (const int steps : {1, 7, 1000}) {
    FallingFriction::State state{};
    double f = 0;
    const double speed = 3;
    for (int i = 0; i < steps; ++i)
      f = kFalling.advance(state, slide(speed, 0, kFalling.memory_length / speed / steps));
    const double steady = 0.2 + 0.3 * std::exp(-2.0);
    EXPECT_NEAR(kFalling.steady(speed), steady, 1e-15);
    EXPECT_NEAR(f, steady + (0.5 - steady) * std::exp(-1.0), 1e-12);
  }
}

TEST(FallingFriction, RisesAgainWhereTheSlipSlowsDownAndKeepsItsStateAtRest) {
  FallingFriction::State state{};
  for (int i = 0; i < 1000; ++i) kFalling.advance(state, slide(10, 0, 1e-6));
  const double fast = 0.5 - state.fall;
  EXPECT_NEAR(fast, kFalling.steady(10), 1e-9);
  EXPECT_EQ(kFalling.advance(state, slide(0)), fast);
  for (int i = 0; i < 1000; ++i) kFalling.advance(state, slide(0.1, 0, 1e-5));
  EXPECT_NEAR(0.5 - state.fall, kFalling.steady(0.1), 1e-9);
}

TEST(FallingFriction, StaysBetweenItsLimitsInAStepOfAnyLength) {
  FallingFriction::State state{};
  const double f = kFalling.advance(state, slide(80, 0, 1.0));
  EXPECT_GE(f, 0.2);
  EXPECT_NEAR(f, 0.2, 1e-15);
}

TEST(FrictionLaw, OnlyALawWithAStateStoresOne) {
  static_assert(!FrictionOf<CoulombFriction>::kHasState);
  static_assert(!FrictionOf<TableFriction>::kHasState);
  static_assert(FrictionOf<FallingFriction>::kHasState);
  EXPECT_EQ(sizeof(FallingFriction::State), sizeof(double));
}

}  // namespace
}  // namespace tread
