#include <omp.h>
#include <sched.h>

#include <vector>

#include "core/parallel/parallel.hpp"
#include "core/parallel/parallel_backend.hpp"

namespace tread {

namespace {

void run(int threads, FunctionRef<void(int)> work) {
#pragma omp parallel num_threads(threads)
  work(omp_get_thread_num());
}

}  // namespace

const ParallelBackend openmp_backend = {"openmp", run};

void leave_openmp_place() {
  if (omp_get_proc_bind() == omp_proc_bind_false) return;
  cpu_set_t cores;
  CPU_ZERO(&cores);
  for (int place = 0; place < omp_get_num_places(); ++place) {
    std::vector<int> of_place(static_cast<std::size_t>(omp_get_place_num_procs(place)));
    omp_get_place_proc_ids(place, of_place.data());
    for (const int core : of_place)
      if (core < CPU_SETSIZE) CPU_SET(static_cast<std::size_t>(core), &cores);
  }
  if (CPU_COUNT(&cores) > 0) ::sched_setaffinity(0, sizeof(cores), &cores);
}

}  // namespace tread
