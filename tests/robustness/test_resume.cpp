// Runs that are stopped, killed, resumed: nothing is lost, and the files are those of an uninterrupted run.

#include <fmt/core.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <new>
#include <optional>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "drivers/run/run_checkpoint.hpp"
#include "drivers/run/run_folder.hpp"
#include "drivers/run/run_scene.hpp"
#include "drivers/run/run_session.hpp"
#include "io/files/checkpoint_folder.hpp"
#include "tests/bar_scene.hpp"
#include "tests/program_test.hpp"

namespace tread {
namespace {

namespace fs = std::filesystem;
using namespace samples;

class Resume : public ProgramTest {
 protected:
  static void SetUpTestSuite() {
    make_root();
    ASSERT_EQ(call(run(root_ / "whole")), 0) << errors();
  }
  void TearDown() override { fs::remove_all(folder_); }

  /// Arguments of `tread run`.
  static std::string run(const fs::path& folder, const std::string& more = "") {
    return fmt::format("run {} -t 1 -o {} {} {} {}", shell_word(kTyre), folder.string(), kScene, kFrames,
                       more);
  }
  std::string resume(const std::string& more = "") const {
    return fmt::format("resume {} -t 1 {}", folder_.string(), more);
  }
  /// Starts a run and waits until it rolls.
  pid_t start_rolling() {
    const pid_t process = start(run(folder_, "--set \"output.progress_interval=10 ms\""));
    EXPECT_TRUE(wait_until([&] { return has(content_of(folder_ / "status.json"), "\"rolling\""); }));
    return process;
  }
  void expect_finishes_as_if_never_stopped(const std::string& more = "") {
    EXPECT_EQ(call(resume(more)), 0) << errors();
    expect_same_run(root_ / "whole", folder_);
  }

  RunOptions quiet_options() const {
    RunOptions options;
    options.threads.number = 1;
    options.quiet = true;
    options.output = folder_;
    return options;
  }

