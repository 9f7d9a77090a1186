// Warnings of a study's runs, and the curves of its trends.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "drivers/studies/study/study_figures.hpp"
#include "drivers/studies/study/study_report.hpp"

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

}  // namespace
}  // namespace tread
