#pragma once
// Independent pieces of work that may fail.

#include <cstddef>
#include <exception>
#include <vector>

#include "core/parallel/parallel.hpp"

namespace tread {

/// Calls body(0) ... body(count - 1) in parallel. If calls throw, all others are finished first; then the
/// error of the first in order is thrown.
template <class Body>
void each_item(std::size_t count, const Body& body) {
  std::vector<std::exception_ptr> errors(count);
  parallel_ranges(static_cast<std::int64_t>(count), [&](std::int64_t from, std::int64_t to) {
    for (auto i = static_cast<std::size_t>(from); i < static_cast<std::size_t>(to); ++i) try {
        body(i);
      } catch (...) {
        errors[i] = std::current_exception();
      }
  });
  for (const std::exception_ptr& error : errors)
    if (error) std::rethrow_exception(error);
}

}  // namespace tread
