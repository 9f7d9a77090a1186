#pragma once
// Loops over so few values that waking threads would take longer than the work.

#include <cstdint>

#include "core/parallel/parallel.hpp"

namespace tread {

inline constexpr std::int64_t kFewValues = 32768;  ///< one thread reads and writes them within about 20 us

/// Calls body(first, last) on ranges that cover [0, n), in parallel where the items hold more than a few
/// `values` in all.
template <class Body>
void ranges_of_values(std::int64_t n, std::int64_t values, const Body& body) {
  if (values > kFewValues)
    parallel_ranges(n, body);
  else if (n > 0)
    body(std::int64_t{0}, n);
}

}  // namespace tread
