#pragma once
// Lists from marks.

#include <cstdint>
#include <iterator>
#include <vector>

#include "core/index.hpp"

namespace tread {

/// Numbers of what is marked, ascending.
template <class Mark>
std::vector<std::int64_t> marked(const std::vector<Mark>& marks) {
  std::vector<std::int64_t> numbers;
  for (std::int64_t i = 0; i < std::ssize(marks); ++i)
    if (marks[index(i)]) numbers.push_back(i);
  numbers.shrink_to_fit();
  return numbers;
}

}  // namespace tread
