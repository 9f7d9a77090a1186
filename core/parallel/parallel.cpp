#include "core/parallel/parallel.hpp"

#include <fmt/core.h>
#include <sched.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <exception>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "core/parallel/parallel_backend.hpp"

namespace tread {

namespace {

constexpr int kRangesPerThread = 8;
/// TBB is the default: its idle threads sleep soon. OpenMP's spin, which takes the cores from other programs
/// and, on busy cores, slows a run by more than ten times.
constexpr std::array<const ParallelBackend*, 2> kBackends = {&tbb_backend, &openmp_backend};

int g_threads = 1;
std::vector<int> g_cores;  ///< bind_threads
ParallelTimes* g_times = nullptr;
/// For this thread's next call of parallel_ranges, to run too.
thread_local const FunctionRef<void()>* t_beside = nullptr;
thread_local bool t_alone = false;  ///< this thread runs what beside() has given it

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

/// Adds what a thread has done from `start` on to its times; `items`: how many it was.
void add_time(int thread, std::chrono::steady_clock::time_point start, std::int64_t items) {
  const double seconds = seconds_since(start);
  ParallelTimes::Thread& of = g_times->by_thread[static_cast<std::size_t>(thread)];
  of.busy += seconds;
  of.longest = std::max(of.longest, seconds / static_cast<double>(items));
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

/// Runs several ranges per thread, taken as threads become free. A core that another process uses then slows
/// the rest little. `alone` goes first.
void run_ranges(std::int64_t n, const FunctionRef<void()>* alone,
                FunctionRef<void(std::int64_t, std::int64_t, int)> body) {
  if (g_threads == 1) {
    body(0, n, 0);
    return;
  }
  const std::int64_t ranges = std::min(n, std::int64_t{kRangesPerThread} * g_threads);
  const std::int64_t first = alone != nullptr ? 1 : 0;
  chosen()->run(first + ranges, g_threads, [&](std::int64_t item, int thread) {
    stay_on_core(thread);
    if (item < first) {
      const auto from = std::chrono::steady_clock::now();
      (*alone)();
      if (g_times) add_time(thread, from, 1);
      return;
    }
    const std::int64_t range = item - first;
    body(n * range / ranges, n * (range + 1) / ranges, thread);
  });
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
  if (t_alone) {
    body(0, n);
    return;
  }
  const FunctionRef<void()>* const alone = std::exchange(t_beside, nullptr);
  if (!g_times) {
    run_ranges(n, alone, [&](std::int64_t first, std::int64_t last, int /*thread*/) { body(first, last); });
    return;
  }
  if (g_times->by_thread.size() < static_cast<std::size_t>(g_threads))
    g_times->by_thread.resize(static_cast<std::size_t>(g_threads));
  const auto started = std::chrono::steady_clock::now();
  run_ranges(n, alone, [&](std::int64_t first, std::int64_t last, int thread) {
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

void beside(FunctionRef<void()> alone, FunctionRef<void()> shared) {
  if (g_threads == 1 || t_alone) {
    alone();
    shared();
    return;
  }
  std::exception_ptr thrown;
  const auto run_alone = [&] {
    const auto from = std::chrono::steady_clock::now();
    t_alone = true;
    try {
      alone();
    } catch (...) {  // thread libraries do not carry it on
      thrown = std::current_exception();
    }
    t_alone = false;
    if (g_times) g_times->alone += seconds_since(from);
  };
  const FunctionRef<void()> waiting(run_alone);
  t_beside = &waiting;
  try {
    shared();
  } catch (...) {
    t_beside = nullptr;
    throw;
  }
  if (std::exchange(t_beside, nullptr)) run_alone();
  if (thrown) std::rethrow_exception(thrown);
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
