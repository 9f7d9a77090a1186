#pragma once
// The one interface behind which threads live. Work is cut into items that do not depend on the number of
// threads; every item writes only its own data, so results are the same bits for any number of threads and
// for either backend.

#include <cstdint>
#include <string_view>
#include <vector>

#include "core/function_ref.hpp"

namespace tread {

/// Sets the number of threads used by parallel_ranges (>= 1).
void set_threads(int threads);
int threads();

/// The libraries that can run the threads, the default first.
std::vector<std::string_view> backends();

/// Chooses one; InputError for a name that is not among them. Until then it is the one that the environment's
/// TREAD_BACKEND names, or the default.
void set_backend(std::string_view name);
std::string_view backend();

/// Calls body(first, last) on disjoint ranges that cover [0, n), in parallel. Ranges are contiguous and
/// depend on the number of threads: body must treat items independently of one another. Not to be called from
/// a body.
void parallel_ranges(std::int64_t n, FunctionRef<void(std::int64_t, std::int64_t)> body);

/// How the time inside parallel_ranges is spent.
struct ParallelTimes {
  struct alignas(64) Thread {
    double busy = 0;  ///< in bodies [s]
  };
  std::vector<Thread> by_thread;
  std::int64_t calls = 0;
  double wall = 0;  ///< [s]
};

/// From now on every call adds its times to `times`, which needs no set-up; null ends that. When off it costs
/// a comparison a call.
void measure_parallel(ParallelTimes* times);

}  // namespace tread
