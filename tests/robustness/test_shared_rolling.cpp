// Points of a study that roll as one up to their corrugations: the bits of runs of their own, whatever ends a
// run in between.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

#include "drivers/studies/study/shared_rolling.hpp"
#include "drivers/studies/study/study_runner.hpp"
#include "io/files/checkpoint_folder.hpp"
#include "io/text/json.hpp"
#include "tests/program_test.hpp"
#include "tests/refusal.hpp"
#include "tests/tyre_scene.hpp"

namespace tread {
namespace {

namespace fs = std::filesystem;
using namespace samples;

/// A smooth rail and two corrugations, all of 2.2 ms; the state is kept at some 1 ms.
class SharedRollingStudy : public ProgramTest {
 protected:
  static void SetUpTestSuite() {
    make_root();
    study("all.toml", kPoints);
    ASSERT_EQ(call(sweep("all.toml", root_ / "apart", "--no-share")), 0) << errors();
  }
  void TearDown() override { fs::remove_all(runs_); }

  static void study(const char* name, const std::string& rest) {
    std::ofstream(root_ / name) << fmt::format(R"([study]
scene = "{}"
jobs = 1
[set]
scene.element_size = "8 mm"
motion.duration = "2.2 ms"
contact.depth_room = "0.1 mm"
output.progress_interval = "10 ms"
)",
                                               kTyre)
                                << rest;
  }
  static std::string sweep(const char* name, const fs::path& runs, const std::string& more = "") {
    return fmt::format("sweep {} -o {} {}", (root_ / name).string(), runs.string(), more);
  }
  void expect_same_runs() const {
    for (const char* point : {"smooth", "shallow", "deep"})
      expect_same_run(root_ / "apart" / point, runs_ / point);
  }
  static std::vector<fs::path> kept(const fs::path& run) { return CheckpointFolder(run / "forks").states(); }
  static std::string point(const char* name, const char* more) {
    return fmt::format("[[point]]\nname = \"{}\"\n{}", name, more);
  }

