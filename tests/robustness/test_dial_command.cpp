// `tread dial` and `tread check --error` as a user calls them.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "io/text/json.hpp"
#include "tests/program.hpp"

namespace tread {
namespace {

namespace fs = std::filesystem;
using samples::content_of;
using samples::has;

class Dial : public testing::Test {
 protected:
  static std::string scene(const char* name) { return samples::scene_word(name); }
  int call(const std::string& arguments) const { return program_.call(arguments); }
  std::string errors() const { return program_.errors(); }

  /// A tyre that rolls for an instant in its solution zone.
  std::string tyres(const std::string& more) const {
    return fmt::format(
        "dial {} -o {} -t 1 --quiet --set \"motion.duration=1 ms\" --set \"solution_zone.start=0 m\" "
        "--base \"scene.element_size=10 mm\" {}",
        scene("tyre.toml"), runs_.string(), more);
  }

  samples::Program program_;
  fs::path runs_ = program_.folder / "runs";
};

TEST_F(Dial, MeasuresAgainstTheFinestAndAdvises) {
  const std::string axes = "--axis \"scene.element_size=12 mm,8 mm\" --axis motion.start=rigid";
  ASSERT_EQ(call(tyres(axes)), 0) << errors();
  EXPECT_TRUE(has(program_.out(), "against element_size=8mm")) << program_.out();
  for (const char* name : {"dial.csv", "dial.jsonl", "figures/errors.svg", "figures/errors.csv",
                           "effects.csv", "results.md", "sweep.csv", "report.html"})
    EXPECT_TRUE(fs::exists(runs_ / name)) << name;
  EXPECT_TRUE(has(content_of(runs_ / "report.html"), "Provenance"));
  const std::vector<JsonRecord> rows = read_json_lines(runs_ / "dial.jsonl");
  ASSERT_EQ(rows.size(), 4U);
  EXPECT_EQ(text_in(rows[3], "point"), "start=rigid");
  EXPECT_EQ(text_in(rows[3], "settings"), "scene.element_size=10 mm; motion.start=rigid");
  EXPECT_EQ(number_in(rows[2], "F_N_error"), 0);
  for (const char* key : {"F_N_error", "creepage_error", "von_mises_error", "work_error", "shear_mean"})
    EXPECT_TRUE(number_in(rows[0], key)) << key;
  EXPECT_GT(number_in(rows[0], "F_N_error"), 0.001);

  // Single settings stand beside the base, on whose mesh they are; other meshes do not.
  const std::string effects = content_of(runs_ / "effects.csv");
  EXPECT_EQ(std::count(effects.begin(), effects.end(), '\n'), 3) << effects;
  EXPECT_TRUE(has(effects, "start=rigid,"));

  const std::string check =
      fmt::format("check {} -t 1 --dial {} --quantity F_N", scene("tyre.toml"), runs_.string());
  ASSERT_EQ(call(check + " --error 99%"), 0) << errors();
  EXPECT_TRUE(has(program_.out(), "--set \"scene.element_size=1")) << program_.out();
  ASSERT_EQ(call(check + " --error 0.0001%"), 0) << errors();
  EXPECT_TRUE(has(program_.out(), "no setting measured is as near; the nearest")) << program_.out();

  // A passage without a title is not named.
  const fs::path untitled = program_.write("untitled.jsonl", [&] {
    std::string lines = content_of(runs_ / "dial.jsonl");
    for (auto at = lines.find("\"scene\""); at != std::string::npos; at = lines.find("\"scene\"", at + 1)) {
      const auto first = lines.find('"', at + 8) + 1;
      lines.erase(first, lines.find('"', first) - first);
    }
    return lines;
  }());
  ASSERT_EQ(call(fmt::format("check {} -t 1 --dial {} --error 99%", scene("tyre.toml"), untitled.string())),
            0)
      << errors();
  EXPECT_TRUE(has(program_.out(), "          measured against ")) << program_.out();

  // The program's own table names a quality, which the tyre's element size hides.
  ASSERT_EQ(call(fmt::format("check {} -t 1 --error 5% --quantity pressure", scene("tyre.toml"))), 0)
      << errors();
  EXPECT_TRUE(has(program_.out(), "measured on \"Corrugation D, 300 km/h")) << program_.out();
  EXPECT_TRUE(has(program_.out(), "left out of the scene")) << program_.out();
  ASSERT_EQ(call(fmt::format("check {} -t 1 --error 5% --quantity pressure --json", scene("tyre.toml"))), 0)
      << errors();
  EXPECT_EQ(text_in(parse_json(program_.out(), "check"), "advice.left_out.0"), "scene.element_size");

  // In JSON it is one list.
  ASSERT_EQ(call(tyres(axes + " --json")), 0) << errors();
  const JsonRecord list = parse_json("{\"rows\": " + program_.out() + "}", "list");
  EXPECT_EQ(text_in(list, "rows.3.point"), "start=rigid");
  EXPECT_EQ(list.count("rows.4.point"), 0U);

  // A finished run from elsewhere as the reference: nothing runs again.
  fs::rename(runs_ / "element_size=8mm", program_.folder / "fine");
  const std::string fewer = "--axis \"scene.element_size=12 mm\" --axis motion.start=rigid --reference ";
  ASSERT_EQ(call(tyres(fewer + (program_.folder / "fine").string())), 0) << errors();
  EXPECT_EQ(read_json_lines(runs_ / "dial.jsonl").size(), 4U);
  EXPECT_EQ(number_in(read_json_lines(runs_ / "dial.jsonl")[0], "F_N_error"),
            number_in(rows[0], "F_N_error"));

  // The same runs as points of a study: without a base there are no effects of single settings.
  ASSERT_TRUE(fs::exists(runs_ / "effects.csv"));
  const fs::path study =
      program_.write("study.toml", fmt::format("[study]\nscene = \"{}/scenes/tyre.toml\"\n[grid]\n"
                                               "scene.element_size = [\"12 mm\", \"10 mm\"]\n",
                                               TREAD_SOURCE_DIR));
  ASSERT_EQ(call(fmt::format("dial {} -o {} -t 1 --quiet --set \"motion.duration=1 ms\" --set "
                             "\"solution_zone.start=0 m\"",
                             shell_word(study), runs_.string())),
            0)
      << errors();
  EXPECT_FALSE(fs::exists(runs_ / "effects.csv"));
}

TEST_F(Dial, RefusesBeforeAnythingRuns) {
  const std::string two = "--axis \"scene.element_size=12 mm\" ";
  EXPECT_EQ(call(tyres(two + "--reference nowhere")), 2);
  EXPECT_TRUE(has(errors(), "--reference nowhere: neither a point of this dial")) << errors();
  EXPECT_EQ(call(tyres(two + "--against nothing")), 2);
  EXPECT_TRUE(has(errors(), "--against nothing: not a point")) << errors();
  EXPECT_EQ(call(tyres("--axis scene.elements=3")), 2);
  EXPECT_TRUE(has(errors(), "scene.elements")) << errors();
  EXPECT_EQ(call(tyres("--axis \"load.wheel_load=40 kN\"")), 2);
  EXPECT_TRUE(has(errors(), "load.wheel_load = 40 kN makes another passage")) << errors();
  EXPECT_TRUE(has(errors(), "tread sweep")) << errors();
  EXPECT_EQ(call(tyres(two + "--cost hours")), 2);
  // A wheel without a rail moves, but feels no contact.
  std::string wheel = content_of(fs::path(TREAD_SOURCE_DIR) / "scenes/tyre.toml");
  wheel.erase(wheel.find("[rail]"), wheel.find("[motion]") - wheel.find("[rail]"));
  wheel.erase(wheel.find("traction = "));
  for (const std::string& alone : {scene("bar-wave.toml"), program_.write("wheel.toml", wheel).string()}) {
    EXPECT_EQ(call(fmt::format("dial {} --list", alone)), 2);
    EXPECT_TRUE(has(errors(), "nothing rolls in it")) << errors();
  }
  for (const char* wrong :
       {"--error 0", "--error two", "--error 2% --quantity F_Q", "--error 2% --cost hours",
        "--error 2% --cost minutes", "--error 2% --dial nowhere"})
    EXPECT_EQ(call(fmt::format("check {} -t 1 {}", scene("tyre.toml"), wrong)), 2) << wrong;
  EXPECT_FALSE(fs::exists(runs_ / "element_size=12mm"));
}

TEST_F(Dial, SaysWhereTheMeasuredTableIsMissing) {
  ::setenv("TREAD_SHARE", program_.folder.c_str(), 1);
  EXPECT_EQ(call(fmt::format("check {} -t 1 --error 2%", scene("tyre.toml"))), 2);
  ::unsetenv("TREAD_SHARE");
  EXPECT_TRUE(
      has(errors(), "there is no table of measured settings in " + (program_.folder / "dial").string()))
      << errors();
  EXPECT_TRUE(has(errors(), "--dial")) << errors();
}

TEST_F(Dial, AReferenceIsOfTheSamePassage) {
  ASSERT_EQ(call(fmt::format("run {} -o {} -t 1 --quiet --set \"scene.element_size=10 mm\" --set "
                             "\"motion.duration=0.1 ms\" --set \"solution_zone.start=0 m\" --set "
                             "motion.traction.mu=0.1",
                             scene("tyre.toml"), (program_.folder / "other").string())),
            0)
      << errors();
  EXPECT_EQ(
      call(tyres("--axis \"scene.element_size=12 mm\" --reference " + (program_.folder / "other").string())),
      2);
  EXPECT_TRUE(has(errors(), "motion.traction.mu is 0.3 here and 0.1 there")) << errors();
}

TEST_F(Dial, TheKeptPassageIsOfTheDocumentedDial) {
  const fs::path docs = fs::path(TREAD_SOURCE_DIR) / "docs/records";
  // A reference is judged before anything else, so that no mesh of the study need be made.
  EXPECT_EQ(call(fmt::format("dial {} --reference {}", shell_word(docs / "dial/corrugation-d.toml"),
                             shell_word(docs / "performance/paper-passage"))),
            2);
  EXPECT_TRUE(has(errors(), "-o is missing")) << errors();
}

}  // namespace
}  // namespace tread
