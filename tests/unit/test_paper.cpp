// The paper's figures as data, and measures of curves.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <numbers>
#include <set>
#include <string>

#include "drivers/report/report_references.hpp"
#include "drivers/studies/paper/curve_measures.hpp"
#include "drivers/studies/paper/drawn_figure.hpp"
#include "drivers/studies/paper/paper_figures.hpp"
#include "drivers/studies/paper/paper_numbers.hpp"
#include "drivers/studies/paper/paper_verdicts.hpp"
#include "drivers/studies/study/study_plan.hpp"
#include "drivers/studies/study/study_report.hpp"
#include "io/text/json.hpp"
#include "tests/program.hpp"

namespace tread {
namespace {

constexpr double kPi = std::numbers::pi;

/// A finished run whose curves are formulas.
class MadeUpRun : public testing::Test {
 protected:
  using Formula = std::function<double(double)>;

  /// Writes histories over 0 ... 3.05 m at 300 km/h, one row per millimetre.
  void write_histories(const Formula& vertical, const Formula& longitudinal) const {
    std::string text = "time [s],wheel_x [m],vertical_force [N],longitudinal_force [N]\n";
    for (int i = 0; i <= 3050; ++i) {
      const double x = 1e-3 * i;
      text += fmt::format("{:.9g},{:.9g},{:.9g},{:.9g}\n", x / kSpeed, x, vertical(x), longitudinal(x));
    }
    program_.write("histories.csv", text);
  }
  FinishedRun run(const Passage& passage) const {
    Study study;
    study.name = "test";
    study.scene = program_.folder / "scene.toml";
    study.scene_text = paper_scene();
    study.points = {study_point(passage)};
    program_.write("summary.json", fmt::format("{{\"static_wheel_load_N\": {}}}", kLoad));
    const StudyPlan plan = plan_study(study, program_.folder);
    return read_finished_run(program_.folder, plan.points.front().resolved.scene, "made up");
  }
  /// Judges conclusion 3 of a run over corrugation D whose steady creepage of 0.2 % counts from `steady_from`
  /// [m].
  Judgement judge_creepage(const Formula& at_node, double steady_from) const {
    std::string text = "time [s],wheel_x [m],vertical_force [N],creepage_node [-],creepage_mean [-]\n";
    for (int i = 0; i <= 3050; ++i) {
      const double x = 1e-3 * i;
      text += fmt::format("{:.9g},{:.9g},{:.9g},{:.9g},0.003\n", x / kSpeed, x, wave(0)(x), at_node(x));
    }
    program_.write("histories.csv", text);
    FinishedRun d = run(corrugated());
    d.summary = parse_json(fmt::format("{{\"steady_x_m\": [{}, 2.38], \"evaluated_x_m\": [2.44, 2.92], "
                                       "\"creepage_percent\": 0.2, \"full_slip_share\": 0.1}}",
                                       steady_from),
                           "summary");
    PassageRuns runs;
    runs.add(corrugated(), d);
    return paper_conclusions()[2].judge(runs);
  }
  static Formula constant(double value) {
    return [value](double) { return value; };
  }
  /// Wave with its peaks `shift` [rad] before the crests.
  static Formula wave(double shift) {
    return [shift](double x) { return kLoad + 5e4 * std::cos(2 * kPi * (x - 2.4) / 0.08 + shift); };
  }