  static inline const std::string kSine =
      "corrugation.start = \"0.13 m\"\ncorrugation.length = \"60 mm\"\ncorrugation.wavelength = \"20 mm\"\n"
      "corrugation.apply = \"gap\"\ncorrugation.depth = ";
  static inline const std::string kPoints = point("smooth", "corrugation.present = false\n") +
                                            point("shallow", (kSine + "\"0.02 mm\"\n").c_str()) +
                                            point("deep", (kSine + "\"0.03 mm\"\n").c_str());
  fs::path runs_ = root_ / "runs";
};

TEST_F(SharedRollingStudy, LeavesTheFilesOfRunsOfTheirOwn) {
  ASSERT_EQ(call(sweep("all.toml", runs_, "--jobs 2")), 0) << errors();
  expect_same_runs();
  EXPECT_EQ(kept(runs_ / "smooth").size(), 1U);
  EXPECT_TRUE(kept(runs_ / "shallow").empty());
  for (const char* fork : {"shallow", "deep"})
    EXPECT_TRUE(has(content_of(runs_ / fork / "summary.json"), "/smooth\"")) << fork;
  EXPECT_FALSE(has(content_of(root_ / "apart/deep/summary.json"), "/smooth\""));
  ASSERT_EQ(call(sweep("all.toml", runs_)), 0) << errors();
  EXPECT_FALSE(has(errors(), "] begins")) << errors();
  EXPECT_TRUE(has(errors(), "3 of 3 done")) << errors();
}

TEST_F(SharedRollingStudy, AKilledSweepGoesOn) {
  const pid_t process = start(sweep("all.toml", runs_));
  ASSERT_TRUE(wait_until([&] { return has(content_of(runs_ / "smooth/status.json"), "\"rolling\""); }));
  ::kill(process, SIGKILL);
  EXPECT_EQ(wait_for(process), 1000 + SIGKILL);
  ASSERT_TRUE(wait_until([&] { return has(content_of(runs_ / "smooth/status.json"), "\"stopped\""); }));
  EXPECT_TRUE(kept(runs_ / "smooth").empty());
  EXPECT_FALSE(fs::exists(runs_ / "deep"));
  ASSERT_EQ(call(sweep("all.toml", runs_)), 0) << errors();
  EXPECT_TRUE(has(errors(), "[smooth] goes on")) << errors();
  expect_same_runs();
  EXPECT_TRUE(has(content_of(runs_ / "deep/summary.json"), "/smooth\""));
}

TEST_F(SharedRollingStudy, AnotherRunTakesThePlaceOfAKilledOne) {
  // stop.steps is no part of what makes a run the same: here it stands for whatever ends a run by chance.
  study("killed.toml", point("smooth", "corrugation.present = false\nstop.steps = 10\n") +
                           kPoints.substr(kPoints.find("[[point]]", 1)));
  EXPECT_EQ(call(sweep("killed.toml", runs_)), 4) << errors();
  EXPECT_TRUE(has(errors(), "1 of 3 points failed")) << errors();
  EXPECT_EQ(kept(runs_ / "shallow").size(), 1U);
  EXPECT_TRUE(has(content_of(runs_ / "deep/summary.json"), "/shallow\""));
  ASSERT_EQ(call(sweep("all.toml", runs_, "--retry")), 0) << errors();
  EXPECT_TRUE(has(errors(), "[smooth] goes on")) << errors();
  expect_same_runs();
}

TEST_F(SharedRollingStudy, WhereTheRollingFailsTheOthersAreNotTried) {
  study("pressed.toml", point("smooth", "corrugation.present = false\nstop.penetration = \"1 nm\"\n") +
                            kPoints.substr(kPoints.find("[[point]]", 1)));
  EXPECT_EQ(call(sweep("pressed.toml", runs_)), 3) << errors();
  EXPECT_TRUE(has(errors(), "3 of 3 points failed")) << errors();
  EXPECT_TRUE(has(errors(), "[deep] not begun: up to 1.")) << errors();
  EXPECT_TRUE(has(errors(), "ms it is the run of smooth, which failed before: exit 3")) << errors();
  EXPECT_FALSE(fs::exists(runs_ / "deep/summary.json"));
  EXPECT_EQ(call(sweep("pressed.toml", runs_)), 3);
  EXPECT_FALSE(has(errors(), "] begins")) << errors();
  EXPECT_EQ(call(sweep("all.toml", runs_, "--retry")), 0) << errors();
  EXPECT_TRUE(has(errors(), "[smooth] goes on")) << errors();
  expect_same_runs();
}

/// A wheel under traction gets ahead of its first speed: by 90 mm on its way to the corrugation at 100 km/h.
TEST(Approach, CountsTractionIn) {
  const Approach approach{.before = 0.04,
                          .wheel = {.load = 88e3, .mass = 926, .radius = 0.43, .friction = 0.5}};
  MotionSpec motion;
  motion.speed = 100 / 3.6;
  EXPECT_NEAR(approach.time(motion, 2.4), 2.36 / motion.speed, 1e-12);
  motion.traction_mu = 0.3;
  const double time = approach.time(motion, 2.4);
  EXPECT_NEAR(motion.speed * time + 0.5 * 0.3 * 88e3 / 926 * time * time, 2.36, 1e-12);
  EXPECT_LT(time, 0.97 * 2.36 / motion.speed);
  EXPECT_EQ(approach.time(motion, 0.03), 0);
  motion.traction_mu.reset();
  motion.traction_torque = 0.3 * 88e3 * 0.43;
  EXPECT_NEAR(approach.time(motion, 2.4), time, 1e-12);
  Approach guided = approach;
  guided.wheel.guided = true;
  EXPECT_NEAR(guided.time(motion, 2.4), 2.36 / motion.speed, 1e-12);
}

/// The slip of a creepage of 0.5 is two thirds of the speed; the spin of half of the mass gives a third of
/// it.
TEST(Approach, CountsCreepageIn) {
  Approach approach{.before = 0.04,
                    .wheel = {.load = 88e3, .mass = 926, .radius = 0.43, .friction = 0.5, .own_mass = 463}};
  MotionSpec motion;
  motion.speed = 100 / 3.6;
  motion.creepage = 0.5;
  EXPECT_NEAR(approach.time(motion, 2.4), 2.36 / (motion.speed * (1 + 2.0 / 9)), 1e-12);
  motion.creepage = -0.5;
  EXPECT_NEAR(approach.time(motion, 2.4), 2.36 / motion.speed, 1e-12);
}

/// A braked wheel comes back from rail that it has met.
TEST(ForkedPast, ReachesAsFarAsTheWheelHasBeen) {
  const Model model(
      tyre_scene({"scene.element_size=10 mm", "corrugation.apply=gap", "corrugation.wavelength=20 mm",
                  "corrugation.depth=0.02 mm", "corrugation.start=0.1 m", "corrugation.length=0.1 m",
                  "solution_zone.length=150 mm"}),
      0.0);
  Fork fork;
  fork.order.origin = {"nowhere", 1e-3, 10};
  fork.content["state/wheel_frame"] = std::vector<double>{0.0};
  const auto past = [&](double farthest) {
    Sample sample;
    sample.wheel_x = farthest;
    return refusal<InputError>([&] { require_same_past(fork, model, {sample}); });
  };
  EXPECT_EQ(past(0), "");
  EXPECT_TRUE(has(past(0.15), "the corrugations differ")) << past(0.15);
}

/// Without runs.
class SharedRollingList : public SharedRollingStudy {
 protected:
  static void SetUpTestSuite() {
    make_root();
    study("all.toml", kPoints);
  }
};

TEST_F(SharedRollingList, ShowsWhoBeginsWithWhom) {
  ASSERT_EQ(call(sweep("all.toml", runs_, "--list --json")), 0) << errors();
  const JsonRecord list = parse_json(output(), "list");
  EXPECT_TRUE(has(text_in(list, "points.0.begins"), "keeps the state at 1."));
  EXPECT_TRUE(has(text_in(list, "points.1.begins"), "from smooth"));
  EXPECT_LT(*number_in(list, "points.2.seconds"), 0.8 * *number_in(list, "points.0.seconds"));
  EXPECT_GT(*number_in(list, "saved_seconds"), 0);
  ASSERT_EQ(call(sweep("all.toml", runs_, "--list --json --no-share")), 0) << errors();
  EXPECT_FALSE(has(output(), "begins"));
  EXPECT_EQ(number_in(parse_json(output(), "list"), "saved_seconds"), 0);
}

/// Which points are one run up to where; nothing runs.
class SharedRollingPlan : public testing::Test {
 protected:
  /// Groups as texts: "a b".
  std::vector<std::string> groups(const std::string& points) const {
    const Study study = read_study(program_.write(
        "study.toml",
        fmt::format("[study]\nscene = \"{}\"\n[set]\nscene.element_size = \"10 mm\"\n{}", kTyre, points)));
    StudyPlan plan = plan_study(study, program_.folder / "runs");
    std::vector<std::string> texts;
    for (const SharedRolling& group : plan.shared) {
      std::string text;
      for (const std::size_t i : group.points) text += (text.empty() ? "" : " ") + plan.points[i].name;
      texts.push_back(text);
    }
    std::sort(texts.begin(), texts.end());
    return texts;
  }
  static std::string waves(const char* name, const char* depth, const std::string& more = "") {
    return fmt::format(
        "[[point]]\nname = \"{}\"\ncorrugation.start = \"0.13 m\"\ncorrugation.length = \"60 mm\"\n"
        "corrugation.wavelength = \"20 mm\"\ncorrugation.depth = \"{} mm\"\n{}{}",
        name, depth, has(more, "apply") ? "" : "corrugation.apply = \"gap\"\n", more);
  }
  static std::string smooth(const char* name, const std::string& more) {
    return fmt::format("[[point]]\nname = \"{}\"\ncorrugation.present = false\n{}", name, more);
  }
  using Names = std::vector<std::string>;
  Program program_;
};

TEST_F(SharedRollingPlan, CorrugationsByGapAtOneSpeedAndTractionRollTogether) {
  EXPECT_EQ(groups(waves("a", "0.02") + waves("b", "0.03") + smooth("c", "motion.traction.mu = 0.1\n") +
                   waves("d", "0.02", "motion.traction.mu = 0.1\n") +
                   waves("e", "0.02", "motion.speed = \"250 km/h\"\n")),
            (Names{"a b", "c d"}));
}

TEST_F(SharedRollingPlan, NothingElseDoes) {
  EXPECT_EQ(groups(waves("a", "0.02") + waves("nodes", "0.03", "corrugation.apply = \"nodes\"\n") +
                   waves("friction", "0.03", "contact.friction = 0.4\n") +
                   waves("shorter", "0.03", "motion.duration = \"1 ms\"\n") +
                   waves("finer", "0.03", "output.history_interval = \"5 us\"\n") +
                   waves("room", "0.03", "contact.depth_room = \"0.3 mm\"\n") +
                   waves("none", "0.04", "contact.depth_room = \"0.01 mm\"\n") +
                   waves("keeps", "0.05", "forks.at = \"0.1 ms\"\n")),
            Names{});
  const std::string two = waves("a", "0.02") + waves("b", "0.03");
  EXPECT_EQ(groups(two), Names{"a b"});
}

/// One mesh serves all of them, which costs of a deeper one would show.
TEST_F(SharedRollingPlan, CorrugationsByGapHaveOneCostModel) {
  const std::string forks = "forks.at = \"0.1 ms\"\n";
  StudyPlan plan = plan_study(
      read_study(program_.write(
          "study.toml", fmt::format("[study]\nscene = \"{}\"\n[set]\nscene.element_size = \"10 mm\"\n{}",
                                    kTyre, waves("a", "0.02", forks) + waves("b", "3", forks)))),
      program_.folder / "runs");
  project_cost(plan, false);
  EXPECT_EQ(plan.points[0].cost->memory, plan.points[1].cost->memory);
}

TEST_F(SharedRollingPlan, AStateOfAnotherStudyServesWhereItIsInTimeAndHasRoom) {
  const auto keeps = [&](double at, double room) {
    StudyPlan plan = plan_study(
        read_study(program_.write(
            "study.toml", fmt::format("[study]\nscene = \"{}\"\n[set]\nscene.element_size = \"10 mm\"\n{}",
                                      kTyre, waves("a", "0.02") + waves("b", "0.03") + waves("c", "0.04")))),
        program_.folder / "runs");
    plan.points[2].status.state = PointState::interrupted;
    plan.points[2].status.keeps_at = at;
    plan.points[2].status.room = room;
    project_cost(plan, false);
    return plan.points[2].keeps_state;
  };
  EXPECT_TRUE(keeps(0.5e-3, 0.2e-3));
  EXPECT_FALSE(keeps(1.9e-3, 0.2e-3));
  EXPECT_FALSE(keeps(0.5e-3, 0.01e-3));
}

TEST_F(SharedRollingPlan, ADeepCorrugationNeedsRoomAndANearOneSharesNothing) {
  const auto plan_of = [&](const std::string& points) {
    StudyPlan plan = plan_study(
        read_study(program_.write(
            "study.toml", fmt::format("[study]\nscene = \"{}\"\n[set]\nscene.element_size = \"10 mm\"\n{}",
                                      kTyre, points))),
        program_.folder / "runs");
    project_cost(plan, false);
    return plan;
  };
  const StudyPlan deep = plan_of(waves("a", "0.02") + waves("b", "0.4"));
  const std::vector<std::string> arguments = point_arguments(deep, deep.points[0], 1);
  EXPECT_NE(std::find(arguments.begin(), arguments.end(), "contact.depth_room=0.0004 m"), arguments.end());
  EXPECT_TRUE(waits_for_state(deep, deep.points[1]));
  EXPECT_FALSE(waits_for_state(deep, deep.points[0]));
  const std::string near = "solution_zone.start = \"0.01 m\"\n";
  const StudyPlan at_once =
      plan_of(smooth("x", near) +
              "[[point]]\nname = \"y\"\ncorrugation.apply = \"gap\"\ncorrugation.start = "
              "\"0.01 m\"\ncorrugation.length = \"80 mm\"\n" +
              near);
  EXPECT_FALSE(at_once.points[0].shared);
  EXPECT_FALSE(waits_for_state(at_once, at_once.points[0]));
  for (const std::string& argument : point_arguments(at_once, at_once.points[0], 1))
    EXPECT_FALSE(has(argument, "forks")) << argument;
}

/// Values that make no other run of it, as a study states them now.
TEST_F(SharedRollingPlan, ARunThatGoesOnTakesTheStudysLimits) {
  const auto plan_of = [&](const std::string& more) {
    return plan_study(read_study(program_.write(
                          "study.toml", fmt::format("[study]\nscene = \"{}\"\n[set]\nscene.element_size = "
                                                    "\"10 mm\"\n{}{}",
                                                    kTyre, more, waves("a", "0.02")))),
                      program_.folder / "runs");
  };
  const StudyPlan before = plan_of(
      "stop.steps = 10\nstop.wall_time = \"1 s\"\nstop.penetration = \"1 mm\"\noutput.disk_limit = \"1 "
      "GB\"\n");
  const auto arguments_of = [&](StudyPlan plan, const PlannedPoint& in_the_folder) {
    PointStatus& status = plan.points[0].status;
    status.state = PointState::interrupted;
    status.process = process_values(in_the_folder.resolved);
    return point_arguments(plan, plan.points[0], 0);
  };
  const std::string folder = (program_.folder / "runs/a").string();
  EXPECT_EQ(arguments_of(before, before.points[0]), (Names{"resume", folder}));
  const StudyPlan now = plan_of("stop.penetration = \"2 mm\"\noutput.checkpoint_interval = \"5 min\"\n");
  EXPECT_EQ(arguments_of(now, before.points[0]),
            (Names{"resume", folder, "--set", "output.checkpoint_interval=300 s", "--set",
                   "output.disk_limit=1000000000000000 B", "--set", "stop.penetration=0.002 m", "--set",
                   "stop.steps=0", "--set", "stop.wall_time=100000000 s"}));
}

TEST_F(SharedRollingPlan, ARunTakesTheCardThatItIsGiven) {
  StudyPlan plan =
      plan_study(read_study(program_.write("study.toml", fmt::format("[study]\nscene = \"{}\"\n[set]\n"
                                                                     "scene.element_size = \"10 mm\"\n{}",
                                                                     kTyre, waves("a", "0.02")))),
                 program_.folder / "runs");
  plan.device = "gpu";
  const auto device_of = [&](int card) {
    const std::vector<std::string> arguments = point_arguments(plan, plan.points[0], 1, card);
    return *std::next(std::find(arguments.begin(), arguments.end(), "--device"));
  };
  EXPECT_EQ(device_of(-1), "gpu");
  EXPECT_EQ(device_of(2), "gpu:2");
}

}  // namespace
}  // namespace tread
