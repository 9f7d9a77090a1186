#pragma once
// The one interface behind which threads live. Work is cut into items that do not depend on the number of
// threads; every item writes only its own data, so results are the same bits for any number of threads.

#include <cstdint>
#include <functional>

namespace tread {

/// Sets the number of threads used by parallel_for (>= 1).
void set_threads(int threads);
int threads();

/// Calls body(first, last) on disjoint ranges that cover [0, n), in parallel. Ranges are contiguous and
/// depend on the number of threads: body must treat items independently of one another.
void parallel_ranges(std::int64_t n, const std::function<void(std::int64_t, std::int64_t)>& body);

}  // namespace tread