  static constexpr double kSpeed = 300 / 3.6;  ///< [m/s]
  static constexpr double kLoad = 87564;       ///< [N]
  samples::Program program_;
};

TEST_F(MadeUpRun, APatternHasItsShareAndShift) {
  write_histories(wave(0.4), constant(0));
  const FinishedRun d = run(corrugated());
  const auto pattern = wave_pattern(d, history_over_way(d, "vertical_force", "N"));
  ASSERT_TRUE(pattern);
  EXPECT_NEAR(pattern->share, 1, 1e-3);
  EXPECT_NEAR(pattern->shift, 0.4, 1e-3);
  EXPECT_TRUE(pattern->larger_at_crests());
  const std::vector<CrestPeak> peaks = vertical_peaks(d);
  ASSERT_EQ(peaks.size(), 6U);
  EXPECT_NEAR(peaks.front().shift, 0.4, 1e-3);  // samples stand 0.08 rad apart
}

TEST_F(MadeUpRun, AWheelThatTurnsBackHasThePatternOfItsFirstPassage) {
  write_histories(wave(0.4), constant(0));
  std::ofstream histories(program_.folder / "histories.csv", std::ios::app);
  for (int i = 3049; i > 2000; --i) histories << fmt::format("{},{},0,0\n", 0.1 - 1e-5 * i, 1e-3 * i);
  histories.close();
  const FinishedRun d = run(corrugated());
  const auto pattern = wave_pattern(d, history_over_way(d, "vertical_force", "N"));
  ASSERT_TRUE(pattern);
  EXPECT_NEAR(pattern->share, 1, 1e-3);
  EXPECT_NEAR(pattern->shift, 0.4, 1e-3);
}

TEST_F(MadeUpRun, CurvesThatDoNotCoverTheStretchHaveNoPattern) {
  write_histories(wave(0), constant(0));
  const FinishedRun d = run(corrugated());
  CurvePoints curve = history_over_way(d, "vertical_force", "N");
  curve.x.resize(2800);
  curve.y.resize(2800);
  EXPECT_FALSE(wave_pattern(d, curve));
  EXPECT_FALSE(wave_pattern(run(smooth_rail()), history_over_way(d, "vertical_force", "N")));
}

TEST_F(MadeUpRun, CorrelationIsThatOfTheCurves) {
  write_histories(wave(0.3), wave(0.3 + kPi / 3));
  const FinishedRun d = run(corrugated());
  const auto value = correlation(d, history_over_way(d, "vertical_force", "N"),
                                 history_over_way(d, "longitudinal_force", "N"));
  ASSERT_TRUE(value);
  EXPECT_NEAR(*value, std::cos(kPi / 3), 1e-3);
}

TEST_F(MadeUpRun, PeaksOverFasteningsAreToldFromThoseBetween) {
  // Fastenings at 2.475 and 3.125 m.
  write_histories(
      [](double x) { return kLoad + (1e4 + (x < 2.6 ? 4e3 : 0)) * std::cos(2 * kPi * (x - 2.4) / 0.08); },
      constant(0));
  const auto effect = fastening_effect(run(corrugated()));
  ASSERT_TRUE(effect);
  EXPECT_NEAR(*effect, 4e3 / kLoad, 1e-3);
}

TEST_F(MadeUpRun, DelayIsCountedFromTheEndOfTheRamp) {
  write_histories(constant(kLoad), [](double x) { return 26e3 * std::min(1.0, x / kSpeed / 9e-3); });
  const auto delay = longitudinal_delay(run(smooth_rail()), 0.028);
  ASSERT_TRUE(delay);
  EXPECT_NEAR(*delay, 0.98 * 9e-3 - 5e-3, 0.1e-3);
  EXPECT_FALSE(longitudinal_delay(run(smooth_rail()), 0.036));
}

TEST_F(MadeUpRun, ForcesAreComparedWithTheStaticLoadAndWithOneAnother) {
  write_histories([](double x) { return kLoad * (x < 2.5 ? 1.5 : 1.03); }, constant(0));
  const FinishedRun smooth = run(smooth_rail());
  const auto residual = residual_oscillation(smooth, 2.6);
  ASSERT_TRUE(residual);
  EXPECT_NEAR(*residual, 0.03, 1e-9);
  EXPECT_FALSE(residual_oscillation(smooth, 4));
  const auto difference = vertical_difference(smooth, smooth, 0.028);
  ASSERT_TRUE(difference);
  EXPECT_NEAR(*difference, 0, 1e-9);
}

/// The torque is settled at 1.5 times 5 ms, x = 0.625 m.
TEST_F(MadeUpRun, ACreepageUnderARisingTorqueIsNoDivisor) {
  const auto judged = [&](double steady_from) { return judge_creepage(constant(0.004), steady_from); };
  EXPECT_EQ(judged(1.7).verdict, Verdict::reproduced);
  EXPECT_NE(judged(1.7).why.find(" 2.00 at N_cr"), std::string::npos) << judged(1.7).why;
  const Judgement rising = judged(0.6);
  EXPECT_EQ(rising.verdict, Verdict::not_run);
  EXPECT_NE(rising.why.find("a steady creepage"), std::string::npos) << rising.why;
}

/// On a smooth block of 2.2 mm N_cr has no creepage in the patch and twice its usual one up to 11 mm behind.
TEST_F(MadeUpRun, APointInThePatchDoesNotHaveTheCreepageOfTheWheel) {
  const auto smooth_rail_at = [](double place) -> Formula {
    return [place](double x) {
      return x < place - 0.004 || x > place + 0.011 ? 0.0021 : x < place + 0.004 ? 0 : 0.0044;
    };
  };
  const double turn = kPi * 0.86 / 1.002;
  const Judgement smooth = judge_creepage(smooth_rail_at(turn), 1.7);
  EXPECT_EQ(smooth.verdict, Verdict::partly);  // for its share of full sliding alone
  EXPECT_NE(smooth.why.find(" 1.05 at N_cr"), std::string::npos) << smooth.why;
  EXPECT_EQ(judge_creepage(smooth_rail_at(turn - 0.1), 1.7).verdict, Verdict::reproduced);
}

TEST_F(MadeUpRun, LostContactCountsFromTheFirstTroughOn) {
  // Zero for 7 mm in the first trough, before the evaluated stretch, and behind the corrugation.
  write_histories([](double x) { return (x > 2.4305 && x < 2.4375) || x > 2.97 ? 0.0 : kLoad; }, constant(0));
  const FinishedRun d = run(corrugated());
  EXPECT_NEAR(way_without_contact(d, history_over_way(d, "vertical_force", "N")), 7e-3, 1e-9);
  write_histories(wave(0), constant(0));
  EXPECT_EQ(way_without_contact(d, history_over_way(d, "vertical_force", "N")), 0);
}

/// F_L follows waves of 65 mm with half the range of 80 mm; the work's range is largest at 400 km/h.
TEST_F(MadeUpRun, NumbersCompareWavelengthsAndSpeeds) {
  write_histories(wave(0), [](double x) { return std::cos(2 * kPi * (x - 2.4) / 0.065); });
  PassageRuns runs;
  const auto add = [&](const Passage& passage, double range, double work) {
    FinishedRun one = run(passage);
    one.summary =
        parse_json(fmt::format("{{\"longitudinal_force_N\": {{\"max\": {}, \"min\": 0}}, \"surface\": "
                               "{{\"axis_frictional_work_range_J_in_1.1_mm_cell\": {}}}}}",
                               range, work),
                   "summary");
    runs.add(passage, one);
  };
  const auto ours = [&](const std::string& quantity) {
    const auto number = std::find_if(paper_numbers().begin(), paper_numbers().end(),
                                     [&](const PaperNumber& one) { return one.quantity == quantity; });
    return number == paper_numbers().end() ? std::nullopt : number->ours(runs);
  };
  add(corrugated(65), 2e4, 0);
  for (const double speed : {100.0, 180.0, 250.0, 300.0, 400.0}) {
    Passage passage = corrugated();
    passage.speed = speed;
    add(passage, 4e4, speed);
  }
  const std::string hardest = "Speed of the largest range of the frictional work";
  EXPECT_EQ(ours("Range of F_L at 65 mm over that at 80 mm"), 0.5);
  EXPECT_NEAR(ours("Pattern of the corrugation in F_L, 65 mm").value_or(0), 100, 0.1);
  EXPECT_FALSE(ours(hardest));
  Passage fastest = corrugated();
  fastest.speed = 500;
  add(fastest, 4e4, 300);
  EXPECT_EQ(ours(hardest), 400);
}

TEST_F(MadeUpRun, AFigureBecomesColumns) {
  write_histories(wave(0), constant(1e3));
  const FinishedRun d = run(corrugated());
  PassageRuns runs;
  runs.add(corrugated(), d);
  const auto figure = std::find_if(paper_figures().begin(), paper_figures().end(),
                                   [](const PaperFigure& f) { return f.id == "20"; });
  const DrawnFigure drawn = draw(*figure, runs);
  EXPECT_EQ(std::get<Figure>(drawn.block).panels.size(), 3U);
  const std::string& csv = drawn.csv;
  EXPECT_TRUE(csv.starts_with("Position of the wheel [m],\"F_N, 80 mm: F_N [kN]\",\"F_L, 80 mm: F_L [kN]\","))
      << csv.substr(0, 200);
  EXPECT_TRUE(samples::has(csv, "\n2.48,137.56,1,")) << csv.substr(0, 4000);
  EXPECT_LT(csv.size(), 100000U);
}

TEST(PaperFigures, EveryPassageIsAScene) {
  Study study;
  study.name = "test";
  study.scene = "scene.toml";
  study.scene_text = paper_scene();
  std::set<std::string> names;
  for (const PaperFigure& figure : paper_figures())
    for (const Passage& passage : figure.passages)
      if (names.insert(name_of(passage)).second) study.points.push_back(study_point(passage));
  EXPECT_EQ(names.size(), 31U);
  const StudyPlan plan = plan_study(study, "out");
  for (const PlannedPoint& point : plan.points) {
    const Scene& scene = point.resolved.scene;
    EXPECT_NEAR(scene.motion->speed * scene.motion->duration, 3.02, 1e-2) << point.name;
    EXPECT_EQ(scene.quality, "draft");
  }
}

TEST(PaperFigures, PassagesAtOneSpeedAndTractionShareTheirRolling) {
  Study study;
  study.name = "test";
  study.scene = "scene.toml";
  study.scene_text = paper_scene();
  Passage slower = corrugated();
  slower.speed = 250;
  Passage braking = corrugated();
  braking.mu = -0.3;
  for (const Passage& passage :
       {smooth_rail(), corrugated(), corrugated(65), smooth_rail(250), slower, braking})
    study.points.push_back(study_point(passage));
  const StudyPlan plan = plan_study(study, "out");
  ASSERT_EQ(plan.shared.size(), 2U);
  std::set<std::vector<std::size_t>> groups;
  for (const SharedRolling& group : plan.shared) {
    groups.insert(group.points);
    EXPECT_EQ(group.from_x, 2.4);
    EXPECT_FALSE(group.room);
  }
  EXPECT_EQ(groups, (std::set<std::vector<std::size_t>>{{0, 1, 2}, {3, 4}}));
  EXPECT_FALSE(plan.points[5].shared);
}

TEST(PaperFigures, EveryNumberBelongsToAFigureOrToNone) {
  for (const PaperNumber& number : paper_numbers()) {
    const bool known = std::any_of(paper_figures().begin(), paper_figures().end(),
                                   [&](const PaperFigure& f) { return f.id == number.figure; });
    EXPECT_TRUE(known || number.figure.empty()) << number.quantity;
    EXPECT_FALSE(number.ours(PassageRuns())) << number.quantity;
  }
}

TEST(PaperFigures, WithoutRunsNothingIsClaimed) {
  const PassageRuns none;
  for (const Conclusion& conclusion : paper_conclusions())
    EXPECT_EQ(conclusion.judge(none).verdict, Verdict::not_run) << conclusion.number;
  for (const PaperFigure& figure : paper_figures()) {
    const DrawnFigure drawn = draw(figure, none);
    const bool of_one_run = figure.instants || !figure.surface.empty();
    EXPECT_EQ(std::holds_alternative<Text>(drawn.block), of_one_run) << figure.id;
    EXPECT_EQ(drawn.csv.empty(), of_one_run) << figure.id;
    EXPECT_EQ(drawn.svg.empty(), of_one_run) << figure.id;
  }
}

TEST(PaperFigures, WavesHaveTheLevelOfASine) {
  const auto fig14 = std::find_if(paper_figures().begin(), paper_figures().end(),
                                  [](const PaperFigure& figure) { return !figure.waves.empty(); });
  ASSERT_NE(fig14, paper_figures().end());
  EXPECT_TRUE(fig14->passages.empty());
  const Figure figure = std::get<Figure>(draw(*fig14, {}).block);
  const std::vector<Series>& curves = figure.panels.front().series;
  ASSERT_EQ(curves.size(), 4U);
  EXPECT_EQ(curves[1].label, "80 mm");
  // 0.07 mm / sqrt 2: 33.9 dB.
  EXPECT_NEAR(*std::max_element(curves[1].y.begin(), curves[1].y.end()), 33.9, 0.05);
}

TEST(PaperFigures, AVerdictNamesThePassagesThatItLacksOnce) {
  const std::string why = paper_conclusions()[4].judge({}).why;
  for (const char* name : {"65mm,0.14mm,300km_h,mu=0.3", "80mm,0.14mm,500km_h,mu=0.3"})
    EXPECT_NE(why.find(name), std::string::npos) << why;
  const std::string shared = "80mm,0.14mm,300km_h,mu=0.3";
  EXPECT_EQ(why.find(shared), why.rfind(shared)) << why;
  EXPECT_NE(why.find(shared), std::string::npos) << why;
}

/// A number stands in studies/paper and beside the library's scene: the two must be one.
TEST(PaperNumbers, AreThoseOfTheLibrarysReferences) {
  const Scene scene = read_scene(std::filesystem::path(TREAD_SOURCE_DIR) / "scenes/corrugation-d.toml");
  const std::vector<References> references = library_references(scene);
  ASSERT_EQ(references.size(), 1U);
  for (const Reference& reference : references[0].rows) {
    if (reference.theory) continue;
    EXPECT_TRUE(std::any_of(paper_numbers().begin(), paper_numbers().end(), [&](const PaperNumber& number) {
      return number.value == reference.value && number.unit == reference.unit;
    })) << reference.label;
  }
}

}  // namespace
}  // namespace tread
