// A force curve from elsewhere beside that of a run. [drivers/studies/compare]

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include "drivers/studies/compare/curve_comparison.hpp"
#include "io/scene/problems.hpp"
#include "tests/refusal.hpp"
#include "tests/temporary_folder.hpp"

namespace tread {
namespace {

constexpr double kWave = 0.08;   // [m]
constexpr double kSpeed = 80.0;  // [m/s]

/// A run over 0.5 m whose F_N swings by 10 kN about 80 kN over a sine; peaks lead the crests by `lead` [rad].
TransientRun run(double lead = 0) {
  TransientRun r;
  r.directory = "run";
  r.scene.corrugation.emplace();
  r.scene.corrugation->wavelength = kWave;
  r.scene.corrugation->start = 0.05;
  r.scene.corrugation->length = 0.4;
  for (int i = 0; i <= 500; ++i) {
    const double x = 1e-3 * i;
    r.time.push_back(x / kSpeed);
    r.x.push_back(x);
    // Crests of the surface lie whole waves after its start.
    r.force.push_back(80e3 + 10e3 * std::cos(2 * std::numbers::pi * (x - 0.05) / kWave + lead));
  }
  return r;
}

ForceCurve curve_of(const TransientRun& r, double more = 0) {
  ForceCurve curve{"curve.txt", false, r.x, r.force};
  for (double& force : curve.force) force += more;
  return curve;
}

std::string written(const samples::TemporaryFolder& folder, const std::string& text) {
  const std::string path = folder.path / "curve.txt";
  std::ofstream(path) << text;
  return path;
}

TEST(CurveComparison, FindsAConstantDifference) {
  const CurveComparison c = compare(run(), curve_of(run(), 3e3), {});
  EXPECT_EQ(c.x.size(), 501U);
  EXPECT_NEAR(c.misfit, 3e3, 1e-6);
  EXPECT_NEAR(c.of_curve.max - c.of_run.max, 3e3, 1e-6);
  EXPECT_NEAR(*c.correlation, 1, 1e-12);
}

TEST(CurveComparison, FindsTheShiftOfPeaks) {
  const CurveComparison c = compare(run(), curve_of(run(0.5)), {});
  ASSERT_TRUE(c.run_shift && c.curve_shift);
  EXPECT_NEAR(*c.run_shift, 0, 2e-2);
  EXPECT_NEAR(*c.curve_shift - *c.run_shift, 0.5, 0.05);  // samples stand 0.08 rad apart
}

/// Single peaks near the troughs lie half a wave before or after the crest.
TEST(CurveComparison, ShiftsNearATroughAreOneDirection) {
  for (const double lead : {0.97 * std::numbers::pi, -0.97 * std::numbers::pi}) {
    TransientRun r = run(lead);
    for (std::size_t i = 0; i < r.x.size(); ++i)
      r.force[i] += 3e3 * std::cos(2 * std::numbers::pi * r.x[i] / 0.3);
    const CurveComparison c = compare(r, curve_of(run(0.5)), {});
    ASSERT_TRUE(c.run_shift);
    EXPECT_NEAR(std::remainder(*c.run_shift - lead, 2 * std::numbers::pi), 0, 0.1);
  }
}

/// F_L of a wheel that brakes has its peaks where it is least.
TEST(CurveComparison, PeaksOfNegativeForcesAreThoseOfTheirSize) {
  TransientRun braking = run(0.5);
  for (double& force : braking.force) force = -force;
  const CurveComparison c = compare(braking, curve_of(run(0.5)), {});
  ASSERT_TRUE(c.run_shift && c.curve_shift);
  EXPECT_EQ(*c.run_shift, *c.curve_shift);
}

TEST(CurveComparison, ASmoothRailHasNoCrests) {
  TransientRun smooth = run();
  smooth.scene.corrugation.reset();
  const CurveComparison c = compare(smooth, curve_of(smooth), {});
  EXPECT_FALSE(c.run_shift || c.curve_shift);
}

TEST(CurveComparison, TimesBecomePlaces) {
  ForceCurve curve = curve_of(run(), 1e3);
  for (double& at : curve.at) at /= kSpeed;
  curve.over_time = true;
  EXPECT_NEAR(compare(run(), curve, {}).misfit, 1e3, 1e-6);
}

TEST(CurveComparison, KeepsToTheStatedStretch) {
  const CurveComparison c = compare(run(), curve_of(run()), {0, 0.1, 0.2});
  EXPECT_EQ(c.x.size(), 101U);
  EXPECT_NEAR(c.x.front(), 0.1, 1e-12);
  EXPECT_NEAR(c.x.back(), 0.2, 1e-12);
}

TEST(CurveComparison, MeansOverAWaveAreConstant) {
  const CurveComparison c = compare(run(), curve_of(run()), {kWave, {}, {}});
  EXPECT_NEAR(c.of_run.range(), 0, 10);
  EXPECT_NEAR(c.x.front(), 0.5 * kWave, 1e-3);
}

TEST(CurveComparison, RefusesCurvesWithoutCommonPlaces) {
  ForceCurve curve = curve_of(run());
  for (double& at : curve.at) at += 10;
  const std::string text = samples::refusal<InputError>([&] { compare(run(), curve, {}); });
  samples::expect_part(text, "covers 10 to 10.5 m");
  samples::expect_part(text, "--offset");
}

TEST(MeanAbout, IsExactForAPolygon) {
  const std::vector<double> x = {0, 1, 2};
  const std::vector<double> y = {0, 2, 2};
  EXPECT_DOUBLE_EQ(mean_about(x, y, 1, 1), (0.5 * 1.5 + 0.5 * 2) / 1);
  EXPECT_DOUBLE_EQ(mean_about(x, y, 0.25, 0), 0.5);
  EXPECT_DOUBLE_EQ(mean_about(x, y, 1.5, 1), 2);
  EXPECT_TRUE(std::isnan(mean_about(x, y, 0.25, 1)));
}

TEST(ForceCurves, AreReadOverWayAndTime) {
  const samples::TemporaryFolder folder;
  const ForceCurve way = read_force_curve(written(folder, "# x [mm]  F_N [kN]\n1 80\n2, 90\n"), "F_N", "1 m");
  EXPECT_FALSE(way.over_time);
  EXPECT_DOUBLE_EQ(way.at[1], 1.002);
  EXPECT_DOUBLE_EQ(way.force[1], 90e3);
  const ForceCurve time = read_force_curve(written(folder, "# t [ms]  F_N [N]\n1 80\n2 90\n"), "F_N", "");
  EXPECT_TRUE(time.over_time);
  EXPECT_DOUBLE_EQ(time.at[0], 1e-3);
  EXPECT_DOUBLE_EQ(time.force[0], 80);
}

TEST(ForceCurves, NeedUnitsOfAWayAndAForce) {
  const samples::TemporaryFolder folder;
  const auto message = [&](const std::string& text, const std::string& force = "F_N") {
    try {
      read_force_curve(written(folder, text), force, "");
    } catch (const ProblemsError& error) {
      return error.problems.at(0).message;
    }
    return std::string();
  };
  EXPECT_NE(message("1 2\n3 4\n").find("\"# x [m]  F_N [kN]\""), std::string::npos);
  EXPECT_NE(message("# x [m] F [mm]\n1 2\n3 4\n").find("[mm] is not a force"), std::string::npos);
  EXPECT_NE(message("# x [kg] F [N]\n1 2\n3 4\n").find("or a time"), std::string::npos);
  EXPECT_NE(message("# x [m] F [N]\n1 2\n1 4\n").find("must grow"), std::string::npos);
  for (const std::string& force : {std::string("F_N"), std::string("F_L")}) {
    EXPECT_EQ(message("# x [m] " + force + " [N]\n1 2\n3 4\n", force), "");
    EXPECT_EQ(message("# x [m] pull [N]\n1 2\n3 4\n", force), "");
  }
  EXPECT_EQ(message("# x [m] f_n [N]\n1 2\n3 4\n", "F_L"),
            "the file holds F_N, the run's F_L is compared; state --force F_N");
  EXPECT_EQ(message("# x [m] F_L [N]\n# [m] [N]\n1 2\n3 4\n"),
            "the file holds F_L, the run's F_N is compared; state --force F_L");
  EXPECT_NE(message("# F_L [N] x [m]\n1 2\n3 4\n").find("named F_L, x; expected x, F_N in this order"),
            std::string::npos);
}

}  // namespace
}  // namespace tread
