#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "core/error.hpp"
#include "drivers/process/child_process.hpp"
#include "drivers/process/interruption.hpp"
#include "tests/temporary_folder.hpp"

namespace tread {
namespace {

constexpr int kResumable = static_cast<int>(ExitCode::resumable);

TEST(Interruption, EndsAtOnceUntilDeferred) {
  EXPECT_EXIT(
      {
        Interruption interruption("early", "late");
        ::raise(SIGTERM);
      },
      testing::ExitedWithCode(kResumable), "early");
}

// `timeout` and batch systems signal a process and its group.
TEST(Interruption, SignalsThatComeTogetherAreOneRequest) {
  Interruption interruption("early", "late");
  interruption.defer();
  EXPECT_EQ(Interruption::stop_wanted(), nullptr);
  ::raise(SIGTERM);
  ::raise(SIGTERM);
  ::raise(SIGINT);
  EXPECT_STREQ(Interruption::stop_wanted(), "SIGTERM");
}

TEST(Interruption, ASecondRequestEndsAtOnce) {
  EXPECT_EXIT(
      {
        Interruption interruption("early", "late");
        interruption.defer();
        ::raise(SIGINT);
        std::this_thread::sleep_for(std::chrono::milliseconds(600));
        ::raise(SIGINT);
      },
      testing::ExitedWithCode(kResumable), "late");
}

// `tread ctl STUDY checkpoint` reaches points that have only just started.
TEST(ChildProcess, OutlivesARequestBeforeItsHandlerExists) {
  const samples::TemporaryFolder temporary;
  const ChildProcess child({"--gtest_list_tests"}, temporary.path / "log");
  child.send(SIGUSR1);
  ProcessEnd end{-1, -1};
  while (!child.ended(end)) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  EXPECT_EQ(end.signal, 0);
  EXPECT_EQ(end.code, 0);
}

}  // namespace
}  // namespace tread
