#pragma once
// Interface of a thread library. Private to core/parallel/.

#include "core/function_ref.hpp"

namespace tread {

struct ParallelBackend {
  const char* name;
  /// Calls work(thread) on `threads` threads at most, numbered from 0, the calling one among them. A thread
  /// has the same number in later calls, as far as may be. Returns when all calls are done.
  void (*run)(int threads, FunctionRef<void(int)> work);
};

extern const ParallelBackend openmp_backend;
extern const ParallelBackend tbb_backend;

}  // namespace tread
