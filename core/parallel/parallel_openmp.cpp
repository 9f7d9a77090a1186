#include <omp.h>

#include "core/parallel/parallel_backend.hpp"

namespace tread {

namespace {

void run(int threads, FunctionRef<void(int)> work) {
#pragma omp parallel num_threads(threads)
  work(omp_get_thread_num());
}

}  // namespace

const ParallelBackend openmp_backend = {"openmp", run};

}  // namespace tread
