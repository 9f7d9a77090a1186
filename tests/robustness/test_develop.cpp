// `tread develop` as a user calls it, on a tyre that rolls over a short rough block.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>

#include "drivers/process/machine.hpp"
#include "io/scene/scene_reader.hpp"
#include "io/text/json.hpp"
#include "tests/program_test.hpp"

namespace tread {
namespace {

namespace fs = std::filesystem;
using namespace samples;

const std::string kCorrugation =
    "[corrugation]\nkind = \"random\"\nrms = \"2 um\"\nshortest = \"32 mm\"\nlongest = \"72 mm\"\n"
    "start = \"0.1 m\"\nlength = \"72 mm\"\napply = \"gap\"\n";
const std::string kWear = "[wear]\nshortest = \"32 mm\"\nlongest = \"72 mm\"\n";

class Develop : public ProgramTest {
 protected:
  static void SetUpTestSuite() {
    make_root();
    ASSERT_EQ(call(develop(root_ / "whole", 2, kCorrugation + kWear)), 0) << errors();
    for (const char* line : {"[develop] 0 of 3 done", "[develop] 2 of 3 done", "[develop] 3 of 3 done"})
      EXPECT_TRUE(has(errors(), line)) << line << errors();
  }
  void TearDown() override { fs::remove_all(folder_); }

  /// Arguments; the scene is the coarse tyre's with `tables`.
  static std::string develop(const fs::path& folder, int passages, const std::string& tables,
                             const std::string& more = "") {
    std::ofstream(root_ / "scene.toml") << content_of(kTyre) << tables;
    return fmt::format(
        "develop {} --passages {} -o {} --set \"scene.element_size=8 mm\" --set \"motion.duration=2.4 ms\" "
        "{}",
        (root_ / "scene.toml").string(), passages, folder.string(), more);
  }
  void expect_refused(const std::string& tables, const std::string& reason,
                      const std::string& more = "") const {
    EXPECT_EQ(call(develop(folder_, 1, tables, more)), 2) << reason;
    EXPECT_TRUE(has(errors(), reason)) << reason << " is not in: " << errors();
    EXPECT_FALSE(fs::exists(folder_ / "passage-0000"));
  }

