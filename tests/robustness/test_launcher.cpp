// Launchers that hide the end of a run from its study: exit codes of their own, signals kept to themselves.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <csignal>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include "drivers/run/run_folder.hpp"
#include "drivers/studies/study/point_folder.hpp"
#include "io/files/checkpoint_folder.hpp"
#include "io/text/json.hpp"
#include "tests/program.hpp"

namespace tread {
namespace {

namespace fs = std::filesystem;
using samples::content_of;
using samples::has;

/// A point's folder with a checkpoint's order, and a status.
class PointFolder : public testing::Test {
 protected:
  PointFolder() { fs::create_directories(folder() / "checkpoint"), write("checkpoint/order.h5", ""); }
  const fs::path& folder() const { return program_.folder; }
  void write(const std::string& name, const std::string& text) const { program_.write(name, text); }
  void show(const std::string& stage) const {
    write("status.json", fmt::format("{{\"stage\": \"{}\"}}\n", stage));
  }
  bool stopped(ProcessEnd end, bool told = false, const std::string& before = "") const {
    return was_stopped(folder(), {end, told, before});
  }

  samples::Program program_;
};

TEST_F(PointFolder, TellsOfAStopThatTheExitCodeHides) {
  show("stopped");
  for (const ProcessEnd end : {ProcessEnd{75, 0}, {124, 0}, {143, 0}, {1, 0}, {0, SIGTERM}, {0, SIGKILL}})
    EXPECT_TRUE(stopped(end)) << end.code << " " << end.signal;
  // The status of an earlier process says nothing of a launcher that cannot start the run.
  EXPECT_FALSE(stopped({127, 0}, false, content_of(folder() / "status.json")));
  show("failed");
  for (const ProcessEnd end : {ProcessEnd{3, 0}, {124, 0}, {143, 0}})
    EXPECT_FALSE(stopped(end, true)) << end.code;
  show("preload");  // a signal before the first step leaves the stage
  for (const int code : {124, 129, 130, 143}) EXPECT_TRUE(stopped({code, 0})) << code;
  for (const int code : {1, 2, 127, 137}) EXPECT_FALSE(stopped({code, 0})) << code;
}

TEST_F(PointFolder, SignalsOfTheStudysOwnStopAreNoFailure) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGUSR2, SIGXCPU}) {
    EXPECT_TRUE(stopped({0, signal}, true)) << signal;
    EXPECT_FALSE(stopped({0, signal}, false)) << signal;
  }
  EXPECT_FALSE(stopped({0, SIGKILL}, true));
  EXPECT_TRUE(stopped({1, 0}, true));  // of srun that waits for its place
  EXPECT_FALSE(stopped({2, 0}, true));
}

TEST_F(PointFolder, AnotherAttemptKeepsTheCheckpointUnlessTheRunItselfFailed) {
  for (const auto& [code, anew] : {std::pair(2, true), {3, true}, {4, false}, {1, false}, {137, false}}) {
    note_end(folder(), {{code, 0}});
    const PointStatus status = look_into(folder(), {});
    EXPECT_EQ(status.state, PointState::failed) << code;
    EXPECT_EQ(status.anew, anew) << code;
  }
  // An earlier version wrote so of a stop.
  write("failed.json", "{\"exit\": 124, \"signal\": 0, \"why\": \"exit 124\", \"anew\": true}\n");
  EXPECT_FALSE(look_into(folder(), {}).anew);
  note_end(folder(), {{0, SIGKILL}});
  EXPECT_TRUE(has(look_into(folder(), {}).why, "memory is short"));
  note_end(folder(), {{0, SIGTERM}});
  EXPECT_FALSE(has(look_into(folder(), {}).why, "memory is short"));
}

/// Processes append to log.txt; a launcher may end a run that says nothing itself.
TEST_F(PointFolder, TheReasonIsTheLastErrorOfTheLastProcess) {
  const std::string older = "[mesh] begins\ntread: the older error\n";
  const auto reason = [&](const std::string& text) {
    write("log.txt", older + text);
    note_end(folder(), {{2, 0}, false, "", static_cast<std::int64_t>(older.size())});
    return look_into(folder(), {}).why;
  };
  write("log.txt", older);
  EXPECT_EQ(log_bytes(folder()), static_cast<std::int64_t>(older.size()));
  EXPECT_EQ(reason(""), "exit 2: see log.txt in its folder");
  EXPECT_EQ(reason("srun: error: no node\n"), "exit 2: see log.txt in its folder");
  EXPECT_EQ(reason("tread: the newer error:\n  its second line\n"),
            "exit 2: the newer error:   its second line");
  EXPECT_EQ(reason("tread run: output is missing; `tread run --help` shows how\n"),
            "exit 2: output is missing; `tread run --help` shows how");
  EXPECT_EQ(reason("rank 1: tread: no memory\ntread: warning: 9 threads on 2 cores\n"), "exit 2: no memory");
  EXPECT_EQ(reason("tread: warning: 9 threads on 2 cores\n"), "exit 2: see log.txt in its folder");
  fs::remove(folder() / "log.txt");
  EXPECT_EQ(log_bytes(folder()), 0);
}

