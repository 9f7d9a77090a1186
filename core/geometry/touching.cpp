#include "core/geometry/touching.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"

namespace tread {

namespace {

Point2 turned(Point2 a, double angle) {
  return {std::cos(angle) * a.x - std::sin(angle) * a.y, std::sin(angle) * a.x + std::cos(angle) * a.y};
}

}  // namespace

Touching touching(const PlaneCurve& rail, double inclination, const PlaneCurve& wheel,
                  double lateral_offset) {
  constexpr int kSamples = 1500;
  const double angle = std::atan(inclination);
  const double first = wheel.start().x, last = wheel.end().x;
  double best = 0, lowest = std::numeric_limits<double>::infinity();
  const auto gap = [&](double s) {
    const Point2 point = turned(rail.at(s).position, angle);
    const double y = point.x + lateral_offset;
    if (y < first || y > last) return std::numeric_limits<double>::infinity();
    return -point.y - wheel.at(wheel.at_x(y)).position.y;
  };
  const auto search = [&](double from, double to, int samples) {
    for (int i = 0; i <= samples; ++i) {
      const double s = from + (to - from) * i / samples;
      if (const double here = gap(s); here < lowest) {
        lowest = here;
        best = s;
      }
    }
  };
  search(0, rail.length(), kSamples);
  if (!std::isfinite(lowest))
    throw InputError(
        fmt::format("the wheel profile, y = {:.1f} ... {:.1f} mm, does not stand over the rail with "
                    "wheel.lateral_offset = {:.1f} mm",
                    1e3 * first, 1e3 * last, 1e3 * lateral_offset));
  const double step = rail.length() / kSamples;
  search(std::max(0.0, best - step), std::min(rail.length(), best + step), 200);
  const CurvePoint here = rail.at(best);
  const Point2 tangent = turned(here.tangent, angle), place = turned(here.position, angle);
  return {here.position, place.x, place.x + lateral_offset, tangent.y / tangent.x};
}

}  // namespace tread
