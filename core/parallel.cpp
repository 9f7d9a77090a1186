#include "core/parallel.hpp"

#include <omp.h>

namespace tread {

namespace {
int g_threads = 1;
}

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
#pragma omp parallel num_threads(g_threads)
  {
    const std::int64_t rank = omp_get_thread_num();
    const std::int64_t count = omp_get_num_threads();
    const std::int64_t first = n * rank / count;
    const std::int64_t last = n * (rank + 1) / count;
    if (first < last) body(first, last);
  }
}

}  // namespace tread
