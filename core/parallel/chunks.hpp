#pragma once
// Loops and sums over long vectors in chunks of fixed size: the same bits for any number of threads.

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/parallel/parallel.hpp"

namespace tread {

inline constexpr std::int64_t kChunk = 4096;  ///< values per chunk: two such vectors fit a first-level cache

/// Calls body(first, last) for every chunk of [0, n), in parallel.
template <class Body>
void for_chunks(std::int64_t n, const Body& body) {
  parallel_ranges((n + kChunk - 1) / kChunk, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t c = first; c < last; ++c) body(c * kChunk, std::min(n, (c + 1) * kChunk));
  });
}

/// Sum of the results of body(first, last) over all chunks of [0, n), added in the order of the chunks.
template <class Body>
double sum_chunks(std::int64_t n, const Body& body) {
  std::vector<double> part(static_cast<std::size_t>((n + kChunk - 1) / kChunk));
  for_chunks(n, [&](std::int64_t first, std::int64_t last) {
    part[static_cast<std::size_t>(first / kChunk)] = body(first, last);
  });
  double sum = 0;
  for (const double value : part) sum += value;
  return sum;
}

/// The product of [first, last), by this thread.
inline double dot_of_range(std::int64_t first, std::int64_t last, const double* a, const double* b) {
  double lane[8] = {};
  std::int64_t i = first;
  for (; i + 8 <= last; i += 8)
    for (int l = 0; l < 8; ++l) lane[l] += a[i + l] * b[i + l];
  for (; i < last; ++i) lane[0] += a[i] * b[i];
  return ((lane[0] + lane[4]) + (lane[1] + lane[5])) + ((lane[2] + lane[6]) + (lane[3] + lane[7]));
}

inline double dot(std::int64_t n, const double* a, const double* b) {
  return sum_chunks(n,
                    [=](std::int64_t first, std::int64_t last) { return dot_of_range(first, last, a, b); });
}

}  // namespace tread
