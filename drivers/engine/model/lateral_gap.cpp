#include "drivers/engine/model/lateral_gap.hpp"

#include <algorithm>

namespace tread {

LateralGap lateral_gap(const SurfaceProfile& rail, const SurfaceProfile& wheel) {
  constexpr double kHalfWidth = 5e-3;
  constexpr int kSamples = 400;
  constexpr double kParallel = 1e-8;  // [m]
  const double first = std::max(rail.first_p(), wheel.first_p());
  const double last = std::min(rail.last_p(), wheel.last_p());
  const auto gap = [&](double p) { return -rail.q_at(p) - wheel.q_at(p); };
  double lowest = first, highest = first;
  for (int i = 0; i <= kSamples; ++i) {
    const double p = first + (last - first) * i / kSamples;
    if (gap(p) < gap(lowest)) lowest = p;
    if (gap(p) > gap(highest)) highest = p;
  }
  double numerator = 0;
  double denominator = 0;
  for (int i = -20; i <= 20; ++i) {
    const double s = kHalfWidth * i / 20;
    const double p = lowest + s;
    if (p < first || p > last) continue;  // beside an edge
    const double rise = gap(p) - gap(lowest);
    numerator += rise * s * s;
    denominator += s * s * s * s;
  }
  const double curvature = denominator > 0 ? 2 * numerator / denominator : 0;
  const bool parallel = gap(highest) - gap(lowest) < kParallel;
  return {lowest, 1 / std::max(curvature, 1e-2), last - first, parallel ? last - first : 0};
}

}  // namespace tread
