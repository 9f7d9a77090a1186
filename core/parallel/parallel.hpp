#pragma once
// The one interface behind which threads live. Work is cut into items that do not depend on the number of
// threads. Every item writes only its own data, so results are bit-identical for any number of threads and
// for either backend.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "core/function_ref.hpp"

namespace tread {

/// Sets the number of threads used by parallel_ranges (>= 1).
void set_threads(int threads);
int threads();

/// Names of the libraries that can run the threads, the default first.
std::vector<std::string_view> backends();

/// Chooses a backend. Throws InputError for a name that is not among backends(). Without a call, the
/// environment's TREAD_BACKEND or the default holds.
void set_backend(std::string_view name);
std::string_view backend();

/// Keeps each thread that parallel_ranges adds to the calling one on a core of its own from its next item on:
/// the next ones of `cores`, numbers of the machine's, of which the first is left to the calling thread. A
/// thread that is kept stays so. Empty: no more are kept.
void bind_threads(std::vector<int> cores);

/// Lets this thread run on all cores of OpenMP's places, on the first of which its library keeps it where the
/// environment states OMP_PROC_BIND: threads of other libraries and processes inherit its cores. For the
/// begin of a program.
void leave_openmp_place();

/// Calls body(first, last) on disjoint ranges that cover [0, n), in parallel. Ranges are contiguous and
/// depend on the number of threads: body must treat items independently of one another. A body must not call
/// this function.
void parallel_ranges(std::int64_t n, FunctionRef<void(std::int64_t, std::int64_t)> body);

/// Work on ranges of [0, n).
struct Link {
  std::int64_t n;
  FunctionRef<void(std::int64_t, std::int64_t)> body;
};
inline constexpr std::size_t kMostLinks = 3;

/// parallel_ranges(n, body) beside a chain of links, each of which begins once the one before is done.
/// Threads prefer the links. Neither may touch what the other writes. In links, calls of parallel_ranges stay
/// on their thread. An error of a link ends the chain, and is thrown once all is done.
void ranges_beside(std::span<const Link> chain, std::int64_t n,
                   FunctionRef<void(std::int64_t, std::int64_t)> body);

/// Times spent inside parallel_ranges.
struct ParallelTimes {
  struct alignas(64) Thread {
    double busy = 0;     ///< time in bodies and links [s]
    double longest = 0;  ///< item of this call [s]
  };
  std::vector<Thread> by_thread;
  std::int64_t calls = 0;
  double wall = 0;     ///< time of all calls [s]
  double longest = 0;  ///< sum of the calls' longest items; an item takes the mean of its range [s]
  /// Core-time of chains that ran beside the calls, by link [s].
  std::array<double, kMostLinks> links{};

  double busy() const;  ///< of all threads [s]
};

/// Makes every following call add its times to `times`, which needs no set-up; null ends the measurement.
/// Without a measurement the cost is one comparison per call.
void measure_parallel(ParallelTimes* times);

}  // namespace tread
