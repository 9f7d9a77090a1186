// Threads: every item runs once, on any thread; times add up.

#include <gtest/gtest.h>
#include <sched.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <string>
#include <thread>
#include <vector>

#include "core/error.hpp"
#include "core/parallel/parallel.hpp"

namespace tread {
namespace {

class Parallel : public testing::TestWithParam<std::string_view> {
 protected:
  void SetUp() override { set_backend(GetParam()); }
  void TearDown() override {
    set_backend(backends().front());
    set_threads(1);
  }
};

TEST_P(Parallel, VisitsEveryItemOnce) {
  for (const int threads : {1, 2, 3, 5})
    for (const std::int64_t n : {0, 1, 7, 1000}) {
      set_threads(threads);
      std::vector<int> visits(static_cast<std::size_t>(n), 0);
      parallel_ranges(n, [&](std::int64_t first, std::int64_t last) {
        for (std::int64_t i = first; i < last; ++i) ++visits[static_cast<std::size_t>(i)];
      });
      EXPECT_EQ(visits, std::vector<int>(static_cast<std::size_t>(n), 1)) << threads << " threads, " << n;
    }
}

std::vector<int> cores_of_this_thread() {
  cpu_set_t allowed;
  CPU_ZERO(&allowed);
  ::sched_getaffinity(0, sizeof(allowed), &allowed);
  std::vector<int> cores;
  for (int core = 0; core < CPU_SETSIZE; ++core)
    if (CPU_ISSET(core, &allowed)) cores.push_back(core);
  return cores;
}

TEST_P(Parallel, BoundThreadsStayOnTheirCores) {
  const std::vector<int> all = cores_of_this_thread();
  const std::thread::id own = std::this_thread::get_id();
  std::atomic<int> others = 0;
  std::atomic<int> kept = 0;
  set_threads(2);
  bind_threads({all.front(), all.back()});
  parallel_ranges(40, [&](std::int64_t, std::int64_t) {
    if (std::this_thread::get_id() == own) {  // leaves items to the other one, however busy the machine is
      for (int i = 0; i < 10000 && others == 0; ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      return;
    }
    if (cores_of_this_thread() == std::vector<int>{all.back()}) ++kept;
    ++others;
  });
  bind_threads({});
  EXPECT_GT(others, 0);
  EXPECT_EQ(kept, others);
  EXPECT_EQ(cores_of_this_thread(), all);
}

TEST_P(Parallel, OneThreadWorksBesideTheOthers) {
  for (const int threads : {1, 2, 3}) {
    set_threads(threads);
    int alone = 0;
    std::vector<int> visits(100, 0);
    std::vector<int> later(100, 0);
    const auto visit = [](std::vector<int>& of) {
      parallel_ranges(std::ssize(of), [&](std::int64_t first, std::int64_t last) {
        for (std::int64_t i = first; i < last; ++i) ++of[static_cast<std::size_t>(i)];
      });
    };
    const auto alone_too = [&] {
      parallel_ranges(
          7, [&](std::int64_t first, std::int64_t last) { alone += static_cast<int>(last - first); });
    };
    beside(alone_too, [&] {
      visit(visits);
      visit(later);
    });
    EXPECT_EQ(alone, 7);
    EXPECT_EQ(visits, std::vector<int>(100, 1));
    EXPECT_EQ(later, std::vector<int>(100, 1));
    beside(alone_too, [] {});
    EXPECT_EQ(alone, 14) << "nothing to be beside";
  }
}

TEST_P(Parallel, WhatIsThrownBesideIsThrownOn) {
  for (const int threads : {1, 2}) {
    set_threads(threads);
    const auto nothing = [] { parallel_ranges(9, [](std::int64_t, std::int64_t) {}); };
    EXPECT_THROW(beside([] { throw NumericalError("deep"); }, nothing), NumericalError);
    EXPECT_THROW(beside([] {}, [] { throw NumericalError("shared"); }), NumericalError);
    int calls = 0;  // and the one that waited is forgotten
    parallel_ranges(1, [&](std::int64_t, std::int64_t) { ++calls; });
    EXPECT_EQ(calls, 1);
  }
}

TEST_P(Parallel, TimesAloneAreOneItem) {
  ParallelTimes times;
  measure_parallel(&times);
  set_threads(2);
  const auto work = [] {
    volatile double sink = 0;
    for (int i = 0; i < 2000000; ++i) sink = sink + 1;
  };
  beside(work, [] { parallel_ranges(4, [](std::int64_t, std::int64_t) {}); });
  measure_parallel(nullptr);
  EXPECT_EQ(times.calls, 1);
  EXPECT_GT(times.alone, 0);
  EXPECT_GE(times.longest, 0.99 * times.alone);
  EXPECT_GE(times.wall, times.alone);
}

TEST_P(Parallel, TimesAddUp) {
  ParallelTimes times;
  measure_parallel(&times);
  for (const int threads : {3, 1}) {
    set_threads(threads);
    parallel_ranges(24, [](std::int64_t first, std::int64_t last) {
      volatile double sink = 0;
      for (std::int64_t i = 0; i < 200000 * (last - first); ++i) sink = sink + 1;
    });
  }
  measure_parallel(nullptr);
  parallel_ranges(1, [](std::int64_t, std::int64_t) {});
  EXPECT_EQ(times.calls, 2);
  ASSERT_EQ(times.by_thread.size(), 3U);
  double busy = 0;
  for (const ParallelTimes::Thread& thread : times.by_thread) {
    EXPECT_LE(thread.busy, times.wall);
    busy += thread.busy;
  }
  EXPECT_GT(busy, 0);
  EXPECT_LE(busy, 3 * times.wall);
}

INSTANTIATE_TEST_SUITE_P(Backends, Parallel, testing::ValuesIn(backends()),
                         [](const auto& named) { return std::string(named.param); });

TEST(ParallelBackends, UnknownNamesAreRefused) {
  EXPECT_THROW(set_backend("pthreads"), InputError);
  EXPECT_EQ(backend(), backends().front());
}

}  // namespace
}  // namespace tread
