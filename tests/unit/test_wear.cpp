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
#include "drivers/studies/develop/passage_room.hpp"
#include "io/scene/scene_reader.hpp"

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
    EXPECT_GT(band.coherence.value_or(0), 0.99);
  }
}

/// Number of the depth at x [m].
std::size_t place_of(double x) {
  return static_cast<std::size_t>(std::lround((x - kStart) / 1e-3));
}

/// A rail whose work follows its depth by `response` [J/m3], after some passages.
Development developed(double response, double change, int passages) {
  Development development;
  const auto roughness = [](double x) {
    return end_taper(x - kStart, kLength, 0.08) * (2e-6 * wave(x, 0.08) + 1e-6 * wave(x, 0.05, 2.0));
  };
  development.plan = {kPerWork, change, kBand, profile_of(roughness)};
  development.profile = development.plan.start;
  development.smooth.mean = work_of([](double, int i) { return kMean + 50 * (i % 3); });
  for (int k = 0; k < passages; ++k) {
    const WornProfile& profile = development.profile;
    SurfaceWork work = development.smooth;
    for (std::size_t i = 0; i < work.mean.x.size(); ++i)
      work.mean.work[i] += response * profile.depth[place_of(work.mean.x[i])];
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

/// Outcomes of a passage over a stretch of 160 mm, whose ends fade.
std::vector<BandOutcome> outcome_of_short(auto depth, auto uneven) {
  Development development;
  WornProfile profile{kStart, 1e-3, {}};
  for (int i = 0; i <= 160; ++i) profile.depth.push_back(depth(kStart + 1e-3 * i));
  development.plan = {kPerWork, 0.05, kBand, profile};
  development.profile = profile;
  development.smooth.mean = work_of([](double, int) { return kMean; });
  SurfaceWork work = development.smooth;
  for (std::size_t i = 0; i < work.mean.x.size(); ++i) work.mean.work[i] += uneven(work.mean.x[i]);
  development.add(work);
  return outcome(development);
}

/// The bands beside hold what the taper makes of the one wave.
TEST(Development, AWaveThatIsNotInTheProfileTellsNothing) {
  for (const double wavelength : {0.08, 0.0533, 0.07}) {
    const std::vector<BandOutcome> bands =
        outcome_of_short([&](double x) { return 1e-6 * wave(x, wavelength); },
                         [&](double x) { return 50 * wave(x, wavelength); });
    EXPECT_EQ(std::ranges::count_if(bands, &BandOutcome::telling), 1) << wavelength;
    EXPECT_EQ(at(bands, wavelength == 0.0533 ? 0.05 : 0.08).telling, true) << wavelength;
    for (const BandOutcome& band : bands) EXPECT_FALSE(band.coherence) << "of one line " << band.wavelength;
  }
}

/// Both waves are in the profile. The taper leaks work over the short ones into the band of the long ones.
TEST(Development, WorkThatLeaksFromAnotherBandTellsNothing) {
  const auto long_waves_tell = [](double work) {
    const std::vector<BandOutcome> bands =
        outcome_of_short([](double x) { return 1e-6 * wave(x, 0.08) - 0.8e-6 * wave(x, 0.04); },
                         [&](double x) { return work * wave(x, 0.08) - 40 * wave(x, 0.04); });
    EXPECT_TRUE(at(bands, 0.04).telling) << work;
    return at(bands, 0.08).telling;
  };
  EXPECT_TRUE(long_waves_tell(50));
  EXPECT_FALSE(long_waves_tell(0));
}

TEST(Development, AShortApproachLeavesLittleRoomAndSaysSo) {
  const auto resolved = [](const std::vector<std::string>& more) {
    std::vector<std::string> all = {"scene.element_size=8 mm",  "corrugation.wavelength=36 mm",
                                    "corrugation.start=0.1 m",  "corrugation.length=72 mm",
                                    "corrugation.depth=0.1 mm", "corrugation.apply=gap",
                                    "wear.shortest=32 mm",      "wear.longest=72 mm"};
    all.insert(all.end(), more.begin(), more.end());
    return resolve_scene(std::string(TREAD_SOURCE_DIR) + "/scenes/tyre.toml", all);
  };
  const ResolvedScene near = resolved({});
  EXPECT_EQ(short_room(near.scene, room_of_passage0(near, 1), 1), "");
  const double room = room_of_passage0(near, 100);
  EXPECT_DOUBLE_EQ(room, 0.2e-3);
  const std::string said = short_room(near.scene, room, 100);
  EXPECT_NE(said.find("room for a corrugation of 0.2 mm"), std::string::npos) << said;
  EXPECT_NE(said.find("a later solution_zone.start leaves more room"), std::string::npos) << said;
  const Scene far = resolved({"motion.run_up=0.1 m"}).scene;
  EXPECT_NE(short_room(far, room, 100).find("a longer motion.run_up leaves"), std::string::npos);
}

TEST(Development, TheProfileShowsTheShortestWaves) {
  Scene scene = read_scene(
      std::string(TREAD_SOURCE_DIR) + "/scenes/tyre.toml",
      {"scene.element_size=1 mm", "corrugation.wavelength=72 mm", "corrugation.start=0.1 m",
       "corrugation.length=72 mm", "corrugation.apply=gap", "wear.shortest=32 mm", "wear.longest=72 mm"});
  const auto spacing = [&] { return wear_plan(scene).start.spacing; };
  EXPECT_EQ(wear_plan(scene).start.depth.size(), 73U);
  EXPECT_DOUBLE_EQ(spacing(), 1e-3);
  scene.wear->shortest = 4e-3;
  EXPECT_NEAR(spacing(), 0.4e-3, 1e-12);
  scene.corrugation->wavelength = 2e-3;
  EXPECT_NEAR(spacing(), 0.2e-3, 1e-12);
  scene.corrugation->wavelength = 0.1e-3;  // the mesh does not show it
  EXPECT_NEAR(spacing(), 0.1e-3, 1e-12);
  scene.corrugation->kind = "table";
  for (int i = 0; i <= 240; ++i) {
    scene.corrugation->table_x.push_back(0.3e-3 * i);
    scene.corrugation->table_depth.push_back(1e-6 * (i % 3));
  }
  const WornProfile table = wear_plan(scene).start;
  ASSERT_EQ(table.depth.size(), 241U);
  EXPECT_NEAR(table.depth[2], 2e-6, 1e-12);
}

/// Rows 1 mm apart; the work falls to either side of the middle one.
SurfaceWork work_of_rows() {
  SurfaceWork work;
  work.mean = work_of([](double, int) { return 0.0; });
  for (const double share : {0.3, 0.7, 1.0, 0.7, 0.3})
    work.rows.push_back({1e-3 * (static_cast<double>(work.rows.size()) - 2), 1e-3, 0,
                         work_of([&](double, int i) { return share * (kMean + 50 * (i % 3)); }).work});
  work.average();
  return work;
}

CorrugationSpec wave_spec() {
  CorrugationSpec spec;
  spec.start = kStart;
  spec.length = kLength;
  spec.centre = 0;
  return spec;
}

/// Waves of 80 mm over rows that wear by themselves, before the first passage.
Development begun_rows(double change, double reach) {
  Development development;
  const Corrugation waves({0.08, 0.14e-3}, kStart, kLength, 0, 0.03);
  development.plan = {kPerWork, change, kBand, profile_of([&](double x) { return waves.depth(x, 0); }),
                      reach};
  development.begin(work_of_rows(), wave_spec());
  return development;
}

/// One passage with work by row in proportion to depth, response and the row's part, and `noise` [J/m2] of
/// rows that alternate.
Development developed_rows(double response, double noise, double reach) {
  Development development = begun_rows(0.05, reach);
  SurfaceWork work = work_of_rows();
  for (std::size_t j = 0; j < work.rows.size(); ++j)
    for (std::size_t i = 0; i < work.mean.x.size(); ++i) {
      const double x = work.mean.x[i];
      work.rows[j].work[i] +=
          work.rows[j].work[i] / kMean * response * development.rows->depth[j][place_of(x)] +
          (j % 2 == 0 ? 1 : -1) * noise * wave(x, 0.08);
    }
  work.average();
  development.add(work);
  return development;
}

/// Part of the wave of 80 mm in a row's change.
double change_of(const Development& before, const Development& after, std::size_t row) {
  double sum = 0;
  const WornProfile& profile = after.profile;
  for (std::size_t i = 0; i < profile.depth.size(); ++i)
    sum -= (after.rows->depth[row][i] - before.rows->depth[row][i]) * wave(profile.x(i), 0.08);
  return 2 * sum / static_cast<double>(profile.depth.size());
}

TEST(Development, EachRowWearsByItsOwnWork) {
  const Development before = begun_rows(0.05, 1e-4);
  EXPECT_EQ(before.rows->y, (std::vector<double>{-2e-3, -1e-3, 0, 1e-3, 2e-3}));
  EXPECT_NEAR(before.rows->share[2], 1.0 / 3, 1e-12);
  const Development after = developed_rows(3e7, 0, 1e-4);
  const double middle = change_of(before, after, 2);
  EXPECT_GT(middle, 0);
  EXPECT_NEAR(change_of(before, after, 1), 0.7 * middle, 0.01 * middle);
  EXPECT_NEAR(change_of(before, after, 4), 0.3 * middle, 0.01 * middle);
  // The largest change is 5 % of the range of all rows.
  EXPECT_NEAR(range_of_rows(before.rows->depth), 0.14e-3, 1e-9);
  double most = 0;
  for (std::size_t i = 0; i < after.profile.depth.size(); ++i)
    most = std::max(most, std::abs(after.rows->depth[2][i] - before.rows->depth[2][i]));
  EXPECT_NEAR(most, 0.5 * 0.05 * 0.14e-3, 0.1 * most);
}

TEST(Development, RowsThatAlternateAreNoise) {
  const Development before = developed_rows(3e7, 0, 2e-3);
  const Development after = developed_rows(3e7, 400, 2e-3);
  for (const std::size_t row : {1U, 2U, 3U})
    EXPECT_NEAR(change_of(before, after, row), 0, 1e-3 * 0.07e-3 * 0.05) << row;
}

/// Work of the middle row also wears the rows beside it, and counts by the shares over the smooth rail.
TEST(Development, TheMeanOfTheRowsGrowsAsItsWorkSays) {
  Development development = begun_rows(0.005, 2e-3);
  SurfaceWork work = work_of_rows();
  for (std::size_t i = 0; i < work.mean.x.size(); ++i)
    work.rows[2].work[i] += 3e7 * development.rows->depth[2][place_of(work.mean.x[i])];
  work.average();
  development.add(work);
  const BandOutcome band = at(outcome(development), 0.08);
  EXPECT_TRUE(band.telling);
  const double growth = kPerWork * 3e7 * (0.5 * 1.0 + 0.25 * 2 * 0.7) / 3;
  EXPECT_NEAR(band.first_growth, growth, 0.02 * growth);
  EXPECT_NEAR(band.growth, growth, 0.1 * growth);
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
