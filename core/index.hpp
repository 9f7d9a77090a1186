#pragma once

#include <cstddef>
#include <cstdint>

namespace tread {

/// A number that is not negative, for the subscript of a container.
constexpr std::size_t index(std::int64_t i) {
  return static_cast<std::size_t>(i);
}

}  // namespace tread
