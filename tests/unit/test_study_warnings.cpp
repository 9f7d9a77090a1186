// Warnings of a study's runs, and the curves of its trends.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "drivers/studies/study/study_figures.hpp"
#include "drivers/studies/study/study_report.hpp"
#include "tests/temporary_folder.hpp"
#include "tests/tyre_scene.hpp"

namespace tread {
namespace {

FinishedRun run_with(const std::string& label, const std::string& summary) {
  return {label, {}, {}, parse_json(summary, label)};
}

TEST(StudyWarnings, EachIsListedOnceWithItsPoints) {
  const std::vector<FinishedRun> runs = {run_with("a", R"({"warnings": ["short", "coarse"]})"),
                                         run_with("b", R"({"warnings": []})"),
                                         run_with("c", R"({"warnings": ["coarse"]})")};
  const std::vector<std::vector<std::string>> rows = {{"a", "short"}, {"a; c", "coarse"}};
  EXPECT_EQ(warning_table(runs).rows, rows);
}

TEST(StudyCurves, BrakesHaveTheirLimitBelow) {
  const samples::TemporaryFolder folder;
  std::ofstream(folder.path / "histories.csv")
      << "wheel_x [m],vertical_force [N],longitudinal_force [N]\n0,80000,-30000\n0.1,80000,-30000\n";
  FinishedRun run =
      run_with("a", R"({"vertical_force_N": {"mean": 80e3}, "longitudinal_force_N": {"mean": -30e3}})");
  run.folder = folder.path;
  run.scene = samples::tyre_scene();
  CurvesSpec spec{.title = "",
                  .panels = {{"Force [kN]", {.y = {"longitudinal_force", "N"}, .y_scale = 1e-3}}}};
  spec.panels.front().limit = true;
  const Series limit = curves_figure(spec, {run}).panels.front().series.back();
  EXPECT_EQ(limit.label, "−f F_N, a");
  EXPECT_EQ(limit.y, (std::vector<double>{-40, -40}));
}

TEST(StudyCurves, AWheelThatTurnsBackIsDrawnWholeAndItsFirstPassageTabled) {
  const samples::TemporaryFolder folder;
  std::ofstream(folder.path / "histories.csv")
      << "wheel_x [m],vertical_force [N]\n0,1\n0.1,2\n0.2,3\n0.1,9\n-0.1,9\n";
  FinishedRun run = run_with("a", "{}");
  run.folder = folder.path;
  run.scene = samples::tyre_scene();
  const CurvesSpec spec{
      .title = "", .panels = {{"Force [N]", {.y = {"vertical_force", "N"}}}}, .whole_way = true};
  const Figure figure = curves_figure(spec, {run});
  EXPECT_EQ(figure.panels.front().series.front().x.size(), 5U);
  EXPECT_EQ(figure.x_range, (Range{-0.1, 0.2}));
  EXPECT_TRUE(figure_csv(figure).ends_with("\n0,1\n0.1,2\n0.2,3\n")) << figure_csv(figure);
}

TEST(StudyTrends, AColourAGroupAndAStrokeAResult) {
  const FinishedRun run = run_with("a", R"({"vertical_force_N": {"max": 3, "mean": 2, "min": 1}})");
  const Figure figure = trend_figure("", "", fluctuation_panels(), {{&run, 0, "dry"}, {&run, 0, "wet"}});
  ASSERT_EQ(figure.panels.size(), 1U);
  ASSERT_EQ(figure.panels[0].series.size(), 6U);
  const std::vector<Stroke> strokes = {Stroke::dashed, Stroke::solid, Stroke::dotted};
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(figure.panels[0].series[i].colour, static_cast<int>(i / 3)) << i;
    EXPECT_EQ(figure.panels[0].series[i].stroke, strokes[i % 3]) << i;
  }
}

TEST(StudyResults, SayWhetherTheyAreSteadyAndWhole) {
  const FinishedRun run = run_with("a", R"({"steps": 1, "passed": false, "traction_steady": true})");
  const Table table = result_table({run});
  const auto shown = [&](const char* title) {
    for (std::size_t i = 0; i < table.columns.size(); ++i)
      if (table.columns[i].title == title) return table.rows.front()[i];
    return std::string();
  };
  EXPECT_EQ(shown("Passed"), "no");
  EXPECT_EQ(shown("Steady"), "yes");
}

/// Its forces are those over the smooth rail before the corrugation.
TEST(StudyResults, ARunThatHasNotReachedItsCorrugationHasNone) {
  const samples::TemporaryFolder folder;
  const Scene scene = samples::tyre_scene({"solution_zone.length=200 mm", "corrugation.start=0.13 m",
                                           "corrugation.length=60 mm", "corrugation.wavelength=20 mm"});
  const auto run = [&](double last) {
    std::ofstream(folder.path / "summary.json") << fmt::format(
        "{{\"evaluated_x_m\": [0.0, {}], \"vertical_force_N\": {{\"max\": 3}}, "
        "\"creepage_percent\": 0.3}}",
        last);
    return read_finished_run(folder.path, scene, "a");
  };
  const FinishedRun before = run(0.1), over = run(0.15);
  EXPECT_EQ(over.result("vertical_force_N.max"), 3);
  EXPECT_EQ(before.number("vertical_force_N.max"), 3);
  EXPECT_EQ(before.result("vertical_force_N.max"), std::nullopt);
  EXPECT_EQ(before.result("creepage_percent"), 0.3);
  const std::vector<TrendRun> runs = {{&before, 0, ""}, {&over, 1, ""}};
  const Figure figure = trend_figure("", "", fluctuation_panels(), runs);
  ASSERT_EQ(figure.panels.size(), 1U);
  EXPECT_EQ(figure.panels[0].series[0].x, std::vector<double>{1});
}

}  // namespace
}  // namespace tread
