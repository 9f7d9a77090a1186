#include "core/parallel/parallel.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <string>

#include "core/error.hpp"
#include "core/parallel/parallel_backend.hpp"

namespace tread {

namespace {

constexpr int kRangesPerThread = 8;
/// TBB is the default: its idle threads sleep soon. OpenMP's spin, which takes the cores from other programs
/// and, on busy cores, slows a run by more than ten times.
constexpr std::array<const ParallelBackend*, 2> kBackends = {&tbb_backend, &openmp_backend};

int g_threads = 1;
ParallelTimes* g_times = nullptr;

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

/// Runs several ranges per thread, taken as threads become free. A core that another process uses then slows
/// the rest little.
void run_ranges(std::int64_t n, FunctionRef<void(std::int64_t, std::int64_t, int)> body) {
  if (g_threads == 1) {
    body(0, n, 0);
    return;
  }
  const std::int64_t ranges = std::min(n, std::int64_t{kRangesPerThread} * g_threads);
  chosen()->run(ranges, g_threads, [&](std::int64_t range, int thread) {
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
  if (!g_times) {
    run_ranges(n, [&](std::int64_t first, std::int64_t last, int /*thread*/) { body(first, last); });
    return;
  }
  if (g_times->by_thread.size() < static_cast<std::size_t>(g_threads))
    g_times->by_thread.resize(static_cast<std::size_t>(g_threads));
  const auto started = std::chrono::steady_clock::now();
  run_ranges(n, [&](std::int64_t first, std::int64_t last, int thread) {
    const auto from = std::chrono::steady_clock::now();
    body(first, last);
    g_times->by_thread[static_cast<std::size_t>(thread)].busy += seconds_since(from);
  });
  g_times->wall += seconds_since(started);
  ++g_times->calls;
}

void measure_parallel(ParallelTimes* times) {
  g_times = times;
}

}  // namespace tread