class Launcher : public testing::Test {
 protected:
  /// A tyre that rolls for some seconds, unless it is stopped.
  fs::path tyre() const {
    return program_.write("study.toml",
                          fmt::format(R"([study]
scene = "{}"
[set]
scene.element_size = "6 mm"
motion.duration = "5 ms"
output.progress_interval = "10 ms"
[grid]
motion.traction.mu = [0.1]
)",
                                      (fs::path(TREAD_SOURCE_DIR) / "scenes/tyre.toml").string()));
  }
  std::string launcher(const std::string& lines) const {
    const fs::path path = program_.write("launcher", "#!/bin/bash\n" + lines);
    fs::permissions(path, fs::perms::owner_all);
    return fmt::format("--launcher {}", path.string());
  }
  std::string command(const std::string& more) const {
    return fmt::format("sweep {} -o {} -t 1 {}", tyre().string(), runs_.string(), more);
  }
  int sweep(const std::string& more = "") const { return program_.call(command(more)); }
  std::string errors() const { return program_.errors(); }
  bool rolls() const { return has(content_of(point_ / "status.json"), "\"rolling\""); }

  samples::Program program_;
  fs::path runs_ = program_.folder / "runs";
  fs::path point_ = runs_ / "mu=0.1";
};

TEST_F(Launcher, ItsExitCodeDoesNotFailAStoppedRun) {
  const std::string stops =
      launcher(fmt::format("\"$@\" & run=$!\nuntil grep -q '\"rolling\"' {}; do sleep 0.02; done\n"
                           "kill -TERM $run; wait $run; exit 143\n",
                           (point_ / "status.json").string()));
  EXPECT_EQ(sweep(stops), 75) << errors();
  EXPECT_TRUE(has(errors(), "[mu=0.1] interrupted after")) << errors();
  EXPECT_FALSE(fs::exists(point_ / "failed.json"));
  EXPECT_FALSE(CheckpointFolder(point_ / "checkpoint").states().empty());
  ASSERT_EQ(sweep("--retry"), 0) << errors();
  EXPECT_TRUE(has(errors(), "[mu=0.1] goes on")) << errors();
}

TEST_F(Launcher, AStopReachesTheRunBehindADeafLauncher) {
  const pid_t study = program_.start(command(launcher("\"$@\"\n")));
  ASSERT_TRUE(samples::wait_until([&] { return rolls(); })) << errors();
  ::kill(study, SIGTERM);
  EXPECT_EQ(samples::wait_for(study), 75) << errors();
  EXPECT_FALSE(is_taken(point_));
  EXPECT_EQ(text_in(read_json(point_ / "status.json"), "stage"), "stopped");
  EXPECT_FALSE(CheckpointFolder(point_ / "checkpoint").states().empty());
  EXPECT_FALSE(is_pending(point_));
  ASSERT_EQ(sweep(), 0) << errors();
}

/// As mpirun, which gives its ranks a second: too short for the checkpoint of a large mesh.
TEST_F(Launcher, AStopLeavesTheRunTimeForItsCheckpoint) {
  const pid_t study =
      program_.start(command(launcher("\"$@\" &\ntrap 'kill -KILL $!' TERM\nwait $!; exit $?\n")));
  ASSERT_TRUE(samples::wait_until([&] { return rolls(); })) << errors();
  ::kill(study, SIGTERM);
  EXPECT_EQ(samples::wait_for(study), 75) << errors();
  EXPECT_EQ(text_in(read_json(point_ / "status.json"), "stage"), "stopped");
}

TEST_F(Launcher, ASignalToTheStudyAndItsStartingRunsStops) {
  for (const char* signal : {"TERM", "INT", "HUP"}) {
    EXPECT_EQ(sweep(launcher(fmt::format("kill -{0} $PPID; kill -{0} $$\nsleep 10\n", signal))), 75)
        << errors();
    EXPECT_TRUE(has(errors(), "stopped by SIG")) << errors();
    EXPECT_FALSE(fs::exists(point_ / "failed.json")) << content_of(point_ / "failed.json");
  }
}

}  // namespace
}  // namespace tread
