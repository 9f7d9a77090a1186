#include "core/parallel/parallel.hpp"

#include <fmt/core.h>
#include <sched.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <exception>
#include <string>
#include <utility>

#include "core/contract.hpp"
#include "core/error.hpp"
#include "core/parallel/parallel_backend.hpp"

namespace tread {

namespace {

constexpr int kRangesOfLink = 2;  ///< by thread
/// TBB is the default: its idle threads sleep soon. OpenMP's spin, which takes the cores from other programs
/// and, on busy cores, slows a run by more than ten times.
constexpr std::array<const ParallelBackend*, 2> kBackends = {&tbb_backend, &openmp_backend};

int g_threads = 1;
std::vector<int> g_cores;  ///< bind_threads
ParallelTimes* g_times = nullptr;
thread_local bool t_in_link = false;  ///< this thread is in a link of a chain

/// Backend with the given name. Throws InputError for an unknown name; its message cites `where`, the place
/// of the name.
const ParallelBackend* backend_named(std::string_view name, std::string_view where) {
  std::string known;
  for (const ParallelBackend* candidate : kBackends) {
    if (name == candidate->name) return candidate;
    known.append(known.empty() ? "" : ", ").append(candidate->name);
  }
  throw InputError(fmt::format("{} = {}: threads can be run by {}", where, name, known));
}

/// Null before the first use.
const ParallelBackend* g_backend = nullptr;

const ParallelBackend* chosen() {
  if (g_backend == nullptr) {
    const char* name = std::getenv("TREAD_BACKEND");
    g_backend =
        name && *name != '\0' ? backend_named(name, "the environment's TREAD_BACKEND") : kBackends.front();
  }
  return g_backend;
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Adds what a thread has done from `start` on to its times and returns it; `items`: how many it was.
double add_time(int thread, std::chrono::steady_clock::time_point start, std::int64_t items) {
  const double seconds = seconds_since(start);
  ParallelTimes::Thread& of = g_times->by_thread[static_cast<std::size_t>(thread)];
  of.busy += seconds;
  of.longest = std::max(of.longest, seconds / static_cast<double>(items));
  return seconds;
}

/// Keeps this thread, by its number, on its core. Where the machine does not let it, it goes on anywhere.
void stay_on_core(int thread) {
  thread_local int kept_as = 0;
  if (g_cores.empty() || thread == 0 || kept_as == thread) return;
  kept_as = thread;
  cpu_set_t core;
  CPU_ZERO(&core);
  CPU_SET(static_cast<std::size_t>(g_cores[static_cast<std::size_t>(thread) % g_cores.size()]), &core);
  ::sched_setaffinity(0, sizeof(core), &core);
}

/// Successive items of which each thread begins with its own part, the same in all calls, so that what it has
/// touched lies near. A part is taken in ranges, by other threads too when they are done with theirs: a core
/// that another process uses slows the rest little.
class Parts {
 public:
  explicit Parts(std::int64_t n) : n_(n), count_(std::min(g_threads, kMostParts)) {}

  /// Calls body(first, last) on ranges that no other thread has taken, and before() before each.
  template <class Before, class Body>
  void take(int thread, const Before& before, const Body& body) {
    for (int i = 0; i < count_; ++i) {
      const int part = (thread + i) % count_;
      const std::int64_t first = n_ * part / count_;
      const std::int64_t items = n_ * (part + 1) / count_ - first;
      const std::int64_t ranges = std::min(items, kRangesOfPart);
      std::atomic<std::int64_t>& next = next_[static_cast<std::size_t>(part)].range;
      for (;;) {
        before();
        if (next.load(std::memory_order_relaxed) >= ranges) break;
        const std::int64_t range = next++;
        if (range >= ranges) break;
        body(first + begin_of(range, ranges, items), first + begin_of(range + 1, ranges, items));
      }
    }
  }

 private:
  static constexpr int kMostParts = 64;
  static constexpr std::int64_t kRangesOfPart = 4;
  struct alignas(64) Next {
    std::atomic<std::int64_t> range = 0;
  };

  /// Where a range of n items begins. Of many items the ranges shrink, so that threads end at the same time.
  static std::int64_t begin_of(std::int64_t range, std::int64_t ranges, std::int64_t n) {
    if (n < ranges * ranges) return n * range / ranges;
    const std::int64_t left = ranges - range;
    return n - n * left / ranges * left / ranges;
  }

  std::int64_t n_;
  int count_;
  std::array<Next, kMostParts> next_;
};

/// A chain, as threads reach its links. One without links is done.
class RunningChain {
 public:
  explicit RunningChain(std::span<const Link> links) : links_(links) {
    for (std::size_t link = 0; link < links.size(); ++link)
      at_[link].left = at_[link].ranges =
          std::clamp(links[link].n, std::int64_t{1}, std::int64_t{kRangesOfLink} * g_threads);
  }

  /// Runs ranges of the links that are open and that no other thread has taken.
  void take(int thread) {
    for (std::size_t link = open_; link < links_.size(); link = open_) {
      Progress& at = at_[link];
      if (at.next.load(std::memory_order_relaxed) >= at.ranges) return;
      const std::int64_t range = at.next++;
      if (range >= at.ranges) return;
      run(link, range, thread);
      if (at.left.fetch_sub(1) == 1) open_ = thrown_ ? links_.size() : link + 1;
    }
  }
  /// Throws what a link has thrown; adds the times.
  void end() {
    if (g_times)
      for (std::size_t link = 0; link < kMostLinks; ++link) g_times->links[link] += at_[link].seconds;
    if (thrown_) std::rethrow_exception(thrown_);
  }

 private:
  struct Progress {
    std::int64_t ranges = 0;
    std::atomic<std::int64_t> next = 0;
    std::atomic<std::int64_t> left = 0;  ///< ranges that are not done
    std::atomic<double> seconds = 0;
  };

  void run(std::size_t link, std::int64_t range, int thread) {
    const auto from = std::chrono::steady_clock::now();
    const std::int64_t first = links_[link].n * range / at_[link].ranges;
    const std::int64_t last = links_[link].n * (range + 1) / at_[link].ranges;
    t_in_link = true;
    try {
      if (first < last) links_[link].body(first, last);
    } catch (...) {  // thread libraries do not carry it on
      if (!throws_.test_and_set()) thrown_ = std::current_exception();
    }
    t_in_link = false;
    if (g_times) at_[link].seconds += add_time(thread, from, std::max<std::int64_t>(last - first, 1));
  }

  std::span<const Link> links_;
  std::atomic<std::size_t> open_ = 0;  ///< the link whose ranges are taken
  std::array<Progress, kMostLinks> at_;
  std::atomic_flag throws_;
  std::exception_ptr thrown_;
};

/// The chain goes first.
void run_ranges(std::int64_t n, RunningChain& chain,
                FunctionRef<void(std::int64_t, std::int64_t, int)> body) {
  if (g_threads == 1) {
    chain.take(0);
    if (n > 0) body(0, n, 0);
    return;
  }
  Parts parts(n);
  chosen()->run(g_threads, [&](int thread) {
    stay_on_core(thread);
    parts.take(
        thread, [&] { chain.take(thread); },
        [&](std::int64_t first, std::int64_t last) { body(first, last, thread); });
  });
}

/// Runs ranges beside a chain and adds their times.
void run_timed(std::int64_t n, RunningChain& chain, FunctionRef<void(std::int64_t, std::int64_t)> body) {
  if (!g_times) {
    run_ranges(n, chain, [&](std::int64_t first, std::int64_t last, int /*thread*/) { body(first, last); });
    return;
  }
  if (g_times->by_thread.size() < static_cast<std::size_t>(g_threads))
    g_times->by_thread.resize(static_cast<std::size_t>(g_threads));
  const auto started = std::chrono::steady_clock::now();
  run_ranges(n, chain, [&](std::int64_t first, std::int64_t last, int thread) {
    const auto from = std::chrono::steady_clock::now();
    body(first, last);
    add_time(thread, from, last - first);
  });
  g_times->wall += seconds_since(started);
  double longest = 0;
  for (ParallelTimes::Thread& of : g_times->by_thread)
    longest = std::max(longest, std::exchange(of.longest, 0.0));
  g_times->longest += longest;
  ++g_times->calls;
}

}  // namespace

void set_threads(int threads) {
  g_threads = threads < 1 ? 1 : threads;
}
int threads() {
  return g_threads;
}

void bind_threads(std::vector<int> cores) {
  g_cores = std::move(cores);
}

std::vector<std::string_view> backends() {
  std::vector<std::string_view> names;
  names.reserve(kBackends.size());
  for (const ParallelBackend* backend : kBackends) names.emplace_back(backend->name);
  return names;
}
void set_backend(std::string_view name) {
  g_backend = backend_named(name, "backend");
}
std::string_view backend() {
  return chosen()->name;
}

void parallel_ranges(std::int64_t n, FunctionRef<void(std::int64_t, std::int64_t)> body) {
  if (n <= 0) return;
  if (t_in_link) {
    body(0, n);
    return;
  }
  RunningChain none({});
  run_timed(n, none, body);
}

void ranges_beside(std::span<const Link> chain, std::int64_t n,
                   FunctionRef<void(std::int64_t, std::int64_t)> body) {
  TREAD_EXPECT(n >= 0 && chain.size() <= kMostLinks && !t_in_link);
  RunningChain running(chain);
  run_timed(n, running, body);
  running.end();
}

double ParallelTimes::busy() const {
  double sum = 0;
  for (const Thread& thread : by_thread) sum += thread.busy;
  return sum;
}

void measure_parallel(ParallelTimes* times) {
  g_times = times;
}

}  // namespace tread
