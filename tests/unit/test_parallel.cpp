// Threads: every item runs once, on any thread; times add up.

#include <gtest/gtest.h>
#include <sched.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <mutex>
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

TEST_P(Parallel, LinksOfAChainFollowOneAnotherBesideRanges) {
  for (const int threads : {1, 2, 3, 8})
    for (const std::int64_t n : {0, 1, 20}) {
      set_threads(threads);
      std::vector<int> first(static_cast<std::size_t>(n), 0);
      std::vector<int> second(30, 0);
      std::vector<int> visits(100, 0);
      std::vector<std::int64_t> order;  // items of the links before when the last one begins, then its own
      std::atomic<int> early = 0;       // items of the second link before the first one is done
      const auto mark = [](std::vector<int>& of) {
        return [&of](std::int64_t from, std::int64_t to) {
          for (std::int64_t i = from; i < to; ++i) ++of[static_cast<std::size_t>(i)];
        };
      };
      const auto mark_first = mark(first);
      const auto mark_second = [&](std::int64_t from, std::int64_t to) {
        early += std::count(first.begin(), first.end(), 1) == n ? 0 : 1;
        mark(second)(from, to);
      };
      const auto last = [&](std::int64_t, std::int64_t) {
        order.push_back(std::count(first.begin(), first.end(), 1));
        order.push_back(std::count(second.begin(), second.end(), 1));
        std::int64_t items = 0;  // without a lock: its own thread takes them
        parallel_ranges(7, [&](std::int64_t from, std::int64_t to) { items += to - from; });
        order.push_back(items);
      };
      const std::array<Link, 3> chain = {{{n, mark_first}, {30, mark_second}, {1, last}}};
      ranges_beside(chain, 100, mark(visits));
      EXPECT_EQ(order, (std::vector<std::int64_t>{n, 30, 7})) << threads << " threads, " << n;
      EXPECT_EQ(early, 0);
      EXPECT_EQ(visits, std::vector<int>(100, 1));
      std::fill(first.begin(), first.end(), 0);
      std::fill(second.begin(), second.end(), 0);
      ranges_beside(chain, 0, [](std::int64_t, std::int64_t) { ADD_FAILURE(); });
      EXPECT_EQ(order.size(), 6U) << "beside nothing";
    }
}

TEST_P(Parallel, WhatALinkThrowsIsThrownOnceAllIsDone) {
  for (const int threads : {1, 2}) {
    set_threads(threads);
    std::atomic<std::int64_t> items = 0;
    bool later = false;
    const auto nothing = [](std::int64_t, std::int64_t) {};
    const auto deep = [](std::int64_t, std::int64_t) { throw NumericalError("deep"); };
    const auto not_reached = [&](std::int64_t, std::int64_t) { later = true; };
    const std::array<Link, 3> chain = {{{3, nothing}, {8, deep}, {1, not_reached}}};
    EXPECT_THROW(ranges_beside(chain, 9, [&](std::int64_t from, std::int64_t to) { items += to - from; }),
                 NumericalError);
    EXPECT_EQ(items, 9);
    EXPECT_FALSE(later);
  }
}

TEST_P(Parallel, LaterRangesOfAPartAreSmaller) {
  set_threads(2);
  constexpr std::int64_t kItems = 100000;
  std::vector<std::array<std::int64_t, 2>> ranges;
  std::mutex lock;
  parallel_ranges(kItems, [&](std::int64_t from, std::int64_t to) {
    const std::lock_guard held(lock);
    ranges.push_back({from, to});
  });
  std::sort(ranges.begin(), ranges.end());
  ASSERT_EQ(ranges.size(), 8U);
  EXPECT_EQ(ranges.front()[0], 0);
  EXPECT_EQ(ranges[4][0], kItems / 2) << "a part for each thread";
  EXPECT_EQ(ranges.back()[1], kItems);
  for (std::size_t i = 0; i + 1 < ranges.size(); ++i) {
    EXPECT_EQ(ranges[i][1], ranges[i + 1][0]);
    if (i != 3) {
      EXPECT_GT(ranges[i][1] - ranges[i][0], ranges[i + 1][1] - ranges[i + 1][0]);
    }
  }
}

TEST_P(Parallel, AThreadBeginsWithItsOwnPart) {
  set_threads(2);
  const std::thread::id own = std::this_thread::get_id();
  std::atomic<int> begun = 0;
  std::array<std::atomic<std::int64_t>, 2> first = {-1, -1};  // of the calling thread, of the other one
  parallel_ranges(1000, [&](std::int64_t from, std::int64_t) {
    std::int64_t unset = -1;
    if (!first[std::this_thread::get_id() == own ? 0 : 1].compare_exchange_strong(unset, from)) return;
    ++begun;  // waits for the other thread, however busy the machine is
    for (int i = 0; i < 10000 && begun < 2; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  });
  EXPECT_EQ(first[0], 0);
  EXPECT_EQ(first[1], 500);
}

TEST_P(Parallel, TimesOfLinksAddUp) {
  ParallelTimes times;
  measure_parallel(&times);
  set_threads(2);
  const auto work = [](std::int64_t, std::int64_t) {
    volatile double sink = 0;
    for (int i = 0; i < 2000000; ++i) sink = sink + 1;
  };
  const std::array<Link, 3> chain = {{{1, work}, {1, work}, {1, work}}};
  ranges_beside(chain, 4, [](std::int64_t, std::int64_t) {});
  measure_parallel(nullptr);
  EXPECT_EQ(times.calls, 1);
  double sum = 0;
  for (const double seconds : times.links) {
    EXPECT_GT(seconds, 0);
    EXPECT_GE(times.longest, 0.99 * seconds);
    sum += seconds;
  }
  EXPECT_GE(times.wall, sum);
  EXPECT_GE(times.busy(), 0.99 * sum);
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
