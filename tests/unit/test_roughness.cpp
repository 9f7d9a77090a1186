// Roughness levels and the preparation of a profile.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "core/parallel/parallel.hpp"
#include "drivers/studies/roughness/roughness_levels.hpp"
#include "tests/measured.hpp"

namespace tread {
namespace {

/// Sum of sines of a depth from crest to trough [m].
struct Wave {
  double wavelength, depth;  ///< [m]
};

RoughnessProfile sines(double length, double spacing, const std::vector<Wave>& waves) {
  RoughnessProfile profile;
  profile.spacing = spacing;
  for (int i = 0; i < std::lround(length / spacing); ++i) {
    double sum = 0;
    for (const Wave& w : waves)
      sum += 0.5 * w.depth * std::sin(2 * std::numbers::pi * i * spacing / w.wavelength + 0.4);
    profile.height.push_back(sum);
  }
  return profile;
}

std::size_t band(double nominal_mm) {
  for (std::size_t i = 0; i < roughness_bands().size(); ++i)
    if (std::abs(1e3 * roughness_bands()[i].nominal - nominal_mm) < 1e-9) return i;
  ADD_FAILURE() << nominal_mm;
  return 0;
}

/// Level of a sine of that depth: 10 lg of its mean square over 1 um2.
double decibels(double depth) {
  return 20 * std::log10(depth / (2 * std::numbers::sqrt2) / 1e-6);
}

TEST(RoughnessBands, AreThoseOfTheStandard) {
  const std::vector<RoughnessBand>& bands = roughness_bands();
  ASSERT_EQ(bands.size(), 22U);
  EXPECT_NEAR(bands.front().middle, 0.39811, 1e-5);
  EXPECT_NEAR(bands.back().middle, 3.16228e-3, 1e-8);
  for (std::size_t i = 0; i < bands.size(); ++i) {
    EXPECT_NEAR(bands[i].middle / bands[i].nominal, 1, 0.012) << i;
    if (i > 0) {
      EXPECT_NEAR(bands[i].high() / bands[i - 1].low(), 1, 1e-12) << i;
      EXPECT_LT(bands[i].limit, bands[i - 1].limit) << i;
    }
  }
  EXPECT_EQ(bands[band(80)].limit, 2.9);
}

TEST(RoughnessLevels, OfCorrugationD) {
  EXPECT_NEAR(decibels(0.14e-3), 33.9, 0.05);
  const RoughnessLevels levels = roughness_levels(sines(10, 1e-3, {{0.08, 0.14e-3}}), 2);
  EXPECT_EQ(levels.segments, 9);
  const double level = levels.level[band(80)].value();
  measured("0.14 mm at 80 mm", level, "dB");
  EXPECT_NEAR(level, decibels(0.14e-3), 0.01);
  // Other bands hold none of the level: Hann's window leaks into no other band here.
  for (std::size_t i = 0; i < levels.level.size(); ++i)
    if (i != band(80)) {
      EXPECT_LT(levels.level[i].value(), 33.9 - 60) << i;
    }
}

TEST(RoughnessLevels, WavesBetweenTheLines) {
  // 78.3 mm does not divide 2 m; with 63 mm waves in the next band.
  const RoughnessLevels levels = roughness_levels(sines(30, 1e-3, {{0.0783, 0.04e-3}, {0.0631, 0.18e-3}}), 2);
  EXPECT_NEAR(levels.level[band(80)].value(), 23.0, 0.1);
  EXPECT_NEAR(levels.level[band(63)].value(), 36.1, 0.1);
}

TEST(RoughnessLevels, TrendAndMeanDoNotCount) {
  RoughnessProfile profile = sines(4, 1e-3, {{0.08, 0.14e-3}});
  for (std::size_t i = 0; i < profile.height.size(); ++i) profile.height[i] += 1 + 3e-3 * 1e-3 * double(i);
  const RoughnessLevels levels = roughness_levels(profile, 2);
  EXPECT_NEAR(levels.level[band(80)].value(), decibels(0.14e-3), 0.01);
  EXPECT_LT(levels.level[band(400)].value(), -40);
}

TEST(RoughnessLevels, EnergyIsThatOfTheProfile) {
  // Noise between 10 and 100 mm: the bands' squares add up to its variance.
  std::vector<Wave> waves;
  double square = 0;
  for (int i = 0; i < 60; ++i) {
    waves.push_back({0.1 / (1 + 0.1483 * i), 2e-6 * (1 + i % 7)});
    square += waves.back().depth * waves.back().depth / 8;
  }
  const RoughnessLevels levels = roughness_levels(sines(200, 1e-3, waves), 2);
  double sum = 0;
  for (const auto& level : levels.level) sum += 1e-12 * std::pow(10, 0.1 * level.value());
  EXPECT_NEAR(sum / square, 1, 0.02);
}

TEST(RoughnessLevels, BandsThatTheRecordCannotShowAreAbsent) {
  const RoughnessLevels brief = roughness_levels(sines(0.5, 1e-3, {{0.08, 0.14e-3}}), 2);
  EXPECT_EQ(brief.segments, 1);
  EXPECT_FALSE(brief.level[band(160)].has_value());
  EXPECT_TRUE(brief.level[band(125)].has_value());
  const RoughnessLevels coarse = roughness_levels(sines(4, 5e-3, {{0.08, 0.14e-3}}), 2);
  EXPECT_FALSE(coarse.level[band(12.5)].has_value());
  EXPECT_TRUE(coarse.level[band(16)].has_value());
  EXPECT_THROW(roughness_levels(sines(0.01, 1e-3, {{0.08, 0.14e-3}}), 2), InputError);
}

TEST(RoughnessLevels, TheWholeRecordCounts) {
  // The profile is rough in its last 0.9 m alone: a second segment reaches it.
  RoughnessProfile profile = sines(2.9, 1e-3, {{0.08, 0.14e-3}});
  std::fill(profile.height.begin(), profile.height.begin() + 2000, 0.0);
  const RoughnessLevels levels = roughness_levels(profile, 2);
  EXPECT_EQ(levels.segments, 2);
  EXPECT_GT(levels.level[band(80)].value(), decibels(0.14e-3) - 10);
}

TEST(RoughnessLevels, ThreadsDoNotChangeThem) {
  const RoughnessProfile profile = sines(20, 1e-3, {{0.08, 0.14e-3}, {0.0631, 0.18e-3}});
  set_threads(1);
  const RoughnessLevels one = roughness_levels(profile, 2);
  set_threads(3);
  const RoughnessLevels three = roughness_levels(profile, 2);
  set_threads(1);
  EXPECT_EQ(one.level, three.level);
}

TEST(RoughnessProfiles, SpikesGoAndCorrugationStays) {
  RoughnessProfile profile = sines(2, 1e-3, {{0.08, 0.14e-3}});
  const RoughnessProfile clean = profile;
  EXPECT_EQ(remove_spikes(profile), 0);
  // 60 um of dust over 4 mm; a hill of 5 um over as much is a surface.
  for (const int i : {300, 811}) {
    profile.height[i] += 60e-6;
    profile.height[i - 1] += 30e-6;
    profile.height[i + 1] += 30e-6;
  }
  EXPECT_EQ(remove_spikes(profile), 2);
  for (std::size_t i = 0; i < profile.height.size(); ++i)
    EXPECT_NEAR(profile.height[i], clean.height[i], 4e-6) << i;
  profile.height[1200] += 2e-6;
  EXPECT_EQ(remove_spikes(profile), 0);
}

TEST(RoughnessProfiles, PitsCloseAsFarAsADiscReaches) {
  // The disc sinks into a deep slot of 10 mm by its sag over half of the width.
  RoughnessProfile slot;
  slot.spacing = 1e-3;
  slot.height.assign(400, 0.0);
  for (std::size_t i = 200; i < 209; ++i) slot.height[i] = -1e-3;
  const auto sag = [](double x) { return 0.375 - std::sqrt(0.375 * 0.375 - x * x); };
  EXPECT_NEAR(close_pits(slot), 1e-3 - sag(1e-3), 1e-9);
  EXPECT_NEAR(slot.height[204], -sag(5e-3), 1e-9);
  // Corrugation D is flatter than the disc everywhere: its level hardly changes.
  RoughnessProfile wave = sines(4, 1e-3, {{0.08, 0.14e-3}});
  const double change = close_pits(wave);
  EXPECT_GT(change, 1e-6);
  EXPECT_LT(change, 8e-6);  // half the squared slope times the radius
  EXPECT_NEAR(roughness_levels(wave, 2).level[band(80)].value(), decibels(0.14e-3), 0.05);
}

TEST(RoughnessProfiles, UnevenDistancesAreInterpolated) {
  TwoColumns rows;
  for (int i = 0; i < 3000; ++i) {
    const double x = 1e-3 * (i + 0.2 * std::sin(0.7 * i));
    rows.first.push_back(x);
    rows.second.push_back(0.07e-3 * std::sin(2 * std::numbers::pi * x / 0.08));
  }
  const RoughnessProfile profile = even_profile(rows, "file");
  EXPECT_TRUE(profile.resampled);
  EXPECT_EQ(profile.height.size(), 3000U);
  EXPECT_NEAR(profile.spacing, 1e-3, 1e-6);
  EXPECT_NEAR(roughness_levels(profile, 2).level[band(80)].value(), decibels(0.14e-3), 0.05);
  rows.first.erase(rows.first.begin() + 100, rows.first.begin() + 110);
  rows.second.erase(rows.second.begin() + 100, rows.second.begin() + 110);
  EXPECT_THROW(even_profile(rows, "file"), InputError);
}

}  // namespace
}  // namespace tread
