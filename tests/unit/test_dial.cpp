// Measures of curves, front and names of settings of the dial.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "drivers/studies/dial/dial_advice.hpp"
#include "drivers/studies/dial/dial_design.hpp"
#include "drivers/studies/dial/dial_report.hpp"
#include "drivers/studies/dial/dial_table.hpp"
#include "tests/program.hpp"

namespace tread {
namespace {

constexpr double kWave = 0.08;        ///< [m]
constexpr Span kStretch{2.44, 2.92};  ///< six waves
constexpr double kLongest = 0.25 * kWave;

CurvePoints sampled(const std::function<double(double)>& value, double first = 2, double last = 3.3,
                    double step = 0.83e-3) {
  CurvePoints curve;
  for (double x = first; x <= last; x += step) {
    curve.x.push_back(x);
    curve.y.push_back(value(x));
  }
  return curve;
}

double wave(double x) {
  const double phase = 2 * std::numbers::pi * (x - 2.4) / kWave;
  return 87e3 + 50e3 * std::cos(phase) + 12e3 * std::sin(2 * phase);
}

TEST(DialMeasures, ACurveBesideItselfDiffersByNothing) {
  const CurvePoints curve = sampled(wave);
  const auto d = curve_difference(curve, curve, kStretch, kLongest);
  ASSERT_TRUE(d);
  // The parabola through the best shift and its neighbours, 0.25 mm away, differs slightly from the
  // correlation.
  EXPECT_LT(d->error, 1e-6);
  EXPECT_EQ(d->mean, 0);
  EXPECT_EQ(*d->range, 0);
  EXPECT_LT(std::abs(*d->shift), 1e-6);
}

TEST(DialMeasures, AShiftIsFoundAndTakenOut) {
  // True shifts lie between samples of 0.83 mm and between the tried shifts, 0.25 mm apart.
  for (const double shift : {-7.13e-3, -0.4e-3, 0.07e-3, 3.31e-3, 15e-3}) {
    const CurvePoints moved = sampled([shift](double x) { return wave(x - shift); });
    const auto d = curve_difference(moved, sampled(wave), kStretch, kLongest);
    ASSERT_TRUE(d && d->shift) << shift;
    EXPECT_NEAR(*d->shift, shift, 0.02e-3);
    EXPECT_LT(d->error, 2e-3) << shift;
  }
}

TEST(DialMeasures, MeanRangeAndErrorOfAScaledCurve) {
  const CurvePoints reference = sampled(wave);
  const auto larger =
      curve_difference(sampled([](double x) { return 1.1 * wave(x - 2e-3); }), reference, kStretch, kLongest);
  ASSERT_TRUE(larger);
  EXPECT_NEAR(larger->error, 0.1, 1e-3);
  EXPECT_NEAR(*larger->range, 0.1, 1e-3);
  const double deviation = std::sqrt(0.5 * (50e3 * 50e3 + 12e3 * 12e3));
  const double level = std::hypot(87e3, deviation);
  EXPECT_NEAR(*larger->fluctuation, 0.1 * level / deviation, 3e-3);
  EXPECT_NEAR(larger->mean, 0.1 * 87e3 / level, 1e-3);

  const auto lifted =
      curve_difference(sampled([](double x) { return wave(x) + 5e3; }), reference, kStretch, kLongest);
  ASSERT_TRUE(lifted);
  EXPECT_NEAR(lifted->error, 5e3 / level, 1e-4);
  EXPECT_NEAR(lifted->mean, 5e3 / level, 1e-4);
  EXPECT_NEAR(*lifted->range, 0, 1e-9);
}

TEST(DialMeasures, NoPatternNoShift) {
  const CurvePoints reference = sampled(wave);
  const auto flat = curve_difference(sampled([](double) { return 87e3; }), reference, kStretch, kLongest);
  ASSERT_TRUE(flat);
  EXPECT_FALSE(flat->shift);
  EXPECT_NEAR(*flat->range, -1, 1e-12);
  const auto other = curve_difference(sampled([](double x) { return wave(2.4 + 0.37 * (x - 2.4)); }),
                                      reference, kStretch, kLongest);
  ASSERT_TRUE(other);
  EXPECT_FALSE(other->shift);
  EXPECT_GT(other->error, 0.2);
}

TEST(DialMeasures, AsFarAsBothCurvesGo) {
  const CurvePoints reference = sampled(wave);
  const auto half = curve_difference(sampled(wave, 2, 2.8), reference, kStretch, kLongest);
  ASSERT_TRUE(half);
  EXPECT_LT(half->error, 1e-3);
  EXPECT_FALSE(curve_difference(sampled(wave, 2, 2.6), reference, kStretch, kLongest));
  EXPECT_FALSE(curve_difference({}, reference, kStretch, kLongest));
  EXPECT_FALSE(curve_difference(reference, sampled([](double) { return 0.0; }), kStretch, kLongest));
}

/// A run over the smooth stretch with a static F_N of 90 kN, creepage and F_L of this mean [N].
FinishedRun pulled(const samples::Program& program, double force) {
  std::string text = "wheel_x [m],longitudinal_force [N],creepage_mean [-]\n";
  for (double x = 2.4; x < 3; x += 0.01)
    text += fmt::format("{},{},{}\n", x, force + 50 * std::sin(70 * x), 1e-8 * force);
  FinishedRun run;
  run.folder = program.write("histories.csv", text).parent_path();
  run.scene.zone_start = kStretch.first;
  run.scene.zone_length = kStretch.last - kStretch.first;
  run.summary["static_wheel_load_N"] = 90e3;
  return run;
}

/// On a smooth rail the reference fluctuates with its elements alone.
TEST(DialMeasures, ForcesFluctuateOverDepths) {
  const samples::Program program;
  FinishedRun run = pulled(program, 1000);
  const auto fluctuates = [&](std::size_t quantity) {
    return run_difference(run, run, dial_quantities().at(quantity)).value().fluctuation.has_value();
  };
  EXPECT_FALSE(fluctuates(1));
  run.scene.surfaces["dip"] = {};
  EXPECT_TRUE(fluctuates(1));
  EXPECT_FALSE(fluctuates(2));
}

TEST(DialMeasures, FLAndCreepageNeedTraction) {
  const samples::Program program;
  for (const double force : {100.0, 1000.0}) {
    const FinishedRun run = pulled(program, force);
    for (const std::size_t quantity : {1U, 2U})
      EXPECT_EQ(run_difference(run, run, dial_quantities().at(quantity)).has_value(), force > 0.005 * 90e3);
  }
}

/// Brakes turn a wheel back over the stretch that it has passed.
TEST(DialMeasures, AWheelThatTurnsBackIsJudgedByItsFirstPassage) {
  const samples::Program one, other;
  const FinishedRun run = pulled(one, 1000), back = pulled(other, 1000);
  std::ofstream histories(other.folder / "histories.csv", std::ios::app);
  for (double x = 2.98; x > 2; x -= 0.01) histories << fmt::format("{},0,0\n", x);
  histories.close();
  const DialQuantity& force = dial_quantities().at(1);
  const auto expected = run_difference(run, run, force);
  ASSERT_TRUE(expected);
  for (const auto& found : {run_difference(back, run, force), run_difference(run, back, force)}) {
    ASSERT_TRUE(found);
    EXPECT_EQ(found->error, expected->error);
  }
}

/// Errors of two quantities; cost in minutes and element-steps in opposite orders.
DialRow row(const std::string& point, double minutes, double f_n, double work) {
  DialRow r{point, {"scene.element_size=" + point}, 1000 * minutes, 10 / (minutes * minutes), minutes, {}};
  r.differences["F_N"].error = f_n;
  r.differences["work"] = {work, -0.01, {}, 1e-3};
  return r;
}

DialTable table() {
  return {"made up",
          "1mm",
          {row("8mm", 1, 0.2, 0.3), row("6mm", 2, 0.1, 0.4), row("5mm", 3, 0.15, 0.2),
           row("4mm", 5, 0.04, 0.09), row("1mm", 100, 0, 0)}};
}

std::vector<std::string> names(const std::vector<const DialRow*>& rows) {
  std::vector<std::string> list;
  list.reserve(rows.size());
  for (const DialRow* one : rows) list.push_back(one->point);
  return list;
}

using Names = std::vector<std::string>;

TEST(DialTable, TheFrontLeavesOutWhatIsDearerAndFurther) {
  const DialTable t = table();
  EXPECT_EQ(names(pareto_front(t, "F_N", DialCost::minutes)), (Names{"8mm", "6mm", "4mm"}));
  EXPECT_EQ(names(pareto_front(t, "work", DialCost::minutes)), (Names{"8mm", "5mm", "4mm"}));
  EXPECT_EQ(names(pareto_front(t, kAllQuantities, DialCost::minutes)), (Names{"8mm", "5mm", "4mm"}));
  EXPECT_EQ(names(pareto_front(t, "F_N", DialCost::element_steps)), (Names{"4mm"}));
  EXPECT_TRUE(pareto_front(t, "shear", DialCost::minutes).empty());
}

TEST(DialTable, TheCheapestIsNearEnough) {
  const DialTable t = table();
  EXPECT_EQ(cheapest(t, "F_N", 0.2, DialCost::minutes)->point, "8mm");
  EXPECT_EQ(cheapest(t, kAllQuantities, 0.12, DialCost::minutes)->point, "4mm");
  EXPECT_EQ(cheapest(t, "F_N", 0.01, DialCost::minutes), nullptr);
}

TEST(DialTable, NoRowIsNearByLuck) {
  DialTable t = table();
  // 5 mm is further off than 6 mm.
  EXPECT_EQ(cheapest(t, "F_N", 0.12, DialCost::minutes)->point, "4mm");
  // Facets on a mesh that is further off without them.
  t.rows.push_back(row("facets", 3, 0.03, 0.03));
  t.rows.back().settings = {"scene.element_size=5mm", "contact.surface=facets"};
  EXPECT_EQ(cheapest(t, "F_N", 0.12, DialCost::minutes)->point, "4mm");
  EXPECT_EQ(cheapest(t, "F_N", 0.035, DialCost::minutes), nullptr);
  EXPECT_EQ(cheapest(t, "F_N", 0.16, DialCost::minutes)->point, "6mm");
  // A row that was not compared in everything.
  t.rows.back().settings = {"scene.element_size=5mm"};
  t.rows.back().differences.erase("work");
  EXPECT_EQ(cheapest(t, kAllQuantities, 0.12, DialCost::minutes)->point, "4mm");
}

TEST(DialTable, OfAsCheapOnesThePlainestIsNamed) {
  DialTable t = table();
  t.rows.insert(t.rows.begin(), row("double", 4.99, 0.0399, 0.4));
  t.rows.front().settings = {"scene.element_size=4mm", "scene.precision=double"};
  t.rows.front().elements = 5000;
  EXPECT_EQ(cheapest(t, "F_N", 0.12, DialCost::minutes)->point, "4mm");
}

TEST(DialTable, TheFluctuationIsJudgedWhereMeasured) {
  DialTable t = table();
  EXPECT_FALSE(has_fluctuation(t));
  t.rows[3].differences["F_N"].fluctuation = 0.15;
  t = parse_dial(dial_lines(t), "t");
  EXPECT_TRUE(has_fluctuation(t));
  EXPECT_EQ(cheapest(t, "F_N", 0.12, DialCost::minutes), nullptr);
  EXPECT_EQ(cheapest(t, "F_N", 0.16, DialCost::minutes)->point, "6mm");
  EXPECT_EQ(error_table(t).rows[3][3], "4 / 15");
}

TEST(DialTable, LinesAreReadBack) {
  EXPECT_EQ(dial_json({}), "[]\n");
  const DialTable read = parse_dial(dial_lines(table()), "t");
  EXPECT_EQ(read.scene, "made up");
  EXPECT_EQ(read.reference, "1mm");
  ASSERT_EQ(read.rows.size(), 5U);
  EXPECT_EQ(read.rows[1].settings, (Names{"scene.element_size=6mm"}));
  EXPECT_EQ(read.rows[1].differences.at("work").shift, 1e-3);
  EXPECT_FALSE(read.rows[1].differences.at("work").range);
  EXPECT_EQ(dial_csv(read), dial_csv(table()));
  EXPECT_THROW(parse_dial("{\"point\": \"a\"}\n", "t"), InputError);
  EXPECT_THROW(parse_dial("", "t"), InputError);
}

TEST(DialTable, WhatItDoesNotKnowIsRefused) {
  EXPECT_NO_THROW(require_quantity("--quantity", "von_mises"));
  EXPECT_THROW(require_quantity("--quantity", "F_Q"), InputError);
  EXPECT_THROW(dial_cost("hours"), InputError);
}

TEST(DialTable, TheMeasuredTableHasItsReference) {
  const DialTable measured = measured_dial();
  EXPECT_EQ(std::count_if(measured.rows.begin(), measured.rows.end(),
                          [&](const DialRow& one) { return one.point == measured.reference; }),
            1);
  for (const DialRow& one : measured.rows)
    EXPECT_EQ(one.differences.size(), dial_quantities().size()) << one.point;
  // Questions that docs/records/dial.md answers.
  const auto named = [&](const char* quantity, double wanted) {
    return cheapest(measured, quantity, wanted, DialCost::element_steps)->point;
  };
  EXPECT_EQ(named("F_N", 0.02), "5mm");
  EXPECT_EQ(named("F_N", 0.01), "3mm");
  EXPECT_EQ(named("creepage", 0.05), "3mm");
  EXPECT_EQ(named("pressure", 0.2), "3mm");
  EXPECT_EQ(named("pressure", 0.05), "draft");
  EXPECT_EQ(named("von_mises", 0.2), "4mm-rigid-ground");
}

std::optional<Advice> advice_on(const char* scene, const AdviceOptions& options,
                                const std::vector<std::string>& overrides = {}) {
  return advise(resolve_scene(fmt::format("{}/scenes/{}", TREAD_SOURCE_DIR, scene), overrides), options);
}

TEST(DialAdvice, AShippedRowResolvesTheScene) {
  const std::vector<std::string> waves = {"corrugation.kind=sine", "corrugation.wavelength=25 mm",
                                          "corrugation.depth=0.01 mm", "corrugation.start=0.1 m",
                                          "corrugation.length=0.3 m"};
  std::optional<Advice> advice = advice_on("tyre.toml", {"5%", "F_N"});
  ASSERT_TRUE(advice && advice->row);
  EXPECT_EQ(advice->row->point, "4mm") << "2.1 elements of 5 mm lie across the patch";
  EXPECT_TRUE(samples::has(advice_text(*advice), "; shares of the mean, static load included"));
  advice = advice_on("tyre.toml", {"20%", "von_mises"});
  ASSERT_TRUE(advice && advice->row);
  EXPECT_EQ(advice->row->point, "draft") << "3.5 elements of 3 mm lie across the patch";
  advice = advice_on("tyre.toml", {"5%", "F_N"}, waves);
  ASSERT_TRUE(advice && advice->row);
  EXPECT_EQ(advice->row->point, "draft") << "8.3 elements of 3 mm lie in a wave";
  EXPECT_THROW(advice_on("tyre.toml", {"5%", "F_N", {}, "minutes"}), InputError);
}

/// Tyres have no slab to leave out. Rows of one's own keep their warnings.
TEST(DialAdvice, ASettingThatChangesNothingIsNotNamed) {
  const samples::Program program;
  DialTable one = table();
  one.rows.insert(one.rows.begin() + 3, row("ground", 6, 0.04, 0.09));
  one.rows[3].settings = {"scene.element_size=8 mm", "slab.present=false"};
  one.rows[4].settings = {"scene.element_size=8 mm"};
  const AdviceOptions options{"5%", "F_N", program.write("dial.jsonl", dial_lines(one))};
  const std::optional<Advice> advice = advice_on("tyre.toml", options);
  ASSERT_TRUE(advice && advice->row);
  EXPECT_EQ(advice->row->point, "4mm");
  EXPECT_TRUE(samples::has(advice_text(*advice), "warning: the contact patch has 1.3 elements across"));
}

TEST(DialAdvice, ASettingThatTheSceneStatesAlreadyIsNamed) {
  const samples::Program program;
  DialTable one{
      "made up", "1mm", {row("base", 2, 0.01, 0.01), row("6mm", 1, 0.05, 0.05), row("1mm", 100, 0, 0)}};
  one.rows[0].settings.clear();
  one.rows[1].settings = {"scene.element_size=6 mm"};
  const AdviceOptions options{"6%", "F_N", program.write("dial.jsonl", dial_lines(one)), "minutes"};
  for (const char* stated : {"scene.element_size=6 mm", "scene.element_size=3 mm"}) {
    const std::optional<Advice> advice = advice_on("tyre.toml", options, {stated});
    ASSERT_TRUE(advice && advice->row);
    EXPECT_EQ(advice->row->point, "6mm") << stated;
  }
}

/// 40 mm, which the user has not stated, do not fit into the block.
TEST(DialAdvice, ASettingThatNoMeshTakesHasNoCost) {
  const samples::Program program;
  DialTable one = table();
  one.rows.front().settings = {"scene.element_size=40 mm"};
  const AdviceOptions options{"25%", "F_N", program.write("dial.jsonl", dial_lines(one)), "minutes"};
  const std::optional<Advice> advice = advice_on("tyre.toml", options);
  ASSERT_TRUE(advice && advice->row);
  EXPECT_EQ(advice->row->point, "8mm");
  EXPECT_FALSE(advice->cost);
  const std::string text = advice_text(*advice);
  EXPECT_TRUE(samples::has(text, "--set \"scene.element_size=40 mm\"")) << text;
  EXPECT_TRUE(samples::has(text, "this scene with it: --set: scene.element_size = 40 mm: ")) << text;
}

TEST(DialReport, EveryQuantityHasAPanel) {
  const Scatter picture = dial_picture(table(), DialCost::minutes);
  EXPECT_EQ(picture.panels.size(), dial_quantities().size() + 1);
  EXPECT_EQ(picture.panels[0].dots.size(), 4U);
  EXPECT_EQ(picture.panels[0].dots.back().label, "4mm");
  EXPECT_TRUE(picture.panels[0].dots.back().marked);
  EXPECT_NEAR(picture.panels[0].dots.back().y, 4, 1e-12);
  const std::string svg = scatter_svg(picture);
  EXPECT_TRUE(samples::has(svg, "4mm</text>"));
  EXPECT_FALSE(samples::has(svg, "nan"));
}

TEST(DialReport, CellsOfATableInPerCentAreNumbers) {
  const Table errors = error_table(table());
  EXPECT_EQ(errors.rows[0][3], "20");
  for (const std::vector<std::string>& row : errors.rows)
    for (const std::string& cell : row) EXPECT_EQ(cell.find('%'), std::string::npos) << cell;
}

TEST(DialReport, EveryTableHasItsTitleInMarkdown) {
  DialOutcome outcome{table(), {}, {}, DialCost::minutes};
  const std::string text = dial_markdown(outcome);
  EXPECT_TRUE(samples::has(text, "Error [%]:\n\n| Point |")) << text;
  EXPECT_TRUE(samples::has(text, "\n\nCheapest for an error:\n\n| Wanted error |"));
  EXPECT_FALSE(samples::has(text, "Difference from"));
  outcome.effects = table();
  EXPECT_TRUE(samples::has(dial_markdown(outcome), "Difference from 1mm [%]:"));
}

class DialDesigns : public testing::Test {
 protected:
  static std::string scene() { return std::string(TREAD_SOURCE_DIR) + "/scenes/corrugation-d.toml"; }
  static Names points(const DialAxes& axes) {
    Names list;
    for (const StudyPoint& point : design_dial(scene(), axes).study.points) list.push_back(point.name);
    return list;
  }
};

TEST_F(DialDesigns, OneKeyAtATimeAboutTheBase) {
  const DialAxes axes{{"scene.element_size=6 mm", "scene.precision=single"},
                      {"scene.element_size=8 mm,6 mm", "scene.quality=draft", "motion.start=rigid"}};
  EXPECT_EQ(points(axes),
            (Names{"element_size=6mm,precision=single", "element_size=8mm", "quality=draft", "start=rigid"}));
  const Study study = design_dial(scene(), axes).study;
  // The base's element size does not hide a quality.
  ASSERT_EQ(study.points[2].own.size(), 1U);
  EXPECT_EQ(study.points[2].own[0].as_override(), "scene.precision=single");
  EXPECT_EQ(study.points[3].own.size(), 2U);
}

TEST_F(DialDesigns, TheUsualAxesSuitTheScene) {
  const Names usual = points({});
  for (const char* name :
       {"element_size=5mm", "element_size=8mm", "quality=paper", "precision=single", "penetration_ratio=0.05",
        "step_safety=0.5", "surface=facets", "start=rigid", "present=false"})
    EXPECT_EQ(std::count(usual.begin(), usual.end(), name), 1) << name;
  const auto axes = default_axes(read_scene(std::string(TREAD_SOURCE_DIR) + "/scenes/tyre.toml"));
  EXPECT_EQ(std::count(axes.begin(), axes.end(), "scene.element_size=2.2 mm,1.6 mm,1.1 mm"), 1);
  EXPECT_EQ(std::count(axes.begin(), axes.end(), "slab.present=false"), 0);
}

TEST_F(DialDesigns, WhatDoesNotReadIsRefused) {
  EXPECT_THROW(points({{}, {"motion.start"}}), InputError);
  EXPECT_THROW(points({{}, {"motion.start=rigid,"}}), InputError);
  EXPECT_THROW(points({{"=5 mm"}, {}}), InputError);
  EXPECT_THROW(points({{}, {"load.wheel_load=40 kN"}}), InputError);
  EXPECT_NO_THROW(points({{"load.wheel_load=40 kN"}, {"motion.start=rigid"}}));
  const samples::Program program;
  const auto study = program.write("study.toml", "[study]\nscene = \"" + scene() +
                                                     "\"\n[[point]]\nname = \"a\"\nscene.element_size = "
                                                     "\"6 mm\"\n");
  EXPECT_EQ(design_dial(study, {}).study.points.size(), 1U);
  EXPECT_EQ(design_dial(study, {}).base, "");
  EXPECT_THROW(design_dial(study, {{}, {"motion.start=rigid"}}), InputError);
  const auto speeds = program.write("speeds.toml", "[study]\nscene = \"" + scene() +
                                                       "\"\n[grid]\nmotion.speed = [\"200 km/h\", "
                                                       "\"250 km/h\"]\n");
  EXPECT_THROW(design_dial(speeds, {}), InputError);
  EXPECT_NO_THROW(design_dial(std::string(TREAD_SOURCE_DIR) + "/docs/records/dial/corrugation-d.toml", {}));
}

}  // namespace
}  // namespace tread
