// Wear of a profile by made-up frictional work: filter, step, growth.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>
#include <string>

#include "core/corrugation.hpp"
#include "core/error.hpp"
#include "drivers/studies/develop/development.hpp"
#include "drivers/studies/develop/development_report.hpp"

namespace tread {
namespace {

constexpr double kStart = 2.4;      // [m]
constexpr double kLength = 0.64;    // [m]
constexpr double kElement = 5e-3;   // [m]
constexpr double kMean = 6000;      // [J/m2]
constexpr double kPerWork = 3e-13;  // [m3/J]
const WearBand kBand{0.03, 0.16};

double wave(double x, double wavelength, double phase = 0) {
  return std::cos(2 * std::numbers::pi * (x - kStart) / wavelength + phase);
}

WornProfile profile_of(auto depth) {
  WornProfile profile{kStart, 1e-3, {}};
  for (int i = 0; i <= 640; ++i) profile.depth.push_back(depth(kStart + 1e-3 * i));
  return profile;
}

PassageWork work_of(auto value) {
  PassageWork work;
  for (int i = 0; i < 128; ++i) {
    work.x.push_back(kStart + (i + 0.5) * kElement);
    work.length.push_back(kElement);
    work.work.push_back(value(work.x.back(), i));
  }
  return work;
}

const WornProfile kFlat = profile_of([](double) { return 0.0; });

TEST(Wear, TheBandEndsWithinAThirdOfAnOctave) {
  for (const double inside : {0.03, 0.08, 0.16}) EXPECT_EQ(kBand.gain(inside), 1) << inside;
  const double third = std::exp2(1.0 / 3);
  for (const double outside : {0.03 / third, 0.16 * third, 0.01, 1.0})
    EXPECT_NEAR(kBand.gain(outside), 0, 1e-12) << outside;
  EXPECT_NEAR(kBand.gain(0.03 / std::sqrt(third)), 0.5, 1e-12);
}

TEST(Wear, WavesOfTheBandPassUnchangedAndNothingElseDoes) {
  const double amplitude = 500;  // [J/m2]
  const PassageWork work = work_of([&](double x, int i) {
    const double noise = 300 * (i % 2 == 0 ? 1 : -1) + 200 * wave(x, 3 * kElement);
    return kMean + amplitude * wave(x, 0.08, 0.7) + noise;
  });
  EXPECT_NEAR(mean_work(work, kFlat, kBand), kMean, 1e-3 * kMean);
  const std::vector<double> uneven = uneven_work(work, kFlat, kBand);
  // Waves that fade at the ends have parts outside the band: 3 % of the amplitude is missing inside.
  for (std::size_t i = 0; i < uneven.size(); ++i) {
    const double x = kFlat.x(i);
    const double inside = std::min(x - kStart, kStart + kLength - x);
    if (inside > kBand.longest) {
      EXPECT_NEAR(uneven[i], amplitude * wave(x, 0.08, 0.7), 0.04 * amplitude) << x;
    }
  }
  EXPECT_NEAR(uneven.front(), 0, 1e-9);
  EXPECT_NEAR(uneven.back(), 0, 1e-9);
  // The noise without the wave leaves nothing.
  const std::vector<double> noise =
      uneven_work(work_of([](double x, int i) {
                    return kMean + 300 * (i % 2 == 0 ? 1 : -1) + 200 * wave(x, 3 * kElement);
                  }),
                  kFlat, kBand);
  for (const double value : noise) EXPECT_NEAR(value, 0, 5);
}

TEST(Wear, APassageStandsForAsManyAsChangeTheDepthByItsShare) {
  const WornProfile before = profile_of([](double x) { return 1e-4 * wave(x, 0.08); });
  std::vector<double> uneven;
  for (std::size_t i = 0; i < before.depth.size(); ++i) uneven.push_back(400 * wave(before.x(i), 0.08));
  const WearStep step = worn(before, uneven, kPerWork, 0.05);
  EXPECT_NEAR(step.passages, 0.05 * 2e-4 / (kPerWork * 800), 1e-6 * step.passages);
  EXPECT_NEAR(step.profile.range(), 1.05 * before.range(), 1e-9);  // the work is largest in troughs
  EXPECT_NEAR(worn(before, uneven, kPerWork, 0.025).passages, 0.5 * step.passages, 1e-6 * step.passages);
  const std::vector<double> none(uneven.size(), 0.0);
  EXPECT_THROW(worn(before, none, kPerWork, 0.05), InputError);
}

TEST(Wear, PassagesOfAnotherMeshAreRefused) {
  const PassageWork one = work_of([](double, int) { return 7.0; });
  PassageWork other = one;
  EXPECT_EQ(without(one, other).work.front(), 0);
  other.x.front() += 1e-3;
  EXPECT_THROW(without(one, other), InputError);
}

TEST(Growth, TheResponseIsFoundWithItsPhase) {
  const std::complex<double> response = std::polar(3e7, 0.8);  // the work's maximum before the trough
  const WornProfile profile =
      profile_of([](double x) { return 7e-5 * wave(x, 0.08) + 2e-5 * wave(x, 0.04, 1.0) + 7e-5; });
  const PassageWork work = work_of([&](double x, int) {
    return std::abs(response) * (7e-5 * wave(x, 0.08, 0.8) + 2e-5 * wave(x, 0.04, 1.8));
  });
  const std::vector<GrowthBand> bands = growth_bands(profile, work, kBand);
  ASSERT_EQ(bands.size(), 8U);  // 160 to 31.5 mm
  EXPECT_EQ(bands.front().wavelength, 0.16);
  ASSERT_NE(deepest_band(bands), nullptr);
  EXPECT_EQ(deepest_band(bands)->wavelength, 0.08);
  EXPECT_EQ(deepest_band({}), nullptr);
  for (const GrowthBand& band : bands) {
    if (band.wavelength != 0.08 && band.wavelength != 0.04) continue;
    EXPECT_NEAR(std::abs(band.response - response), 0, 0.02 * std::abs(response)) << band.wavelength;
    EXPECT_NEAR(band.lag(), -0.8 / (2 * std::numbers::pi), 0.005);
    EXPECT_GT(band.coherence, 0.99);
  }
}

/// A rail whose work follows its depth by `response` [J/m3], after some passages.
Development developed(double response, double change, int passages) {
  Development development;
  const auto roughness = [](double x) {
    return end_taper(x - kStart, kLength, 0.08) * (2e-6 * wave(x, 0.08) + 1e-6 * wave(x, 0.05, 2.0));
  };
  development.plan = {kPerWork, change, kBand, profile_of(roughness)};
  development.profile = development.plan.start;
  development.smooth = work_of([](double, int i) { return kMean + 50 * (i % 3); });
  for (int k = 0; k < passages; ++k) {
    const WornProfile& profile = development.profile;
    PassageWork work = development.smooth;
    for (std::size_t i = 0; i < work.x.size(); ++i)
      work.work[i] +=
          response * profile.depth[static_cast<std::size_t>(std::lround((work.x[i] - kStart) / 1e-3))];
    development.add(work);
  }
  return development;
}

const BandOutcome& at(const std::vector<BandOutcome>& bands, double wavelength) {
  for (const BandOutcome& band : bands)
    if (band.wavelength == wavelength) return band;
  throw std::out_of_range("no such band");
}

TEST(Development, ProfilesGrowAsTheirWorkSays) {
  for (const double response : {3e7, -3e7}) {
    const Development development = developed(response, 0.05, 10);
    EXPECT_EQ(development.passages.size(), 10U);
    const std::vector<BandOutcome> bands = outcome(development);
    for (const double wavelength : {0.08, 0.05}) {
      const BandOutcome& band = at(bands, wavelength);
      EXPECT_NEAR(band.first_growth, kPerWork * response, 0.02 * kPerWork * std::abs(response)) << wavelength;
      EXPECT_NEAR(band.growth, band.first_growth, 0.1 * std::abs(band.first_growth)) << wavelength;
      EXPECT_NEAR(band.per_wear, response / development.mean_work(), 0.02 * std::abs(band.per_wear));
      EXPECT_TRUE(band.telling);
    }
    EXPECT_FALSE(at(bands, 0.125).telling);
    EXPECT_EQ(deepest(bands)->wavelength, 0.08);
    EXPECT_NE(verdict(development).find(response > 0 ? "feeds" : "alleviates"), std::string::npos);
  }
}

TEST(Development, HalfTheChangeGrowsAlike) {
  const Development whole = developed(3e7, 0.05, 8);
  const Development half = developed(3e7, 0.025, 16);
  EXPECT_NEAR(half.real_passages(), whole.real_passages(), 0.05 * whole.real_passages());
  const double growth = at(outcome(whole), 0.08).growth;
  EXPECT_NEAR(at(outcome(half), 0.08).growth, growth, 0.05 * growth);
}

TEST(Development, TablesHoldEveryPassageAndBand) {
  const Development development = developed(3e7, 0.05, 2);
  const auto rows = [](const std::string& text) { return std::count(text.begin(), text.end(), '\n'); };
  EXPECT_EQ(rows(profiles_csv(development)), 1 + 641);
  EXPECT_EQ(rows(spectra_csv(development)), 1 + 2 * 8);
  EXPECT_EQ(rows(growth_csv(development)), 1 + 8);
  EXPECT_TRUE(
      profiles_csv(development).starts_with("x [m],depth_after_0 [m],depth_after_1 [m],depth_after_2 [m]\n"));
}

}  // namespace
}  // namespace tread
