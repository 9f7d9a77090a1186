#pragma once
// Quality of a section mesh, and the step that its quads allow.

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/geometry/plane_curve.hpp"
#include "core/mesh/section.hpp"

namespace tread::samples {

inline Point2 node(const Section& section, int n) {
  return {section.p[static_cast<std::size_t>(n)], section.q[static_cast<std::size_t>(n)]};
}

/// Worst quad_quality() [-].
inline double worst_quality(const Section& section) {
  double worst = 1;
  for (int quad = 0; quad < static_cast<int>(section.quads.size()); ++quad)
    worst = std::min(worst, quad_quality(section, quad));
  return worst;
}

/// Side [m] of the smallest square with the stable step of one of the quads: 2 / side^2 = 1 / a^2 + 1 / b^2
/// with the mean lengths a, b of opposite edges.
inline double smallest_square(const Section& section) {
  double smallest = 1;
  for (const auto& quad : section.quads) {
    Point2 x[4];
    for (std::size_t c = 0; c < 4; ++c) x[c] = node(section, quad[c]);
    const double a = 0.5 * (norm(x[1] - x[0]) + norm(x[2] - x[3]));
    const double b = 0.5 * (norm(x[2] - x[1]) + norm(x[3] - x[0]));
    smallest = std::min(smallest, std::sqrt(2 / (1 / (a * a) + 1 / (b * b))));
  }
  return smallest;
}

}  // namespace tread::samples
