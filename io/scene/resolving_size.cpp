#include "io/scene/resolving_size.hpp"

#include <fmt/core.h>

#include <cmath>

#include "io/scene/schema.hpp"

namespace tread {

std::string resolving_size(double size, const char* part) {
  const double least = find_key("scene.element_size")->range.low;
  if (size < least)
    return fmt::format("no mesh resolves {}: scene.element_size is at least {:g} mm", part, 1e3 * least);
  const double digit = std::pow(10.0, std::floor(std::log10(size)) - 1);
  constexpr double kRounding = 1e-9;
  const double stated = digit * std::floor(size / digit * (1 + kRounding));
  return fmt::format("scene.element_size = \"{:.2g} mm\" resolves {}", 1e3 * stated, part);
}

}  // namespace tread
