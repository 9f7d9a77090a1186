// A run that begins with the state of another one is the run that its scene makes from the start.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "io/files/checkpoint_folder.hpp"
#include "tests/program_test.hpp"

namespace tread {
namespace {

namespace fs = std::filesystem;
using namespace samples;

class Fork : public ProgramTest {
 protected:
  static void SetUpTestSuite() {
    make_root();
    write_scene("smooth.toml", "");
    write_scene("sine.toml",
                "[corrugation]\nwavelength = \"20 mm\"\ndepth = \"0.02 mm\"\nstart = \"0.13 m\"\n"
                "length = \"60 mm\"\napply = \"gap\"\n");
    write_scene(
        "table.toml",
        "[corrugation]\nkind = \"table\"\nfile = \"depth.txt\"\nstart = \"0.12 m\"\napply = \"gap\"\n");
    std::ofstream(root_ / "depth.txt") << "# x [mm]  d [mm]\n0 0\n4 0\n20 0.03\n32 0.01\n50 0.04\n60 0\n";
    ASSERT_EQ(call(run("smooth.toml", root_ / "smooth")), 0) << errors();
    ASSERT_EQ(call(run("sine.toml", root_ / "sine")), 0) << errors();
  }
  void TearDown() override { fs::remove_all(folder_); }

  static void write_scene(const char* name, const char* more) {
    std::ofstream(root_ / name) << content_of(kTyre) << more << "[forks]\n";
  }
  /// Arguments of `tread run`.
  static std::string run(const std::string& scene, const fs::path& folder, const std::string& more = "",
                         int threads = 1) {
    return fmt::format(
        "run {} -t {} -o {} --set \"scene.element_size=8 mm\" --set \"motion.duration=2.2 ms\" {}",
        (root_ / scene).string(), threads, folder.string(), more);
  }
  std::string from(const std::string& scene, const std::string& other, const std::string& more = "",
                   int threads = 1) const {
    return run(scene, folder_, fmt::format("--from {} {}", (root_ / other).string(), more), threads);
  }
  void expect_refused(const std::string& arguments, const std::string& reason) const {
    EXPECT_EQ(call(arguments), 2) << arguments;
    EXPECT_TRUE(has(errors(), reason)) << reason << " is not in: " << errors();
  }

