// Study files: points, names, and messages for wrong files.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/error.hpp"
#include "drivers/studies/study/study_plan.hpp"
#include "io/scene/study_reader.hpp"
#include "tests/program.hpp"
#include "tests/refusal.hpp"

namespace tread {
namespace {

class StudyReader : public testing::Test {
 protected:
  Study read(const std::string& text) const { return read_study(program_.write("study.toml", text)); }
  /// Message with which the study is refused.
  std::string refusal(const std::string& text) const {
    return samples::refusal<InputError>([&] { read(text); });
  }
  samples::Program program_;
};

std::vector<std::string> names(const Study& study) {
  std::vector<std::string> list;
  for (const StudyPoint& point : study.points) list.push_back(point.name);
  return list;
}

TEST_F(StudyReader, AGridIsEveryCombination) {
  const Study study = read(R"([study]
title = "t"
scene = "sub/scene.toml"
jobs = 2
[set]
motion.duration = "20 ms"
scene.quality = "draft"
[grid]
motion.speed = ["100 km/h", "300 km/h"]
motion.traction.mu = [0.1, 0.3]
)");
  EXPECT_EQ(study.title, "t");
  EXPECT_EQ(study.scene, program_.folder / "sub/scene.toml");
  EXPECT_EQ(study.jobs, 2);
  EXPECT_EQ(study.threads, 0);
  ASSERT_EQ(study.common.size(), 2U);
  EXPECT_EQ(study.common[0].as_override(), "motion.duration=20 ms");
  EXPECT_EQ(names(study), (std::vector<std::string>{"speed=100km_h,mu=0.1", "speed=100km_h,mu=0.3",
                                                    "speed=300km_h,mu=0.1", "speed=300km_h,mu=0.3"}));
  EXPECT_EQ(study.points[1].varied[0].as_override(), "motion.speed=100 km/h");
  EXPECT_EQ(study.points[1].varied[1].as_override(), "motion.traction.mu=0.3");
  EXPECT_EQ(study.points[1].varied[1].line, 10);
}

TEST_F(StudyReader, AListHasNamesOfItsOwn) {
  const Study study = read(R"([study]
scene = "scene.toml"
[[point]]
motion.traction.mu = -0.2
[[point]]
name = "free"
motion.traction = { mu = 0, ramp = "1 ms" }
)");
  EXPECT_EQ(names(study), (std::vector<std::string>{"mu=-0.2", "free"}));
  EXPECT_TRUE(study.share);
  EXPECT_FALSE(read("[study]\nscene = \"s.toml\"\nshare = false\n[grid]\na = [1]\n").share);
  ASSERT_EQ(study.points[1].varied.size(), 2U);
  EXPECT_EQ(study.points[1].varied[1].as_override(), "motion.traction.ramp=1 ms");
}

TEST_F(StudyReader, KeysWithTheSameEndAreToldApart) {
  EXPECT_EQ(point_name({{"material.steel.density", "7790 kg/m3"}, {"material.slab.density", "1"}}),
            "steel.density=7790kg_m3,slab.density=1");
}

TEST_F(StudyReader, LongNamesStayApart) {
  const std::string path(110, 'p');
  const Study study = read(fmt::format(
      "[study]\nscene = \"s.toml\"\n[grid]\ncorrugation.file = [\"{0}/first.txt\", \"{0}/other.txt\"]\n",
      path));
  ASSERT_EQ(study.points.size(), 2U);
  for (const StudyPoint& point : study.points) EXPECT_EQ(point.name.size(), 120U) << point.name;
  EXPECT_EQ(study.points[0].name.substr(0, 104), "file=" + path.substr(0, 99));
  EXPECT_NE(study.points[0].name, study.points[1].name);
}

TEST_F(StudyReader, TablesCanBeValues) {
  const Study study = read(
      "[study]\nscene = \"s.toml\"\n[grid]\nmaterial.steel.damping = [{ kind = \"rayleigh_beta\", value = "
      "\"1e-8 "
      "s\" }, { kind = \"high_frequency_fraction\", value = 1e-4 }]\n");
  ASSERT_EQ(study.points.size(), 2U);
  EXPECT_EQ(study.points[1].varied[0].value, "{ kind = \"high_frequency_fraction\", value = 0.0001 }");
  EXPECT_EQ(study.points[0].name, "damping=_kind_rayleigh_beta_value_1e-8s_");
}

TEST_F(StudyReader, RefusesWithPlaceAndReason) {
  const std::string head = "[study]\nscene = \"s.toml\"\n";
  for (const auto& [text, part] : std::vector<std::pair<std::string, std::string>>{
           {"", "study.scene: missing"},
           {head, "it varies nothing"},
           {head + "[grid]\n", "it varies nothing"},
           {head + "[grid]\nmotion.speed = []\n", ":4:8: motion.speed: expected an array of values"},
           {head + "[grid]\nmotion.speed = \"1 m/s\"\n", ":4:8: motion.speed: expected an array of values"},
           {head + "[gird]\na = [1]\n", ":3:2: gird: unknown table (did you mean grid?)"},
           {"[study]\nscenes = \"s\"\n", ":2:1: study.scenes: unknown key (did you mean study.scene?)"},
           {"[study]\ntitle = \"a\\rb\"\n",
            "study.toml:2:1: study.title: character 2 is the control character"},
           {"[study]\ntitle = \"" + std::string(1001, 'x') + "\"\n", "study.title: the text has 1001"},
           {"[study]\nscene = 3\n", "study.scene: expected a text, got the number 3"},
           {head + "jobs = 0\n[grid]\na = [1]\n", ":3:1: study.jobs: expected a whole number from 1"},
           {head + "share = 1\n[grid]\na = [1]\n", ":3:1: study.share: expected true or false"},
           {head + "[set]\na = [1]\n[grid]\nb = [1]\n", ":4:1: a: expected one value, got an array"},
           {head + "[set]\na = 1\n[grid]\na = [1]\n", ":4:1: a: it stands in [set] and is varied on line 6"},
           {head + "[[point]]\nname = \"x\"\n", "point: it varies nothing"},
           {head + "[[point]]\nname = \"../x\"\na = 1\n", "cannot name a folder"},
           {head + "[[point]]\nname = \"request\"\na = 1\n",
            ":4:8: point.name: \"request\" is a name that tread"},
           {head + "[[point]]\nname = \"run.h5\"\na = 1\n", "choose another name"},
           {head + "[[point]]\na = 1\n[[point]]\na = 1\n",
            "two points are called \"a=1\", the first on line 3"},
           {head + "[grid]\na = [1]\n[[point]]\na = 1\n", "a [grid] or a list of [[point]], not both"},
           {head + "point = 1\n", "study.point: unknown key"},
           {"[[study]]\nscene = \"s\"\n", "study: expected the table [study]"},
       })
    EXPECT_TRUE(samples::has(refusal(text), part)) << text << "\n" << refusal(text);
}

TEST_F(StudyReader, TakesShippedScenesWhereTheFolderHasNone) {
  const std::string text = "[study]\nscene = \"tyre\"\n[grid]\nmotion.speed = [\"1 m/s\"]\n";
  EXPECT_EQ(read(text).scene.filename(), "tyre.toml");
  program_.write("tyre", "");
  EXPECT_EQ(read(text).scene, program_.folder / "tyre");
}

/// The study sets one key of a table whose other keys are missing.
TEST_F(StudyReader, MissingKeysArePlacedAtTheirTable) {
  const Study study = read(
      "[study]\nscene = \"bar-wave\"\n[set]\nmaterial.tin.density = \"7290 kg/m3\"\n[grid]\npulse.velocity = "
      "[\"1 m/s\"]\n");
  const std::string text = samples::refusal<InputError>([&] { plan_study(study, ""); });
  samples::expect_part(text, "study.toml:4:");
  EXPECT_FALSE(samples::has(text, "--set:")) << text;
}

TEST_F(StudyReader, RefusesTooManyPoints) {
  std::string text = "[study]\nscene = \"s.toml\"\n[grid]\n";
  for (const char* key : {"a", "b", "c"}) {
    text += fmt::format("{} = [", key);
    for (int i = 0; i < 11; ++i) text += fmt::format("{}, ", i);
    text += "]\n";
  }
  EXPECT_TRUE(samples::has(refusal(text), "more than 1000 points")) << refusal(text);
}

}  // namespace
}  // namespace tread
