#pragma once
// Corners of straight lines that arcs round off.

#include "core/geometry/plane_curve.hpp"

namespace tread {

/// The vector of length 1 in the direction of `a`.
Point2 unit(Point2 a);

/// Continues `curve`, which ends on the line through `corner`, along that line and around the corner with the
/// given radius [m]. The arc ends at the tangent point of the line from `corner` to `next`.
void round_corner(PlaneCurve& curve, Point2 corner, Point2 next, double radius);

}  // namespace tread
