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

constexpr int kRangesOfFirstLink = 2;  ///< by thread
/// TBB is the default: its idle threads sleep soon. OpenMP's spin, which takes the cores from other programs
/// and, on busy cores, slows a run by more than ten times.
constexpr std::array<const ParallelBackend*, 2> kBackends = {&tbb_backend, &openmp_backend};

int g_threads = 1;
std::vector<int> g_cores;  ///< bind_threads
ParallelTimes* g_times = nullptr;
thread_local bool t_in_link = false;  ///< this thread is in a link after the first of a chain

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

const ParallelBackend*& chosen() {
  static const ParallelBackend* backend = [] {
    const char* name = std::getenv("TREAD_BACKEND");
    return name && *name != '\0' ? backend_named(name, "the environment's TREAD_BACKEND") : kBackends.front();
  }();
  return backend;
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

  /// Calls body(first, last) on ranges that no other thread has taken.
  template <class Body>
  void take(int thread, const Body& body) {
    for (int i = 0; i < count_; ++i) {
      const int part = (thread + i) % count_;
      const std::int64_t first = n_ * part / count_;
      const std::int64_t items = n_ * (part + 1) / count_ - first;
      const std::int64_t ranges = std::min(items, kRangesOfPart);
      std::atomic<std::int64_t>& next = next_[static_cast<std::size_t>(part)].range;
      for (std::int64_t range = 0;
           next.load(std::memory_order_relaxed) < ranges && (range = next++) < ranges;)
        body(first + begin_of(range, ranges, items), first + begin_of(range + 1, ranges, items));
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

/// The links of a chain, as threads reach them.
class RunningChain {
 public:
  explicit RunningChain(const Chain& chain)
      : chain_(&chain),
        ranges_(std::clamp(chain.n, std::int64_t{1}, std::int64_t{kRangesOfFirstLink} * g_threads)),
        left_(ranges_) {}

  /// Runs ranges of the first link that no other thread has taken; after the last of them the other links.
  void take(int thread) {
    for (std::int64_t range = 0; (range = next_++) < ranges_;) run(range, thread);
  }
  /// Throws what a link has thrown; adds the times.
  void end() {
    if (g_times) {
      g_times->links[0] += seconds_of_first_;
      for (std::size_t link = 1; link < kMostLinks; ++link) g_times->links[link] += seconds_[link];
    }
    if (thrown_) std::rethrow_exception(thrown_);
  }

 private:
  void run(std::int64_t range, int thread) {
    const auto from = std::chrono::steady_clock::now();
    const std::int64_t first = chain_->n * range / ranges_;
    const std::int64_t last = chain_->n * (range + 1) / ranges_;
    if (first < last) chain_->first(first, last);
    if (g_times) seconds_of_first_ += add_time(thread, from, std::max<std::int64_t>(last - first, 1));
    if (left_.fetch_sub(1) == 1) run_others(thread);
  }
  void run_others(int thread) {
    const auto from = std::chrono::steady_clock::now();
    t_in_link = true;
    try {
      std::size_t link = 0;
      for (const FunctionRef<void()>& then : chain_->then) {
        const auto begun = std::chrono::steady_clock::now();
        then();
        seconds_[++link] = seconds_since(begun);
      }
    } catch (...) {  // thread libraries do not carry it on
      thrown_ = std::current_exception();
    }
    t_in_link = false;
    if (g_times) add_time(thread, from, 1);
  }

  const Chain* chain_;
  std::int64_t ranges_;
  std::atomic<std::int64_t> next_ = 0;
  std::atomic<std::int64_t> left_;  ///< ranges of the first link that are not done
  std::atomic<double> seconds_of_first_ = 0;
  std::array<double, kMostLinks> seconds_{};
  std::exception_ptr thrown_;
};

/// The chain goes first.
void run_ranges(std::int64_t n, RunningChain* chain,
                FunctionRef<void(std::int64_t, std::int64_t, int)> body) {
  if (g_threads == 1) {
    if (chain != nullptr) chain->take(0);
    if (n > 0) body(0, n, 0);
    return;
  }
  Parts parts(n);
  chosen()->run(g_threads, [&](int thread) {
    stay_on_core(thread);
    if (chain != nullptr) chain->take(thread);
    parts.take(thread, [&](std::int64_t first, std::int64_t last) { body(first, last, thread); });
  });
}

/// Runs ranges, beside a chain or null, and adds their times.
void run_timed(std::int64_t n, RunningChain* chain, FunctionRef<void(std::int64_t, std::int64_t)> body) {
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
  chosen() = backend_named(name, "backend");
}
std::string_view backend() {
  return chosen()->name;
}

void parallel_ranges(std::int64_t n, FunctionRef<void(std::int64_t, std::int64_t)> body) {
  if (n <= 0) return;
  if (t_in_link)
    body(0, n);
  else
    run_timed(n, nullptr, body);
}

void ranges_beside(const Chain& chain, std::int64_t n, FunctionRef<void(std::int64_t, std::int64_t)> body) {
  TREAD_EXPECT(n >= 0 && chain.then.size() < kMostLinks && !t_in_link);
  RunningChain running(chain);
  run_timed(n, &running, body);
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