  fs::path folder_ = root_ / "fork";
};

TEST_F(Fork, OfTheSameSceneIsTheSameRunOnOtherThreads) {
  ASSERT_EQ(call(from("sine.toml", "sine", "", 2)), 0) << errors();
  EXPECT_TRUE(has(errors(), "[fork] from")) << errors();
  expect_same_run(root_ / "sine", folder_);
  EXPECT_FALSE(fs::exists(folder_ / "forks"));
  EXPECT_TRUE(
      has(content_of(folder_ / "summary.json"), fmt::format("\"from\": \"{}/sine\"", root_.string())));
  EXPECT_TRUE(has(content_of(folder_ / "report.html"), "fork of"));
}

/// A fork on a device, with frames, that is stopped and resumed there.
TEST_F(Fork, OnADeviceIsTheSameRun) {
  const std::string there =
      "--device emulated --set output.frames=3 --set \"motion.duration=0.6 ms\" --set \"forks.at=0.3 ms\"";
  ASSERT_EQ(call(run("smooth.toml", root_ / "device", there)), 0) << errors();
  EXPECT_EQ(call(from("smooth.toml", "device", there + " --set stop.steps=600")), 4);
  const std::string way_on =
      fmt::format("`tread resume {} --set stop.steps=0 --device emulated` goes on", folder_.string());
  EXPECT_TRUE(has(errors(), way_on)) << errors();
  fs::copy(folder_, root_ / "elsewhere", fs::copy_options::recursive);
  EXPECT_EQ(call(fmt::format("resume {} -t 1", (root_ / "elsewhere").string())), 4);
  EXPECT_TRUE(has(errors(), "(--device emulated goes on there)")) << errors();
  EXPECT_EQ(call(fmt::format("resume {} -t 1 --device emulated --set stop.steps=0", folder_.string())), 0)
      << errors();
  expect_same_run(root_ / "device", folder_);
}

TEST_F(Fork, FilesThatGoOnCarryTheNewScene) {
  ASSERT_EQ(call(from("sine.toml", "smooth", "--set scene.title=other")), 0) << errors();
  for (const char* name : {"run.h5", "patch.h5", "surface.h5"})
    EXPECT_EQ(Hdf5File::open_to_read(folder_ / name).read_text_attribute("/", "title"), "other") << name;
}

TEST_F(Fork, OverAnotherCorrugationIsTheRunFromTheStart) {
  // The state of a smooth rail lies 20 mm before the solution zone, x = 0.1 m.
  for (const char* scene : {"sine", "table"}) {
    const std::string file = fmt::format("{}.toml", scene);
    if (!fs::exists(root_ / scene)) {
      ASSERT_EQ(call(run(file, root_ / scene)), 0) << errors();
    }
    ASSERT_EQ(call(from(file, "smooth")), 0) << errors();
    expect_same_run(root_ / scene, folder_);
    fs::remove_all(folder_);
  }
  EXPECT_FALSE(content_of(root_ / "smooth/histories.csv") == content_of(root_ / "sine/histories.csv"));
  EXPECT_FALSE(content_of(root_ / "table/histories.csv") == content_of(root_ / "sine/histories.csv"));
}

TEST_F(Fork, CanBeKilledAndResumedWithoutTheOtherRun) {
  fs::copy(root_ / "smooth", root_ / "copy", fs::copy_options::recursive);
  EXPECT_EQ(call(from("sine.toml", "copy", "--set stop.steps=1200")), 4) << errors();
  fs::remove_all(root_ / "copy");
  EXPECT_EQ(call(fmt::format("resume {} -t 2 --set stop.steps=0", folder_.string())), 0) << errors();
  expect_same_run(root_ / "sine", folder_);
}

TEST_F(Fork, ThatHasLostItsStatesDoesNotBeginAtTheStart) {
  ASSERT_EQ(call(from("sine.toml", "smooth", "--set stop.steps=1010")), 4) << errors();
  const auto states = CheckpointFolder(folder_ / "checkpoint").states();
  ASSERT_FALSE(states.empty());
  for (const fs::path& state : states) fs::remove(state);
  EXPECT_EQ(call("resume " + folder_.string()), 2);
  EXPECT_TRUE(has(errors(), "has lost the states of its fork")) << errors();
}

TEST_F(Fork, ASignalBeforeItsFirstStepNamesResume) {
  const pid_t process = start(from("sine.toml", "smooth"));
  for (int i = 0; i < 100'000 && !has(errors(), "[fork] from"); ++i) ::usleep(200);
  ::kill(process, SIGINT);  // in most cases before the first step
  EXPECT_EQ(wait_for(process), 75) << errors();
  EXPECT_TRUE(has(errors(), fmt::format("`tread resume {}` goes on", folder_.string()))) << errors();
}

TEST_F(Fork, EndsEarlierWhereItsSceneSaysSo) {
  EXPECT_EQ(call(from("sine.toml", "smooth", "--set \"motion.duration=1.6 ms\"")), 0) << errors();
  const std::string histories = content_of(folder_ / "histories.csv");
  EXPECT_TRUE(content_of(root_ / "sine/histories.csv").starts_with(histories));
  EXPECT_TRUE(has(content_of(folder_ / "scene.resolved.toml"), "duration = \"0.0016 s\""));
}

TEST_F(Fork, TakesTheLastStateUpToTheTime) {
  // An unfinished run has checkpoints, too.
  const fs::path other = root_ / "unfinished";
  EXPECT_EQ(call(run("smooth.toml", other, "--set stop.steps=1000")), 4) << errors();
  ASSERT_EQ(CheckpointFolder(other / "forks").states().size(), 1U);
  const fs::path kept = CheckpointFolder(other / "forks").states().front();
  EXPECT_EQ(call(from("sine.toml", "unfinished@5ms", "--set stop.steps=1010")), 4) << errors();
  EXPECT_TRUE(has(errors(), "(step 1000)")) << errors();
  fs::remove_all(folder_);
  EXPECT_EQ(call(from("sine.toml", "unfinished@0.8ms", "--set stop.steps=1010")), 4) << errors();
  EXPECT_TRUE(has(errors(), fmt::format("(step {})", std::stoi(kept.stem().string().substr(5))))) << errors();
  fs::remove_all(folder_);
  expect_refused(from("sine.toml", "smooth@0.1ms"), "no state up to 0.1 ms");
  expect_refused(from("sine.toml", "smooth@often"), "such as out@10ms");
  expect_refused(from("sine.toml", "absent"), fmt::format("there is no folder {}/absent", root_.string()));
  fs::create_directory(root_ / "empty");
  expect_refused(from("sine.toml", "empty"), "has no state to begin with");
  fs::resize_file(kept, 4000);
  EXPECT_EQ(call(from("sine.toml", "unfinished@0.8ms", "--set stop.steps=1010")), 4) << errors();
  EXPECT_TRUE(has(errors(), "it has 4000 of") && has(errors(), "(step 0)")) << errors();
}

TEST_F(Fork, DamagedStatesAreNamedInTheError) {
  fs::copy(root_ / "smooth", root_ / "damaged", fs::copy_options::recursive);
  const auto states = CheckpointFolder(root_ / "damaged/forks").states();
  ASSERT_FALSE(states.empty());
  for (const fs::path& state : states)
    std::fstream(state, std::ios::in | std::ios::out | std::ios::binary).seekp(5000).put('x');
  expect_refused(from("sine.toml", "damaged", "--quiet"),
                 fmt::format("in {}/damaged is of use: cannot use {}: it is damaged", root_.string(),
                             states.front().string()));
}

TEST_F(Fork, AFolderThatCannotBeReadIsNamed) {
  fs::create_directories(root_ / "closed");
  std::ofstream(root_ / "closed/checkpoint") << "not a folder";
  expect_refused(from("sine.toml", "closed"),
                 fmt::format("tread: cannot read {}/closed/checkpoint: Not a directory", root_.string()));
  EXPECT_FALSE(has(errors(), "of use"));
}

TEST_F(Fork, WhatTheStateDependsOnIsRefusedByName) {
  expect_refused(from("sine.toml", "smooth", "--set contact.friction=0.3 --set \"motion.speed=250 km/h\""),
                 "contact.friction (0.5 there, 0.3 here), motion.speed (300 km/h there, 250 km/h here)");
  expect_refused(from("sine.toml", "smooth", "--set corrugation.apply=nodes"), "corrugation.apply");
  expect_refused(from("sine.toml", "smooth", "--set \"corrugation.depth=0.3 mm\""), "contact.depth_room");
  expect_refused(from("sine.toml", "smooth", "--set \"contact.depth_room=0.3 mm\""), "leave it out");
  expect_refused(from("sine.toml", "smooth", "--set \"motion.duration=2.3 ms\""), "motion.duration = 2.3 ms");
  expect_refused(from("sine.toml", "sine", "--set \"corrugation.start=0.1 m\""), "the corrugations differ");
  EXPECT_FALSE(fs::exists(folder_ / "checkpoint"));
  expect_refused(run("sine.toml", root_ / "smooth", fmt::format("--from {}/smooth", root_.string())),
                 "a folder of its own");
  expect_refused(run("sine.toml", folder_, "--set \"forks.at=3 ms\""), "forks.at");
  expect_refused(
      run("sine.toml", folder_, "--set \"solution_zone.start=0.03 m\" --set \"corrugation.start=0.03 m\""),
      "state forks.at");
}

/// The run would end without it, and nothing would say so.
TEST_F(Fork, AStateThatIsNeverReachedIsRefused) {
  expect_refused(from("sine.toml", "smooth", "--set \"forks.at=0.1 ms\""),
                 "forks.at = 0.1 ms lies before t = ");
  EXPECT_FALSE(fs::exists(folder_ / "checkpoint"));
  expect_refused(run("sine.toml", folder_, "--set \"motion.duration=0.3 ms\""),
                 "after motion.duration = 0.3 ms; state a longer motion.duration, or an earlier forks.at");
}

TEST_F(Fork, RefusalsLeaveTheRunThatItWouldThrowAway) {
  fs::copy(root_ / "sine", folder_, fs::copy_options::recursive);
  const std::string over = "--overwrite --set ";
  expect_refused(from("sine.toml", "sine", over + "\"corrugation.start=0.1 m\""), "the corrugations differ");
  expect_refused(from("sine.toml", "smooth", over + "\"output.disk_limit=1 kB\""), "the run needs about");
  expect_refused(from("sine.toml", "smooth", over + "\"motion.duration=2.3 ms\""),
                 "motion.duration = 2.3 ms");
  expect_refused(from("smooth.toml", "smooth", over + "\"motion.duration=0.1 ms\""), "has already come to");
  for (const char* name : {"summary.json", "histories.csv", "status.json", "scene.resolved.toml"})
    EXPECT_TRUE(fs::exists(folder_ / name) && content_of(folder_ / name) == content_of(root_ / "sine" / name))
        << name;
  EXPECT_TRUE(fs::exists(folder_ / "forks"));
}

/// Values of two places in one column would have a jump, and their rates a spike.
TEST_F(Fork, AProbeThatHasMovedHasNoPast) {
  const auto probes = [](const char* moved, int steps) {
    return fmt::format("--set \"probe.moved.x={}\" --set \"probe.still.x=0.1 m\" --set stop.steps={}", moved,
                       steps);
  };
  const fs::path other = root_ / "probed";
  ASSERT_EQ(call(run("smooth.toml", other, probes("0.1 m", 1000))), 4) << errors();
  ASSERT_EQ(call(from("smooth.toml", "probed", probes("0.12 m", 1100))), 4) << errors();
  const auto column = [](const fs::path& folder, const char* name) {
    return Hdf5File::open_to_read(folder / "run.h5").read<double>(fmt::format("/histories/{}", name));
  };
  const std::size_t past = column(other, "time").size();
  const std::vector<double> velocity = column(folder_, "moved_velocity_z"),
                            acceleration = column(folder_, "moved_acceleration_z"),
                            still = column(folder_, "still_velocity_z");
  ASSERT_GT(velocity.size(), past + 1);
  for (std::size_t i = 0; i < velocity.size(); ++i) {
    EXPECT_EQ(std::isnan(velocity[i]), i < past) << i;
    EXPECT_EQ(std::isnan(acceleration[i]), i <= past) << i;
    EXPECT_FALSE(std::isnan(still[i])) << i;
  }
}

/// Names of files that stay the same hide what changed in them.
TEST_F(Fork, OtherContentsOfFilesAreRefusedByName) {
  const fs::path rail = root_ / "rail.txt";
  std::ofstream(rail) << "# x [mm]  d [um]\n0 0\n20 3\n40 0\n";
  write_scene("dip.toml", "[surface.dip]\nkind = \"profile\"\nat = \"20 mm\"\nfile = \"rail.txt\"\n");
  ASSERT_EQ(call(run("dip.toml", root_ / "dip", "--set stop.steps=1000")), 4) << errors();
  std::ofstream(rail) << "# x [mm]  d [um]\n0 0\n20 4\n40 0\n";
  expect_refused(from("dip.toml", "dip"),
                 fmt::format("surface.dip.file (another content of {})", rail.string()));
}

}  // namespace
}  // namespace tread
