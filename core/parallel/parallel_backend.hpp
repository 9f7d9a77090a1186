#pragma once
// Interface of a thread library. Private to core/parallel/.

#include <cstdint>

#include "core/function_ref.hpp"

namespace tread {

struct ParallelBackend {
  const char* name;
  /// Calls task(i, thread) once for every i in [0, count) on at most `threads` threads, numbered from 0, in
  /// that order as they become free. Returns when all calls are done.
  void (*run)(std::int64_t count, int threads, FunctionRef<void(std::int64_t, int)> task);
};

extern const ParallelBackend openmp_backend;
extern const ParallelBackend tbb_backend;

}  // namespace tread
