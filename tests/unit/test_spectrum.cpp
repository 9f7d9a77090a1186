#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "core/math/spectrum.hpp"

namespace tread {
namespace {

constexpr double kInterval = 1e-4;  // [s]

/// A sine of amplitude 3 at 1000 Hz on a slope, 0.1 s long.
std::vector<double> sine_on_a_slope() {
  std::vector<double> values;
  for (int i = 0; i < 1000; ++i)
    values.push_back(7 + 0.02 * i + 3 * std::sin(2 * std::numbers::pi * 1000 * kInterval * i));
  return values;
}

TEST(Spectrum, BandOfASineHoldsItsMeanSquare) {
  const std::vector<double> lines = power_lines(sine_on_a_slope(), 500);
  constexpr double kSpacing = 10;  // [Hz]
  EXPECT_NEAR(band_power(lines, kSpacing, 800, 1250), 4.5, 0.01);
  EXPECT_LT(band_power(lines, kSpacing, 2000, 4000), 1e-6);
  EXPECT_LT(band_power(lines, kSpacing, 100, 500), 0.01);
}

TEST(Spectrum, NeighbouringBandsShareALine) {
  const std::vector<double> lines = {0, 1, 2, 4};
  EXPECT_DOUBLE_EQ(band_power(lines, 1, 0.5, 2) + band_power(lines, 1, 2, 3.5), 7);
  EXPECT_DOUBLE_EQ(band_power(lines, 1, 0.5, 2), 2);
}

/// The sine of `waves` in the record, 4 % above the middle of its band, does not show in the neighbours of
/// it. Bands too narrow for that are not listed.
TEST(ThirdOctaves, AreListedWhereTheyHoldASine) {
  const auto shares = [](int waves) {
    std::vector<double> values;
    for (int i = 0; i < 4000; ++i)
      values.push_back(std::numbers::sqrt2 * std::sin(2 * std::numbers::pi * waves * i / 4000.0));
    const std::vector<double> lines = power_lines(values, 1000);
    std::vector<double> power;
    // Lines lie so that the sine has 1042 Hz.
    const double spacing = 1042.0 / waves;
    for (const ThirdOctave& band : third_octaves(kLinesOfASine * spacing, 1500))
      if (band.nominal >= 800) power.push_back(band_power(lines, spacing, band.low(), band.high()));
    return power;
  };
  EXPECT_TRUE(shares(6).empty());
  EXPECT_TRUE(shares(12).empty());
  for (const int waves : {20, 24, 60}) {
    const std::vector<double> power = shares(waves);
    const std::size_t own = power.size() - 2;
    EXPECT_NEAR(power[own], 1, 0.04) << waves;
    EXPECT_LT(power.back(), 0.04) << waves;
    if (own > 0) {
      EXPECT_LT(power[0], 0.01) << waves;
    }
  }
}

TEST(ThirdOctaves, AreThoseOfTheStandard) {
  std::vector<double> nominal;
  for (const ThirdOctave& band : third_octaves(18, 1500)) {
    nominal.push_back(band.nominal);
    EXPECT_NEAR(band.middle / band.nominal, 1, 0.015);
    EXPECT_NEAR(band.high() / band.low(), std::pow(10, 0.1), 1e-12);
    EXPECT_GE(band.high() - band.low(), 18);
    EXPECT_LE(band.high(), 1500);
  }
  EXPECT_EQ(nominal, (std::vector<double>{80, 100, 125, 160, 200, 250, 315, 400, 500, 630, 800, 1000, 1250}));
  EXPECT_DOUBLE_EQ(third_octaves(0.014, 0.08).front().nominal, 0.063);
  EXPECT_TRUE(third_octaves(100, 101).empty());
}

}  // namespace
}  // namespace tread
