#include <omp.h>

#include "core/parallel/parallel_backend.hpp"

namespace tread {

namespace {

void run(std::int64_t count, int threads, FunctionRef<void(std::int64_t, int)> task) {
#pragma omp parallel for num_threads(threads) schedule(dynamic, 1)
  for (std::int64_t i = 0; i < count; ++i) task(i, omp_get_thread_num());
}

}  // namespace

const ParallelBackend openmp_backend = {"openmp", run};

}  // namespace tread
