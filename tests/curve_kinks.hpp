#pragma once
// Kinks of curves.

#include <algorithm>
#include <cmath>

#include "core/geometry/plane_curve.hpp"

namespace tread::samples {

/// Largest sine of the angle between the tangents on the two sides of a joint, between two lengths along the
/// curve [m].
inline double largest_kink(const PlaneCurve& curve, double from, double to) {
  double kink = 0;
  for (const double s : curve.joints(from, to))
    kink =
        std::max(kink, std::abs(cross(curve.at(s, Side::before).tangent, curve.at(s, Side::after).tangent)));
  return kink;
}
inline double largest_kink(const PlaneCurve& curve) {
  return largest_kink(curve, 0, curve.length());
}

}  // namespace tread::samples