  static constexpr const char* kFrames = "--set output.frames=6";
  static constexpr const char* kScene = "--set \"scene.element_size=8 mm\"";
  fs::path folder_ = root_ / "part";
};

TEST_F(Resume, StoppedTwiceAndOnOtherThreads) {
  EXPECT_EQ(call(run(folder_, "--set stop.steps=700")), 4);
  const std::string way_on = fmt::format("`tread resume {} --set stop.steps=0` goes on", folder_.string());
  EXPECT_TRUE(has(errors(), "stop.steps = 700 ends the run here") && has(errors(), way_on)) << errors();
  EXPECT_EQ(call(resume()), 4);  // the limit holds until it is lifted
  EXPECT_TRUE(has(errors(), "stop.steps = 700 ends the run here") && has(errors(), way_on)) << errors();
  EXPECT_EQ(
      call(fmt::format("resume {} -t 2 --set stop.steps=1501", folder_.string()), "OMP_WAIT_POLICY=passive"),
      4);
  expect_finishes_as_if_never_stopped("--set stop.steps=0");
  EXPECT_EQ(call(resume()), 0);
  EXPECT_TRUE(has(errors(), "finished run")) << errors();
}

TEST_F(Resume, SigtermFinishesTheStepAndLeavesACheckpoint) {
  const pid_t process = start_rolling();
  ::kill(process, SIGTERM);
  EXPECT_EQ(wait_for(process), 75);
  EXPECT_TRUE(has(errors(), "by SIGTERM; nothing is lost: `tread resume")) << errors();
  EXPECT_TRUE(has(content_of(folder_ / "status.json"), "\"stopped\""));
  const std::string histories = content_of(folder_ / "histories.csv");
  EXPECT_TRUE(content_of(root_ / "whole/histories.csv").starts_with(histories));
  expect_finishes_as_if_never_stopped();
}

TEST_F(Resume, SigkillLosesWhatFollowedTheLastCheckpoint) {
  const pid_t process = start_rolling();
  ::kill(process, SIGUSR1);
  ASSERT_TRUE(wait_until([&] { return CheckpointFolder(folder_ / "checkpoint").states().size() == 2; }));
  ::kill(process, SIGKILL);
  EXPECT_EQ(wait_for(process), 1000 + SIGKILL);
  // The killed process could not say so itself.
  EXPECT_EQ(call("ctl " + folder_.string() + " status"), 75);
  EXPECT_TRUE(has(content_of(root_ / "out"), "\"alive\": false,\n  \"resumable\": true"));
  EXPECT_TRUE(has(errors(), "tread resume")) << errors();
  expect_finishes_as_if_never_stopped();
  EXPECT_EQ(call("ctl " + folder_.string() + " status"), 0);
}

TEST_F(Resume, ARunWhoseFolderIsRemovedLacksAResource) {
  const pid_t process = start_rolling();
  ::kill(process, SIGSTOP);     // else it writes into the folder while that is removed
  ASSERT_TRUE(wait_until([&] {  // it may end a write before it stops
    std::error_code busy;
    fs::remove_all(folder_, busy);
    return !fs::exists(folder_);
  }));
  ::kill(process, SIGUSR1);
  ::kill(process, SIGCONT);
  EXPECT_EQ(wait_for(process), 4) << errors();
}

/// Without contact and frames a run writes to open files, which need no name.
TEST_F(Resume, ARunWhoseFolderIsMovedIsNotDone) {
  const fs::path scene = root_ / "bar.toml", moved = root_ / "moved", said = root_ / "said";
  std::ofstream(scene) << kBar;
  RunOptions options = quiet_options();
  for (const char* duration : {"0.1 ms", "1 s"}) {
    const bool stopped = duration[0] == '1';
    const std::vector<std::string> values = {"output.frames=0", fmt::format("motion.duration={}", duration)};
    options.observer = [&](CheckpointStage stage) {
      if (stage != CheckpointStage::old_removed) return;
      fs::rename(folder_, moved);
      fs::create_directory(folder_);  // of another user of the name
      if (stopped) ::kill(::getpid(), SIGTERM);
    };
    const pid_t process = child([&] {
      try {
        run_scene(resolve_scene(scene, values), options);
      } catch (const Error& error) {
        std::ofstream(said) << error.what();
        ::_exit(static_cast<int>(error.code()));
      }
    });
    EXPECT_EQ(wait_for(process), 4) << duration;
    EXPECT_TRUE(has(content_of(said), folder_.string() + " was moved or removed")) << content_of(said);
    EXPECT_FALSE(has(content_of(said), "samples are kept")) << content_of(said);
    EXPECT_TRUE(fs::is_empty(folder_));
    EXPECT_EQ(CheckpointFolder(moved / "checkpoint").states().size(), 1U);
    fs::remove_all(folder_);
    fs::remove_all(moved);
  }
}

TEST_F(Resume, ResultsThatCannotBeWrittenNameTheReasonAndTheWayOn) {
  std::ofstream(root_ / "bar.toml") << kBar;
  fs::create_directories(folder_ / "report.html");
  EXPECT_EQ(call(fmt::format("run {}/bar.toml -t 1 -o {} {}", root_.string(), folder_.string(), kFrames)), 4);
  EXPECT_TRUE(has(errors(), "report.html: Is a directory; choose the name of a file; once that is mended, " +
                                resume_text(folder_) + " leaves the results"))
      << errors();
  fs::remove(folder_ / "report.html");
  EXPECT_EQ(call(resume()), 0) << errors();
}

TEST_F(Resume, TheEndOfRollingHasACheckpoint) {
  std::ofstream(root_ / "bar.toml") << kBar;
  fs::create_directories(folder_ / "report.html");
  EXPECT_EQ(call(fmt::format("run {}/bar.toml -t 1 -o {} {} --set \"output.checkpoint_interval=1 ms\"",
                             root_.string(), folder_.string(), kFrames)),
            4);
  std::vector<std::string> refused;
  const auto last = CheckpointFolder(folder_ / "checkpoint").newest(refused);
  ASSERT_TRUE(last);
  const double end = sealed_value<double>(last->content, "results/dt") * static_cast<double>(last->steps);
  EXPECT_GE(end, resolve_scene(root_ / "bar.toml").scene.motion->duration * (1 - 1e-9));
}

TEST_F(Resume, ADiskThatIsTooSmallIsNamedBeforeThePreload) {
  std::ofstream(root_ / "bar.toml") << kBar;
  const std::string large =
      "--set \"motion.duration=100 s\" --set output.frames=1000000 --set output.frame_cells=elements";
  EXPECT_EQ(
      call(fmt::format("run {}/bar.toml -t 1 -o {} --set \"scene.element_size=1 mm\" --set stop.steps=1 {}",
                       root_.string(), folder_.string(), large)),
      4);
  EXPECT_TRUE(has(errors(), "the run needs about ") && has(errors(), "state less output.frames")) << errors();
  EXPECT_FALSE(has(errors(), "[preload]")) << errors();
}

TEST_F(Resume, FailuresOfLibrariesShowInTheStatus) {
  std::ofstream(root_ / "bar.toml") << kBar;
  RunOptions options = quiet_options();
  options.observer = [](CheckpointStage stage) {
    if (stage == CheckpointStage::old_removed) throw std::bad_alloc();
  };
  const pid_t process = child([&] {
    try {
      run_scene(resolve_scene(root_ / "bar.toml"), options);
    } catch (const std::bad_alloc&) {
      ::_exit(9);
    }
  });
  EXPECT_EQ(wait_for(process), 9);
  EXPECT_TRUE(has(content_of(folder_ / "status.json"), "\"failed\"")) << content_of(folder_ / "status.json");
}

TEST_F(Resume, ARequestThatAnEndedRunHasNotReadIsWithdrawn) {
  fs::create_directories(folder_);
  for (const char* action : {"checkpoint", "frame", "stop"}) {
    std::optional<RunFolder> run(std::in_place, folder_);
    const pid_t control = start(fmt::format("ctl {} {} --wait 50", folder_.string(), action));
    ASSERT_TRUE(wait_until([&] { return is_pending(folder_); }));
    run.reset();
    const bool stop = std::string(action) == "stop";
    EXPECT_EQ(wait_for(control), stop ? 0 : 2) << action;
    EXPECT_TRUE(stop ? has(output(), "ended before it read the request")
                     : has(errors(), fmt::format("ended before it had written a {}", action)))
        << action << errors();
    EXPECT_FALSE(is_pending(folder_)) << action;
  }
}

TEST_F(Resume, ASignalBeforeTheFirstStepLosesNothing) {
  const pid_t process = start(run(folder_));
  ASSERT_TRUE(wait_until([&] { return fs::exists(folder_ / "checkpoint/order.h5"); }));
  ::kill(process, SIGINT);
  EXPECT_EQ(wait_for(process), 75);
  EXPECT_TRUE(has(errors(), "tread resume")) << errors();
  expect_finishes_as_if_never_stopped();
}

/// Over a network only the lock of the file is seen, not that of the directory.
TEST(RunFolders, AHolderOnAnotherMachineCounts) {
  const TemporaryFolder temporary;
  EXPECT_FALSE(is_taken(temporary.path));
  EXPECT_TRUE(fs::is_empty(temporary.path));
  {
    const auto there = FileLock::try_number(temporary.path / ".lock", 0);
    EXPECT_TRUE(is_taken(temporary.path));
    EXPECT_THROW(RunFolder(temporary.path), ResourceError);
  }
  EXPECT_FALSE(is_taken(temporary.path));
  const RunFolder here(temporary.path);
  EXPECT_TRUE(is_taken(temporary.path));
}

TEST(RunFolders, AreLeftAsTheyWereFound) {
  const TemporaryFolder temporary;
  const fs::path lock = temporary.path / ".lock";
  {
    const RunFolder here(temporary.path);
    EXPECT_TRUE(fs::exists(lock));
  }
  EXPECT_TRUE(fs::is_empty(temporary.path));
  std::ofstream(lock) << "of another program";
  { const RunFolder here(temporary.path); }
  EXPECT_EQ(content_of(lock), "of another program");
}

TEST(RunRequests, OfSeveralProcessesDoNotDisturbOneAnother) {
  const TemporaryFolder temporary;
  const RunFolder folder(temporary.path);
  std::vector<pid_t> processes;
  for (int i = 0; i < 4; ++i)
    processes.push_back(child([&] {
      try {
        for (int k = 0; k < 200; ++k) leave_request(temporary.path, RunRequest::checkpoint);
      } catch (const std::exception&) {
        ::_exit(1);
      }
    }));
  for (const pid_t process : processes) EXPECT_EQ(wait_for(process), 0);
  EXPECT_EQ(folder.take_request(), RunRequest::checkpoint);
  EXPECT_EQ(folder.take_request(), std::nullopt);
  leave_request(temporary.path, RunRequest::frame);
  leave_request(temporary.path, RunRequest::stop);
  leave_request(temporary.path, RunRequest::checkpoint);
  EXPECT_EQ(folder.take_request(), RunRequest::stop);
  EXPECT_EQ(std::distance(fs::directory_iterator(temporary.path), {}), 1);  // the lock
}

TEST_F(Resume, ControlledFromOutside) {
  const pid_t process = start_rolling();
  ::kill(process, SIGSTOP);  // on a busy machine it would end meanwhile
  EXPECT_EQ(call(run(folder_)), 4);
  EXPECT_TRUE(has(errors(), "another process works on")) << errors();
  EXPECT_EQ(call("ctl " + folder_.string() + " status"), 0);
  EXPECT_TRUE(has(content_of(root_ / "out"), fmt::format("\"process\": {}", process)));
  EXPECT_TRUE(has(content_of(root_ / "out"), "\"alive\": true"));
  ::kill(process, SIGCONT);
  EXPECT_EQ(call("ctl " + folder_.string() + " stop"), 0) << errors();
  EXPECT_EQ(wait_for(process), 75);
  EXPECT_EQ(call("ctl " + folder_.string() + " stop"), 2);
  EXPECT_TRUE(has(errors(), "no process works on")) << errors();
  EXPECT_EQ(call("ctl " + (root_ / "absent").string() + " status"), 2);
  EXPECT_EQ(call("ctl " + root_.string() + " status"), 2);
  EXPECT_TRUE(has(errors(), "holds no run: start one with `tread run SCENE -o")) << errors();
  // What could be gone on with is not thrown away by mistake.
  EXPECT_EQ(call(run(folder_)), 2);
  EXPECT_TRUE(has(errors(), "--overwrite")) << errors();
  expect_finishes_as_if_never_stopped();
}

TEST_F(Resume, WhatWasRequestedIsThereOnceTheRunHasAnswered) {
  const auto request = [&](pid_t process, const std::string& action) {
    ::kill(process, SIGSTOP);  // it would end meanwhile
    const pid_t control = start("ctl " + folder_.string() + " " + action);
    EXPECT_TRUE(wait_until([&] { return is_pending(folder_); }));
    ::kill(process, SIGCONT);
    EXPECT_EQ(wait_for(control), 0) << errors();
  };
  const pid_t process = start_rolling();
  request(process, "frame");
  const auto written = frames_in(folder_);
  EXPECT_TRUE(std::any_of(written.begin(), written.end(), [](const std::string& name) {
    return name.ends_with(".hdf") && !fs::exists(root_ / "whole/frames" / name);
  }));
  ::kill(process, SIGKILL);
  wait_for(process);
  const pid_t resumed = start(resume());
  EXPECT_TRUE(wait_until([&] { return is_taken(folder_); }));
  request(resumed, "checkpoint");
  EXPECT_EQ(CheckpointFolder(folder_ / "checkpoint").states().size(), 2U);
  EXPECT_EQ(wait_for(resumed), 0) << errors();
  const auto names = frames_in(folder_);
  EXPECT_EQ(names.size(), frames_in(root_ / "whole").size() + 1);
  const std::string series = content_of(folder_ / "frames.hdf.series");
  for (const std::string& name : names) EXPECT_EQ(has(series, name), name.starts_with("step-")) << name;
  EXPECT_TRUE(has(content_of(folder_ / "status.json"), "\"done\""));
}

TEST_F(Resume, OnlyWhatLeavesTheMotionAloneMayChange) {
  ASSERT_EQ(call(run(folder_, "--set stop.steps=700")), 4);
  const std::string scene = content_of(folder_ / "scene.resolved.toml");
  const std::string status = content_of(folder_ / "status.json");
  for (const char* wrong :
       {"contact.friction=0.3", "motion.speed=\"100 km/h\"", "scene.element_size=\"9 mm\"",
        "motion.duration=\"5 ms\"", "motion.duration=\"0.1 ms\"", "output.interval=1", "rail.present=false",
        "scene.based_on=highspeed-slab-2014", "probe.a.x=0.1m"}) {
    EXPECT_EQ(call(resume(fmt::format("--set {}", wrong))), 2) << wrong;
    const std::string key = wrong;
    EXPECT_TRUE(has(errors(), key.substr(0, key.find('=')))) << errors();
    EXPECT_EQ(content_of(folder_ / "scene.resolved.toml"), scene) << wrong;
    EXPECT_EQ(content_of(folder_ / "status.json"), status) << wrong;
  }
  EXPECT_EQ(call(resume("--set \"motion.duration=1 ms\" --set stop.steps=0")), 0) << errors();
  const std::string histories = content_of(folder_ / "histories.csv");
  EXPECT_TRUE(content_of(root_ / "whole/histories.csv").starts_with(histories));
  EXPECT_TRUE(has(content_of(folder_ / "scene.resolved.toml"), "duration = \"0.001 s\""));
}

TEST_F(Resume, InSinglePrecision) {
  const std::string shorter = "--precision single --set \"motion.duration=0.1 ms\"";
  const fs::path whole = root_ / "single";
  ASSERT_EQ(call(run(whole, shorter)), 0) << errors();
  EXPECT_EQ(call(run(folder_, shorter + " --set stop.steps=40")), 4) << errors();
  EXPECT_EQ(call(resume("--set stop.steps=0")), 0) << errors();
  expect_same_run(whole, folder_);
}

TEST_F(Resume, ADamagedCheckpointIsReplacedByThePreviousOne) {
  ASSERT_EQ(call(run(folder_, "--set stop.steps=700")), 4);
  const std::vector<fs::path> states = CheckpointFolder(folder_ / "checkpoint").states();
  ASSERT_EQ(states.size(), 2U);
  fs::resize_file(states[0], 5000);
  EXPECT_EQ(call(resume("--set stop.steps=800")), 4);
  EXPECT_TRUE(has(errors(), fmt::format("cannot use {}: it has 5000 of", states[0].string()))) << errors();
  EXPECT_TRUE(has(errors(), "from " + states[1].string())) << errors();
  const auto left = CheckpointFolder(folder_ / "checkpoint").states();
  for (const fs::path& state : left) fs::resize_file(state, 100);
  EXPECT_EQ(call(resume()), 2);
  EXPECT_TRUE(has(errors(), "no checkpoint is of use")) << errors();
}

TEST_F(Resume, AFileThatHoldsNoStateIsReplacedByThePreviousOne) {
  ASSERT_EQ(call(run(folder_, "--set stop.steps=700")), 4);
  const fs::path checkpoints = folder_ / "checkpoint";
  const std::vector<fs::path> states = CheckpointFolder(checkpoints).states();
  ASSERT_EQ(states.size(), 2U);
  fs::copy_file(states[1], checkpoints / "step-000000009998.h5");
  fs::copy_file(checkpoints / "order.h5", checkpoints / "step-000000009999.h5");
  EXPECT_EQ(call(resume("--set stop.steps=800")), 4) << errors();
  EXPECT_TRUE(has(errors(), "step-000000009999.h5: it holds no state of a run")) << errors();
  EXPECT_TRUE(has(errors(), "step-000000009998.h5: it holds the state of step")) << errors();
  EXPECT_TRUE(has(errors(), "from " + states[0].string())) << errors();
}

TEST_F(Resume, AStateOfAnotherRunIsReplacedByThePreviousOne) {
  ASSERT_EQ(call(run(folder_, "--set stop.steps=700")), 4);
  const fs::path other = root_ / "other";
  ASSERT_EQ(call(run(other, "--set contact.friction=0.3 --set stop.steps=800")), 4);
  const fs::path state = CheckpointFolder(other / "checkpoint").states().front();
  const fs::path copy = folder_ / "checkpoint" / state.filename();
  fs::copy_file(state, copy);
  EXPECT_EQ(call(resume("--set stop.steps=750 --set output.checkpoint_interval=\"1 h\"")), 4) << errors();
  EXPECT_TRUE(has(errors(), "cannot use " + copy.string() + ": it is the state of another run")) << errors();
  EXPECT_TRUE(has(errors(), "friction = 0.3") && has(errors(), "[resume] from ")) << errors();
  fs::remove(copy);
  expect_finishes_as_if_never_stopped("--set stop.steps=0");
}

TEST_F(Resume, ACheckpointOfAnotherFormatIsRefusedByName) {
  ASSERT_EQ(call(run(folder_, "--set stop.steps=40 --set motion.duration=\"0.1 ms\"")), 4) << errors();
  const CheckpointFolder checkpoints(folder_ / "checkpoint");
  std::vector<std::string> refused;
  const std::optional<CheckpointFolder::Found> found = checkpoints.newest(refused);
  ASSERT_TRUE(found);
  SealedContent content = found->content;
  content["made/version"] = std::string("9.8.7");
  content["made/format"] = std::vector<std::int64_t>{kCheckpointFormat + 41};
  checkpoints.write(found->steps, content);
  EXPECT_EQ(call(resume()), 2);
  EXPECT_TRUE(has(errors(), fmt::format("the checkpoint has format {}, and tread 9.8.7 wrote it",
                                        kCheckpointFormat + 41)))
      << errors();
  EXPECT_TRUE(has(errors(), "go on with the program that wrote it")) << errors();
  content.erase("made/format");
  checkpoints.write(found->steps, content);
  EXPECT_EQ(call(resume()), 2);
  EXPECT_TRUE(has(errors(), "the checkpoint has no format number, and tread 9.8.7 wrote it")) << errors();
  content["made/format"] = std::vector<std::int64_t>{kCheckpointFormat};
  checkpoints.write(found->steps, content);
  EXPECT_EQ(call(resume("--set stop.steps=60")), 4) << errors();
  EXPECT_TRUE(has(errors(), "[resume] from")) << errors();
  EXPECT_TRUE(has(errors(), "version 9.8.7 wrote it")) << errors();
}

TEST_F(Resume, ACheckpointOfAnotherBuildIsNamed) {
  ASSERT_EQ(call(run(folder_, "--set stop.steps=40 --set motion.duration=\"0.1 ms\"")), 4) << errors();
  EXPECT_TRUE(has(errors(), "[step] looks for the largest stable one\n[step] dt")) << errors();
  const CheckpointFolder checkpoints(folder_ / "checkpoint");
  std::vector<std::string> refused;
  const std::optional<CheckpointFolder::Found> found = checkpoints.newest(refused);
  ASSERT_TRUE(found);
  SealedContent content = found->content;
  EXPECT_EQ(call(resume("--set stop.steps=40")), 4) << errors();
  EXPECT_FALSE(has(errors(), "the last bits may differ")) << errors();
  content["made/program"] = std::vector<std::int64_t>{7};
  content["made/commit"] = std::string("0123456789ab");
  checkpoints.write(found->steps, content);
  EXPECT_EQ(call(resume("--set stop.steps=40")), 4) << errors();
  EXPECT_TRUE(has(errors(), "another build of the program wrote it, of commit 0123456789ab")) << errors();
  content.erase("made/program");  // of an earlier program
  content.erase("made/commit");
  checkpoints.write(found->steps, content);
  EXPECT_EQ(call(resume("--set stop.steps=40")), 4) << errors();
  EXPECT_FALSE(has(errors(), "the last bits may differ")) << errors();
}

TEST_F(Resume, NeedsNeitherTheSceneNorTheFilesThatItNames) {
  const fs::path source = root_ / "source";
  const fs::path link = root_ / "link";
  fs::create_directories(source / "scenes");
  fs::create_directory_symlink(source / "scenes", link);
  std::ofstream(source / "depth.txt") << "# x [mm]  d [mm]\n0 0\n10 0.02\n20 0\n";
  std::ofstream(source / "scenes/scene.toml")
      << content_of(kTyre)
      << "[corrugation]\nkind = \"table\"\nfile = \"../depth.txt\"\nwidth = \"20 "
         "mm\"\nstart = \"10 mm\"\napply = \"gap\"\n";
  const auto table_run = [&](const fs::path& folder, const char* more) {
    return fmt::format(
        "run link/scene.toml -t 1 -o {} {} --set output.frames=3 --set \"motion.duration=0.6 ms\" --set "
        "\"solution_zone.start=5 mm\" {}",
        folder.string(), kScene, more);
  };
  const std::string there = fmt::format("cd {} &&", root_.string());  // and resumed from elsewhere
  ASSERT_EQ(call(table_run(root_ / "table", ""), there), 0) << errors();
  ASSERT_EQ(call(table_run(folder_, "--set stop.steps=300"), there), 4) << errors();
  fs::remove(link);
  fs::remove_all(source);
  EXPECT_EQ(call(resume("--set stop.steps=0")), 0) << errors();
  expect_same_run(root_ / "table", folder_);
}

TEST_F(Resume, KilledInEveryStageOfACheckpoint) {
  const std::vector<std::string> values = {"scene.element_size=8 mm", "motion.duration=1 ms",
                                           "output.checkpoint_interval=1 ms", "output.frames=3"};
  RunOptions options = quiet_options();
  options.output = root_ / "short";
  ASSERT_EQ(wait_for(child([&] { run_scene(resolve_scene(fs::path(kTyre), values), options); })), 0);
  options.output = folder_;
  for (int stage = 0; stage <= static_cast<int>(CheckpointStage::old_removed); ++stage) {
    int seen = 0;
    options.observer = [&](CheckpointStage reached) {
      if (static_cast<int>(reached) == stage && ++seen == 2) ::kill(::getpid(), SIGKILL);
    };
    const pid_t process = child([&] { run_scene(resolve_scene(fs::path(kTyre), values), options); });
    ASSERT_EQ(wait_for(process), 1000 + SIGKILL) << "stage " << stage;
    EXPECT_EQ(call(resume()), 0) << errors();
    expect_same_run(root_ / "short", folder_);
    fs::remove_all(folder_);
  }
}

TEST_F(Resume, OtherValuesAreKeptBeforeTheFirstStep) {
  RunOptions options = quiet_options();
  const CheckpointFolder checkpoints(folder_ / "checkpoint");
  const auto ends_at = [&](CheckpointStage stage, const std::function<void()>& begin) {
    options.observer = [stage](CheckpointStage reached) {
      if (reached == stage) ::kill(::getpid(), SIGKILL);
    };
    EXPECT_EQ(wait_for(child(begin)), 1000 + SIGKILL);
  };
  const auto resumed = [&] { resume_run(options); };
  ends_at(CheckpointStage::begun, [&] {
    run_scene(resolve_scene(fs::path(kTyre), {"scene.element_size=8 mm", "stop.steps=20"}), options);
  });
  options.overrides = {"stop.steps=30", "output.checkpoint_interval=1 h"};
  ends_at(CheckpointStage::begun, resumed);
  EXPECT_TRUE(checkpoints.states().empty());
  EXPECT_EQ(unpack_order(checkpoints.read_order()).later, options.overrides);

  EXPECT_EQ(call(resume()), 4) << errors();
  EXPECT_TRUE(has(errors(), "stop.steps = 30 ends the run here")) << errors();
  options.overrides = {"stop.steps=0"};
  ends_at(CheckpointStage::old_removed, resumed);
  std::vector<std::string> refused;
  const std::optional<CheckpointFolder::Found> found = checkpoints.newest(refused);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->steps, 30);
  EXPECT_EQ(unpack_order(found->content).later.back(), "stop.steps=0");
}

TEST(RunSessions, ASignalBeforeTheFirstStepNamesTheWayOn) {
  const TemporaryFolder temporary;
  RunOptions options;
  options.output = temporary.path / "run";
  const fs::path said = temporary.path / "said";
  const auto signal_early = [&](bool with_state = false) {
    const pid_t process = child([&] {
      if (std::freopen(said.c_str(), "w", stderr) == nullptr) ::_exit(1);
      RunSession session(options);
      if (with_state) session.begin_with_state();
      ::raise(SIGINT);
    });
    EXPECT_EQ(wait_for(process), 75);
    return content_of(said);
  };
  const std::string sentence = "stopped before the first step; " + resume_text(options.output);
  EXPECT_TRUE(has(signal_early(), sentence + " starts again")) << content_of(said);
  fs::create_directories(options.output / kCheckpointFolder);
  std::ofstream(options.output / kCheckpointFolder / "step-000000000007.h5") << "a state";
  EXPECT_TRUE(has(signal_early(), sentence + " goes on from the last checkpoint")) << content_of(said);
  options.overrides = {"stop.steps=9"};
  EXPECT_TRUE(has(signal_early(), "the same command goes on")) << content_of(said);
  options.overrides.clear();
  options.overwrite = true;  // what it throws away may still be there
  EXPECT_TRUE(has(signal_early(), "the same command starts again")) << content_of(said);
  EXPECT_TRUE(has(signal_early(true), sentence + " goes on from the last checkpoint")) << content_of(said);
  options.device = "gpu:1";
  const std::string there = resume_text(options.output, "--device gpu:1");
  EXPECT_TRUE(has(signal_early(true), there + " goes on from the last checkpoint")) << content_of(said);
}

TEST_F(Resume, AStopSaysWhyAndKeepsTheState) {
  EXPECT_EQ(call(run(folder_, "--set \"stop.penetration=0.1 um\"")), 3);
  EXPECT_TRUE(has(errors(), "stop.penetration = 0.1 um") && has(errors(), "the last checkpoint is that of"))
      << errors();
  const std::size_t begin = errors().find("stopped at"), end = errors().find(", which ends each");
  ASSERT_LT(begin, end);
  const std::string stop = errors().substr(begin, end - begin);
  EXPECT_EQ(call(resume()), 3);  // at once: its last sample is beyond the limit
  EXPECT_TRUE(has(errors(), stop) && has(errors(), "--set stop.penetration states more")) << errors();
  EXPECT_EQ(call(resume("--set \"stop.penetration=1 mm\" --set \"stop.wall_time=10 us\"")), 75);
  EXPECT_TRUE(has(errors(), "stop.wall_time")) << errors();
  EXPECT_EQ(call(resume("--set \"stop.wall_time=1 h\" --set \"output.disk_limit=1 kB\" --set "
                        "\"output.progress_interval=1 ms\"")),
            4);
  EXPECT_TRUE(has(errors(), "output.disk_limit = 1")) << errors();
  EXPECT_EQ(call(resume("--set \"output.disk_limit=1 GB\"")), 0);
  EXPECT_TRUE(content_of(folder_ / "histories.csv") == content_of(root_ / "whole/histories.csv"));
  EXPECT_EQ(call(run(folder_, "--overwrite --set \"output.disk_limit=1 kB\"")), 2);
  EXPECT_TRUE(has(errors(), "the run needs about")) << errors();
}

TEST_F(Resume, FramesThatAreDamagedOrDeletedAreNamed) {
  ASSERT_EQ(call(run(folder_, "--set stop.steps=700")), 4);
  EXPECT_EQ(call(resume("--set stop.steps=720")), 4);
  EXPECT_FALSE(has(errors(), "[warning] " + (folder_ / "frames").string())) << errors();
  std::vector<std::string> steps;
  for (const std::string& name : frames_in(folder_))
    if (name.starts_with("step-")) steps.push_back(name);
  ASSERT_GE(steps.size(), 2U);
  const fs::path damaged = folder_ / "frames" / steps[0];
  std::ofstream(damaged) << "x\n";
  fs::remove(folder_ / "frames" / steps[1]);
  EXPECT_EQ(call(resume("--set stop.steps=730")), 4);
  EXPECT_TRUE(has(errors(), damaged.string() + ": it is no HDF5 file")) << errors();
  EXPECT_TRUE(has(errors(), ": 2 of the frames up to step 7")) << errors();
  EXPECT_FALSE(has(content_of(folder_ / "frames.hdf.series"), steps[0]));
}

TEST_F(Resume, AFrameThatDoesNotFitEndsTheRunAndComesLater) {
  // [512 B]: a checkpoint fits, the mesh of all elements does not.
  EXPECT_EQ(call(run(folder_, "--set output.frame_cells=elements"), "ulimit -f 2200;"), 4);
  EXPECT_TRUE(has(errors(), "mesh-elements.hdf") && has(errors(), "File too large")) << errors();
  EXPECT_FALSE(fs::exists(folder_ / "frames.hdf.series"));
  EXPECT_EQ(call(resume()), 0) << errors();
  EXPECT_TRUE(content_of(folder_ / "histories.csv") == content_of(root_ / "whole/histories.csv"));
  EXPECT_EQ(frames_in(folder_).size(), frames_in(root_ / "whole").size());
}

TEST_F(Resume, AFullDiskLosesNothingThatWasWritten) {
  // Files cannot grow beyond the limit [512 B]. All kinds of writes: full_disk.sh.
  for (const int limit : {1, 40, 1900}) {
    const int code = call(run(folder_), fmt::format("ulimit -f {};", limit));
    EXPECT_EQ(code, 4) << limit << ": " << errors();
    EXPECT_TRUE(has(errors(), "File too large") && has(errors(), folder_.string()))
        << limit << ": " << errors();
    if (!fs::exists(folder_ / "checkpoint/order.h5")) continue;  // it had not begun
    EXPECT_EQ(call(resume()), 0) << errors();
    EXPECT_TRUE(content_of(folder_ / "histories.csv") == content_of(root_ / "whole/histories.csv")) << limit;
    fs::remove_all(folder_);
  }
}

}  // namespace
}  // namespace tread
