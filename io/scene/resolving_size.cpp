#include "io/scene/resolving_size.hpp"

#include <fmt/core.h>

#include "io/scene/schema.hpp"

namespace tread {

std::string resolving_size(double size, const char* part) {
  const double least = find_key("scene.element_size")->range.low;
  if (size < least)
    return fmt::format("no mesh resolves {}: scene.element_size is at least {:g} mm", part, 1e3 * least);
  return fmt::format("scene.element_size = \"{:.2g} mm\" resolves {}", 1e3 * size, part);
}

}  // namespace tread
