#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <string>
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

// Grid Engine sends both before it kills; the system repeats SIGXCPU every second.
TEST(Interruption, LimitsOfBatchSystemsAskToStop) {
  for (const int signal : {SIGUSR2, SIGXCPU}) {
    Interruption interruption("early", "late");
    interruption.defer();
    ::raise(signal);
    EXPECT_STREQ(Interruption::stop_wanted(), signal == SIGXCPU ? "SIGXCPU" : "SIGUSR2");
    std::this_thread::sleep_for(std::chrono::milliseconds(signal == SIGXCPU ? 600 : 0));
    ::raise(signal);
  }
}

ProcessEnd end_of(const ChildProcess& child) {
  ProcessEnd end{-1, -1};
  while (!child.ended(end)) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  return end;
}

// `tread ctl STUDY checkpoint` reaches points that have only just started.
TEST(ChildProcess, OutlivesARequestBeforeItsHandlerExists) {
  const samples::TemporaryFolder temporary;
  const ChildProcess child({"--gtest_list_tests"}, temporary.path / "log");
  child.send(SIGUSR1);
  const ProcessEnd end = end_of(child);
  EXPECT_EQ(end.signal, 0);
  EXPECT_EQ(end.code, 0);
}

// The places of OpenMP's threads begin with the same core in every process. The test is its own child, too.
TEST(ChildProcess, BesideOthersHasNoPlaces) {
  if (const char* expected = std::getenv("TREAD_TEST_BIND")) {
    EXPECT_STREQ(std::getenv("OMP_PROC_BIND"), expected);
    EXPECT_EQ(std::getenv("OMP_PLACES") == nullptr, std::string(expected) == "false");
    return;
  }
  const samples::TemporaryFolder temporary;
  ::setenv("OMP_PROC_BIND", "close", 1);
  ::setenv("OMP_PLACES", "cores", 1);
  for (const bool beside : {false, true}) {
    ::setenv("TREAD_TEST_BIND", beside ? "false" : "close", 1);
    const ChildProcess child({"--gtest_filter=ChildProcess.BesideOthersHasNoPlaces"}, temporary.path / "log",
                             {}, beside);
    EXPECT_EQ(end_of(child).code, 0) << beside;
  }
  for (const char* name : {"OMP_PROC_BIND", "OMP_PLACES", "TREAD_TEST_BIND"}) ::unsetenv(name);
}

}  // namespace
}  // namespace tread