  fs::path folder_ = root_ / "development";
};

TEST_F(Develop, LeavesProfilesSpectraAndAReport) {
  const fs::path whole = root_ / "whole";
  for (const char* name :
       {"profiles/0000.txt", "profiles/0001.txt", "profiles/0002.txt", "work/0000.csv", "work/0002.csv",
        "spectra.csv", "growth.csv", "figures/growth.svg", "figures/profile.csv"})
    EXPECT_TRUE(fs::exists(whole / name)) << name;
  EXPECT_TRUE(has(content_of(whole / "profiles.csv"), "depth_after_2 [m]"));
  for (const char* part : {"What the model leaves out", "Provenance"})
    EXPECT_TRUE(has(content_of(whole / "report.html"), part)) << part;
  const JsonRecord result = read_json(whole / "development.json");
  EXPECT_EQ(number_in(result, "passages"), 2);
  EXPECT_GT(number_in(result, "real_passages"), 1);
  EXPECT_GT(number_in(result, "even_wear_m_per_passage"), 1e-11);
  EXPECT_EQ(number_in(result, "bands.0.wavelength_m"), 0.04);
  EXPECT_FALSE(content_of(whole / "profiles/0000.txt") == content_of(whole / "profiles/0001.txt"));
  // Of the runs those stay that others begin with, and the last.
  EXPECT_TRUE(fs::exists(whole / "passage-0000/forks"));
  EXPECT_FALSE(fs::exists(whole / "passage-0001"));
  EXPECT_TRUE(fs::exists(whole / "passage-0002/report.html"));
  EXPECT_TRUE(has(content_of(whole / "passage-0002/report.html"), "fork of"));
  // Passages come one after the other, each on all cores.
  EXPECT_EQ(number_in(read_json(whole / "passage-0002/summary.json"), "threads"), machine_cores());
}

/// Between two passages no point of the running study is left, and yet the development is not complete.
TEST_F(Develop, ItsStatusCountsAllPassages) {
  const JsonRecord ended = read_json(root_ / "whole/status.json");
  EXPECT_EQ(number_in(ended, "done"), 3);
  EXPECT_EQ(number_in(ended, "waiting"), 0);
  const auto complete = [](const fs::path& folder) {
    EXPECT_EQ(call(fmt::format("results {} --json", folder.string())), 0) << errors();
    return truth_in(parse_json(output(), "results"), "complete");
  };
  EXPECT_TRUE(complete(root_ / "whole"));
  // The first passage of three is stopped.
  EXPECT_EQ(call(develop(folder_, 2, kCorrugation + kWear + "[stop]\nwall_time = \"1 ms\"\n")), 75);
  const JsonRecord stopped = read_json(folder_ / "status.json");
  EXPECT_EQ(number_in(stopped, "interrupted"), 1);
  EXPECT_EQ(number_in(stopped, "waiting"), 2);
  EXPECT_FALSE(complete(folder_));
  EXPECT_EQ(call(fmt::format("ctl {} status", folder_.string())), 75);
  EXPECT_TRUE(has(output(), "\"resumable\": true")) << output();
  EXPECT_TRUE(has(errors(), ": `tread develop ") && has(errors(), "2.4 ms'` goes on")) << errors();
  EXPECT_EQ(call(fmt::format("ctl {} status", (root_ / "whole").string())), 0) << errors();
  EXPECT_TRUE(has(output(), "\"resumable\": false")) << output();
}

TEST_F(Develop, RowsAcrossTheRailWearByThemselves) {
  const std::string fine = "--set \"scene.element_size=4 mm\"";
  const std::string rows = kCorrugation + kWear + "across = true\n";
  ASSERT_EQ(call(develop(folder_ / "rows", 1, rows, fine)), 0) << errors();
  EXPECT_TRUE(has(content_of(folder_ / "rows/profiles/0001.txt"), "# x [m]  y [m]  d [m]"));
  EXPECT_TRUE(fs::exists(folder_ / "rows/figures/rows.svg"));
  // The same command adds a passage over the map; the rows of earlier passages are known.
  ASSERT_EQ(call(develop(folder_ / "rows", 2, rows, fine)), 0) << errors();
  EXPECT_TRUE(has(content_of(folder_ / "rows/passage-0002/scene.resolved.toml"), "kind = \"map\""));
  // Few passages keep the parabola nearly; differences within two elements across are left out.
  ASSERT_EQ(call(develop(folder_ / "parabola", 2, kCorrugation + kWear, fine)), 0) << errors();
  const auto growth = [&](const char* folder) {
    const JsonRecord result = read_json(folder_ / folder / "development.json");
    return number_in(result, "bands.0.growth_of_profile_per_passage").value();
  };
  EXPECT_NEAR(growth("rows"), growth("parabola"), 0.2 * std::abs(growth("parabola")));
}

TEST_F(Develop, GoesOnWhereItWasStopped) {
  const std::string scene = kCorrugation + kWear;
  const pid_t process = start(develop(folder_, 2, scene));
  ASSERT_TRUE(
      wait_until([&] { return has(content_of(folder_ / "passage-0001/status.json"), "\"rolling\""); }));
  ::kill(process, SIGTERM);
  EXPECT_EQ(wait_for(process), 75) << errors();
  EXPECT_TRUE(has(errors(), "the same command goes on")) << errors();
  const auto smooth = fs::last_write_time(folder_ / "work/0000.csv");

  ASSERT_EQ(call(develop(folder_, 1, scene)), 0) << errors();
  ASSERT_EQ(call(develop(folder_, 2, scene)), 0) << errors();
  EXPECT_EQ(fs::last_write_time(folder_ / "work/0000.csv"), smooth);
  for (const char* name : {"profiles/0002.txt", "profiles.csv", "spectra.csv", "growth.csv"})
    EXPECT_TRUE(content_of(folder_ / name) == content_of(root_ / "whole" / name)) << name;

  EXPECT_EQ(call(develop(folder_, 2, scene, "--set wear.change=0.02")), 2);
  EXPECT_TRUE(has(errors(), "another scene: wear.change is 0.02 here and 0.05 there")) << errors();
}

TEST_F(Develop, Passage0HasRoomForAllPassages) {
  EXPECT_EQ(call(develop(folder_, 120, kCorrugation + kWear + "[stop]\nwall_time = \"1 ms\"\n")), 75);
  const Scene smooth = read_scene(folder_ / "passage-0000/scene.resolved.toml");
  EXPECT_GT(smooth.contact->depth_room.value(), 0.2e-3) << errors();
}

/// As where the development began with few passages, and its waves have grown.
TEST_F(Develop, APassageDeeperThanTheRoomIsRefusedBeforeItRolls) {
  fs::copy(root_ / "whole", folder_, fs::copy_options::recursive);
  const fs::path kept = folder_ / "passage-0000/scene.resolved.toml";
  std::string text = content_of(kept);
  const std::size_t at = text.find("depth_room = ");
  ASSERT_NE(at, std::string::npos);
  text.replace(at, text.find('\n', at) - at, "depth_room = \"0.001 mm\"");
  std::ofstream(kept) << text;
  EXPECT_EQ(call(develop(folder_, 3, kCorrugation + kWear)), 2);
  EXPECT_TRUE(has(errors(), "passage 0 has room for 0.001 mm; begin in another folder")) << errors();
  EXPECT_FALSE(fs::exists(folder_ / "passage-0003"));
}

/// A passage's scene names the profile under it by its path; its contents count.
TEST_F(Develop, APassageOfAMovedFolderIsKnown) {
  fs::copy(root_ / "whole", folder_, fs::copy_options::recursive);
  const std::string work = content_of(folder_ / "work/0002.csv");
  fs::remove(folder_ / "work/0002.csv");
  EXPECT_EQ(call(develop(folder_, 2, kCorrugation + kWear)), 0) << errors();
  EXPECT_EQ(content_of(folder_ / "work/0002.csv"), work);
}

TEST_F(Develop, APassageOfAnotherProfileSaysWhatToRemove) {
  fs::copy(root_ / "whole", folder_, fs::copy_options::recursive);
  fs::remove(folder_ / "work/0002.csv");
  fs::remove_all(folder_ / "passage-0002");
  fs::copy(folder_ / "passage-0000", folder_ / "passage-0002", fs::copy_options::recursive);
  EXPECT_EQ(call(develop(folder_, 2, kCorrugation + kWear)), 2);
  EXPECT_TRUE(has(errors(), "passage-0002 holds another run")) << errors();
  EXPECT_TRUE(has(errors(), "remove that folder, and this passage begins anew")) << errors();
}

TEST_F(Develop, BeginsWithTheStateOfAnotherRun) {
  const std::string from = fmt::format("--from {}", (root_ / "whole/passage-0000").string());
  ASSERT_EQ(call(develop(folder_, 1, kCorrugation + kWear, from)), 0) << errors();
  EXPECT_FALSE(fs::exists(folder_ / "passage-0000/forks"));
  for (const char* name : {"work/0000.csv", "work/0001.csv", "profiles/0001.txt"})
    EXPECT_TRUE(content_of(folder_ / name) == content_of(root_ / "whole" / name)) << name;
}

TEST_F(Develop, ForgetsAStartThatFailed) {
  EXPECT_EQ(call(develop(folder_, 1, kCorrugation + kWear, "--from elsewhere")), 2) << errors();
  ASSERT_EQ(call(develop(folder_, 1, kCorrugation + kWear)), 0) << errors();
  EXPECT_FALSE(fs::exists(folder_ / "from.txt"));
}

TEST_F(Develop, KeepsWhatItBeganWith) {
  const std::string from = fmt::format("--from {}", (root_ / "whole/passage-0000").string());
  ASSERT_EQ(call(develop(folder_, 1, kCorrugation + kWear, from)), 0) << errors();
  EXPECT_EQ(call(develop(folder_, 2, kCorrugation + kWear, "--from elsewhere")), 2);
  EXPECT_TRUE(has(errors(), "began with")) << errors();
  EXPECT_EQ(call(develop(folder_, 2, kCorrugation + kWear, "--device emulated")), 0) << errors();
  EXPECT_TRUE(has(content_of(folder_ / "passage-0002/report.html"), "fork of"));
  EXPECT_TRUE(has(content_of(folder_ / "passage-0002/summary.json"), "emulated"));
}

TEST_F(Develop, ALauncherStartsThePassages) {
  expect_refused(kCorrugation + kWear, "--launcher: there is no program 'no-such-program' in PATH",
                 "--launcher no-such-program");
  const fs::path launcher = root_ / "launcher";
  std::ofstream(launcher) << "#!/bin/sh\nshift\necho \"$@\" >>" << (root_ / "calls").string()
                          << "\nexec \"$@\"\n";
  fs::permissions(launcher, fs::perms::owner_all);
  const std::string stopped = "[stop]\nwall_time = \"1 ms\"\n";
  EXPECT_EQ(call(develop(folder_, 1, kCorrugation + kWear + stopped,
                         fmt::format("--launcher \"{} -N1\"", launcher.string()))),
            75)
      << errors();
  const std::string calls = content_of(root_ / "calls");
  EXPECT_TRUE(has(calls, "tread run ") && has(calls, "/passage-0000")) << calls;
  EXPECT_FALSE(has(calls, " -t ")) << calls;
}

TEST_F(Develop, AStoppedPassageIsNoFailure) {
  EXPECT_EQ(call(develop(folder_, 1, kCorrugation + kWear + "[stop]\nwall_time = \"1 ms\"\n")), 75);
  EXPECT_TRUE(has(errors(), "nothing is lost")) << errors();
}

/// As where no more than the state is left of a run.
TEST_F(Develop, TheRunItBeginsWithNeedsAStateAndRoomForTheCorrugation) {
  const fs::path other = root_ / "other";
  fs::create_directories(other);
  const std::string from = "--from " + other.string();
  expect_refused(kCorrugation + kWear, "other has no state to begin with", from);
  fs::copy(root_ / "whole/passage-0000/forks", other / "forks");
  std::string deep = kCorrugation;
  deep.replace(deep.find("2 um"), 4, "400 um");
  expect_refused(deep + kWear, "and the run there has room for 0.2 mm", from);
  EXPECT_FALSE(fs::exists(folder_));
}

TEST_F(Develop, AStatedStateIsBeforeTheCorrugation) {
  expect_refused(kCorrugation + kWear + "[forks]\nat = \"2 ms\"\n",
                 "tread develop: forks.at = 2 ms: all passages begin with the state of that time");
  EXPECT_TRUE(has(errors(), " ms; state at most ")) << errors();
  EXPECT_FALSE(fs::exists(folder_));
  const std::string early = "[forks]\nat = \"0.4 ms\"\n[stop]\nwall_time = \"1 ms\"\n";
  EXPECT_EQ(call(develop(folder_, 1, kCorrugation + kWear + early)), 75) << errors();
}

TEST_F(Develop, RefusesWhatItCannotDevelop) {
  expect_refused(kCorrugation, "the scene has no [wear]");
  expect_refused(kWear, "the scene has no [corrugation]");
  expect_refused(kCorrugation + kWear, "state \"gap\"", "--set corrugation.apply=nodes");
  expect_refused(kCorrugation + kWear, "is below 4 elements, 32 mm", "--set \"wear.shortest=31 mm\"");
  expect_refused(kCorrugation + kWear, "more than the corrugation's length", "--set \"wear.longest=73 mm\"");
  expect_refused(kCorrugation + kWear, "motion.duration must be 2.297 ms", "--set \"motion.duration=2 ms\"");
  expect_refused(kCorrugation + kWear, "tread develop: solution_zone.start = 20 mm: all passages begin",
                 "--set \"solution_zone.start=20 mm\"");
  EXPECT_FALSE(fs::exists(folder_));
  expect_refused(kCorrugation + kWear, "not shorter than the longest", "--set \"wear.longest=32 mm\"");
  expect_refused(kCorrugation + kWear, "has an effect only with corrugation.kind = \"sine\" or \"random\"",
                 "--set corrugation.kind=table");
}

}  // namespace
}  // namespace tread
