#include "core/parallel.hpp"

#include <omp.h>

#include <algorithm>

namespace tread {

namespace {
constexpr int kRangesPerThread = 8;
int g_threads = 1;
}  // namespace

void set_threads(int threads) {
  g_threads = threads < 1 ? 1 : threads;
}
int threads() {
  return g_threads;
}

void parallel_ranges(std::int64_t n, const std::function<void(std::int64_t, std::int64_t)>& body) {
  if (n <= 0) return;
  if (g_threads == 1) {
    body(0, n);
    return;
  }
  // Several ranges per thread, taken as threads become free: a core that something else uses slows the rest
  // little.
  const std::int64_t ranges = std::min(n, std::int64_t{kRangesPerThread} * g_threads);
#pragma omp parallel for num_threads(g_threads) schedule(dynamic, 1)
  for (std::int64_t range = 0; range < ranges; ++range) body(n * range / ranges, n * (range + 1) / ranges);
}

}  // namespace tread
