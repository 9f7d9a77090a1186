// Runs on several processes that mpirun starts: the files of one process, on any number of them, resumed on
// another number, after a rank was lost. More ranks than cores yield to one another.

#include <fmt/core.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "drivers/process/launched_ranks.hpp"
#include "drivers/run/run_folder.hpp"
#include "io/files/checkpoint_folder.hpp"
#include "tests/program_test.hpp"

namespace tread {
namespace {

namespace fs = std::filesystem;
using namespace samples;

int times(const std::string& text, const std::string& part) {
  int count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

class LaunchedRanks : public ProgramTest {
 protected:
  static void SetUpTestSuite() { make_root(); }
  void SetUp() override {
    if (rank_library().empty()) GTEST_SKIP() << "built without MPI";
    if (std::system("command -v mpirun >/dev/null") != 0) GTEST_SKIP() << "there is no mpirun";
  }
  void TearDown() override { fs::remove_all(folder_); }

  static pid_t start_on(int ranks, const std::string& arguments) {
    return start_program(arguments, root_, kEnvironment, fmt::format("mpirun -n {}", ranks));
  }
  static int call_on(int ranks, const std::string& arguments) { return wait_for(start_on(ranks, arguments)); }

  static std::string run(const fs::path& folder, const std::string& more = "") {
    return fmt::format("run {} -t 1 -o {} {} {}", shell_word(kTyre), folder.string(), kSize, more);
  }

  /// A run that an error ends after some samples: two ranks leave those of one process, and tell of it once.
  void expect_the_same_end(const std::string& options, const std::string& error) const {
    const fs::path alone = root_ / "alone";
    EXPECT_EQ(call(run(alone, options)), 3) << errors();
    const std::string histories = content_of(alone / "histories.csv");
    EXPECT_EQ(call_on(2, run(folder_, options)), 3) << errors();
    EXPECT_EQ(times(errors(), error), 1) << errors();
    EXPECT_GT(times(histories, "\n"), 50);
    EXPECT_EQ(content_of(folder_ / "histories.csv"), histories);
    fs::remove_all(alone);
  }

  /// Starts a run on three ranks and waits until it has a checkpoint of its rolling.
  static pid_t start_rolling(const fs::path& folder) {
    const pid_t process = start_on(3, run(folder, kLong + "--set \"output.progress_interval=10 ms\""));
    EXPECT_TRUE(wait_until([&] { return has(content_of(folder / "status.json"), "\"rolling\""); }))
        << errors();
    leave_request(folder, RunRequest::checkpoint);
    EXPECT_TRUE(wait_until([&] { return CheckpointFolder(folder / "checkpoint").states().size() == 2; }));
    return process;
  }

  /// The process that mpirun has started besides the one that status.json names.
  static pid_t other_rank(pid_t launcher, const fs::path& folder) {
    const std::string status = content_of(folder / "status.json");
    for (const auto& entry : fs::directory_iterator("/proc")) {
      const pid_t process = std::atoi(entry.path().filename().c_str());
      std::ifstream stat(entry.path() / "stat");
      std::string number, name, state;
      pid_t parent = 0;
      if (process > 0 && stat >> number >> name >> state >> parent && parent == launcher &&
          !has(status, fmt::format("\"process\": {}", process)))
        return process;
    }
    return 0;
  }

  static constexpr const char* kEnvironment =
      "export TREAD_CACHE=off OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 "
      "OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_mpi_yield_when_idle=1;";
  static constexpr const char* kSize = "--set \"scene.element_size=8 mm\"";
  /// Steps take long enough for a request.
  static inline const std::string kLong = "--set \"scene.element_size=5 mm\" ";
  fs::path folder_ = root_ / "shared";
};

std::string of_precision(const std::string& precision) {
  return fmt::format("--precision {} --set output.frames=4 --set \"motion.duration=0.15 ms\"", precision);
}

TEST_F(LaunchedRanks, FilesAreThoseOfOneProcess) {
  for (const auto& [precision, counts] : std::vector<std::pair<std::string, std::vector<int>>>{
           {"double", {2, 3, 4, 7}}, {"mixed", {3}}, {"single", {2}}}) {
    const fs::path one = root_ / precision;
    ASSERT_EQ(call(run(one, of_precision(precision))), 0) << errors();
    for (const int count : counts) {
      ASSERT_EQ(call_on(count, run(folder_, "--overwrite " + of_precision(precision))), 0) << errors();
      EXPECT_TRUE(has(errors(), fmt::format("[ranks] {} ranks, threads of each: 1", count))) << errors();
      EXPECT_TRUE(has(content_of(folder_ / "report.html"),
                      fmt::format("of each of {} ranks; instruction set", count)));
      expect_same_run(one, folder_);
    }
  }
}

TEST_F(LaunchedRanks, StudyLaunchesItsRunsByMpirun) {
  std::ofstream(root_ / "study.toml") << fmt::format(
      "[study]\nscene = \"{}\"\n[set]\nscene.element_size = \"8 mm\"\nmotion.duration = \"0.15 ms\"\n"
      "[grid]\nmotion.traction.mu = [0.1, 0.3]\n",
      kTyre);
  const std::string study =
      fmt::format("sweep {} -t 1 --jobs 1 --no-share ", shell_word(root_ / "study.toml"));
  const fs::path alone = root_ / "points";
  ASSERT_EQ(call(study + "-o " + alone.string()), 0) << errors();
  ASSERT_EQ(call(study + "--launcher \"mpirun -n 2\" -o " + folder_.string(), kEnvironment), 0) << errors();
  for (const char* point : {"mu=0.1", "mu=0.3"}) {
    EXPECT_TRUE(has(content_of(folder_ / point / "log.txt"), "[ranks] 2 ranks")) << point;
    expect_same_run(alone / point, folder_ / point);
  }
}

TEST_F(LaunchedRanks, ResumedOnOtherNumbers) {
  const std::string short_run = "--set \"motion.duration=0.3 ms\"";
  ASSERT_EQ(call(run(root_ / "whole", short_run)), 0) << errors();
  EXPECT_EQ(call_on(3, run(folder_, short_run + " --set stop.steps=100")), 4);
  EXPECT_TRUE(has(errors(), "stop.steps = 100 ends the run here")) << errors();
  const std::string resume = fmt::format("resume {} -t 1 --set stop.steps=", folder_.string());
  EXPECT_EQ(call_on(2, resume + "201"), 4) << errors();
  EXPECT_EQ(call(resume + "222"), 4) << errors();
  EXPECT_EQ(call_on(4, resume + "0"), 0) << errors();
  expect_same_run(root_ / "whole", folder_);
}

/// A fork ends as the run that kept its state.
TEST_F(LaunchedRanks, ForkTheStateOfOneProcess) {
  const std::string forks = "--set \"motion.duration=0.15 ms\" --set \"forks.at=0.08 ms\"";
  ASSERT_EQ(call(run(root_ / "kept", forks)), 0) << errors();
  ASSERT_EQ(call_on(2, run(folder_, forks + " --from " + (root_ / "kept").string())), 0) << errors();
  EXPECT_TRUE(has(errors(), "[fork] from")) << errors();
  expect_same_run(root_ / "kept", folder_);
}

/// Files of ranks with a device each are those of two such ranks. One process says that it is another.
TEST_F(LaunchedRanks, WithADeviceEach) {
  const std::string emulated = "--device emulated --set \"motion.duration=0.15 ms\"";
  ASSERT_EQ(call_on(2, run(root_ / "two", emulated)), 0) << errors();
  EXPECT_TRUE(has(content_of(root_ / "two/summary.json"), "\"device\": \"emulated\"")) << errors();
  EXPECT_EQ(call_on(3, run(folder_, emulated + " --set stop.steps=100")), 4) << errors();
  const std::string resume = fmt::format("resume {} -t 1 --set stop.steps=0 ", folder_.string());
  fs::copy(folder_, root_ / "copy", fs::copy_options::recursive);
  EXPECT_EQ(
      call(fmt::format("resume {} -t 1 --set stop.steps=120 --device emulated", (root_ / "copy").string())),
      4);
  EXPECT_TRUE(has(errors(), "it was written by steps on the device emulated, of several ranks")) << errors();
  ASSERT_EQ(call_on(4, resume + "--device emulated"), 0) << errors();
  EXPECT_FALSE(has(errors(), "it was written by")) << errors();
  expect_same_run(root_ / "two", folder_);
}

TEST_F(LaunchedRanks, StoppedFromOutsideAndAfterTheLossOfARank) {
  ASSERT_EQ(call(run(root_ / "long", kLong)), 0) << errors();
  const pid_t stopped = start_rolling(folder_);
  leave_request(folder_, RunRequest::stop);
  EXPECT_EQ(wait_for(stopped), 75);
  EXPECT_TRUE(has(errors(), "by tread ctl; nothing is lost: `tread resume")) << errors();

  fs::remove_all(folder_);
  const pid_t launcher = start_rolling(folder_);
  const pid_t rank = other_rank(launcher, folder_);
  ASSERT_GT(rank, 0);
  ::kill(rank, SIGKILL);
  EXPECT_NE(wait_for(launcher), 0);
  EXPECT_TRUE(has(errors(), "a rank is lost; `tread resume")) << errors();
  EXPECT_EQ(call(fmt::format("resume {} -t 1", folder_.string())), 0) << errors();
  expect_same_run(root_ / "long", folder_);
}

/// Elements of a plastic wheel take longer than the first shares say.
TEST_F(LaunchedRanks, SharesByTimesLeaveTheFilesAlone) {
  const std::string plastic =
      kLong +
      "--set wheel.material=hard --set \"material.hard.youngs_modulus=210 GPa\" "
      "--set material.hard.poissons_ratio=0.3 --set \"material.hard.density=7850 kg/m3\" "
      "--set material.hard.law=j2 --set \"material.hard.yield_stress=800 MPa\" "
      "--set \"material.hard.isotropic_hardening=20 GPa\"";
  ASSERT_EQ(call(run(root_ / "one", plastic)), 0) << errors();
  ASSERT_EQ(call_on(2, run(folder_, plastic)), 0) << errors();
  EXPECT_TRUE(has(errors(), "shared anew by the ranks' times; elements of rank 0: ")) << errors();
  expect_same_run(root_ / "one", folder_);
}

TEST_F(LaunchedRanks, ProblemsAreToldOnce) {
  EXPECT_EQ(call_on(3, run(folder_, "--set motion.sped=3")), 2);
  EXPECT_EQ(times(errors(), "motion.sped"), 1) << errors();
  EXPECT_EQ(call_on(2, "check " + shell_word(kTyre)), 2);
  EXPECT_EQ(times(errors(), "tread check: ranks share the work of `run` and `resume` alone"), 1) << errors();
  EXPECT_EQ(call_on(2, run(folder_, "--device emulatd")), 2);
  EXPECT_EQ(times(errors(), "--device emulatd: "), 1) << errors();
  EXPECT_EQ(call_on(2, "version"), 0);
  EXPECT_EQ(times(output(), "mpirun, " + rank_library()), 1) << output();
}

/// Variables as another launcher sets them: this MPI sees one process.
TEST_F(LaunchedRanks, AnotherLaunchersProcessesAreRefused) {
  EXPECT_EQ(call("version", "export PMI_SIZE=2 PMI_RANK=0;"), 2);
  EXPECT_TRUE(has(errors(), "2 processes were started together, but the MPI of this program")) << errors();
  EXPECT_TRUE(has(errors(), "inherited the variable: unset PMI_SIZE")) << errors();
  EXPECT_EQ(call("version", "export PMI_SIZE=1 PMI_RANK=0;"), 0) << errors();
  EXPECT_EQ(call_on(1, "version"), 0) << errors();
}

/// All ranks know where the wheel is.
TEST_F(LaunchedRanks, TheEndOfTheTreadEndsAllRanks) {
  const std::string spins =
      "--set \"scene.element_size=16 mm\" --set wheel.bore=guided --set \"wheel.overhang=22 mm\" "
      "--set \"scene.gravity=0 m/s2\" --set \"motion.duration=1.5 ms\" "
      "--set \"motion.traction.torque=1000 kN m\"";
  expect_the_same_end(spins, "rolls beyond its tread; lengthen wheel.overhang");
}

/// Rank 0 alone has the points of the patch. A worn rail under a narrow wheel: the wheel's edges touch it.
TEST_F(LaunchedRanks, AnErrorThatRank0AloneMeetsEndsAllRanks) {
  const std::string worn =
      "--set \"scene.element_size=10 mm\" --set \"wheel.width=30 mm\" --set output.frames=0 "
      "--set surface.worn.kind=dent --set \"surface.worn.depth=1 mm\" --set \"surface.worn.length=80 mm\" "
      "--set \"surface.worn.width=60 mm\" --set \"surface.worn.at=0.06 m\" "
      "--set \"motion.duration=1.5 ms\"";
  expect_the_same_end(worn, "the end of the surface that is searched");
}

}  // namespace
}  // namespace tread
