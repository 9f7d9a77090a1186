#include "io/report/shades.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace tread {

std::string shade(double share) {
  const double at = std::clamp(share, 0.0, 1.0) * (kShadeStops.size() - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(at), kShadeStops.size() - 2);
  const double part = at - static_cast<double>(i);
  std::array<int, 3> rgb{};
  for (std::size_t c = 0; c < 3; ++c)
    rgb[c] = static_cast<int>(std::lround((1 - part) * kShadeStops[i][c] + part * kShadeStops[i + 1][c]));
  return fmt::format("#{:02x}{:02x}{:02x}", rgb[0], rgb[1], rgb[2]);
}

}  // namespace tread
