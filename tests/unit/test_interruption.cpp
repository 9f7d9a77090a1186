#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "core/error.hpp"
#include "drivers/process/interruption.hpp"

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

}  // namespace
}  // namespace tread
