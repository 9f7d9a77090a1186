#include "core/geometry/rounded_corner.hpp"

#include <cmath>

namespace tread {

Point2 unit(Point2 a) {
  return (1 / norm(a)) * a;
}

void round_corner(PlaneCurve& curve, Point2 corner, Point2 next, double radius) {
  const Point2 in = unit(corner - curve.end()), out = unit(next - corner);
  const double turn = std::atan2(cross(in, out), dot(in, out));
  const double cut = radius * std::tan(std::abs(turn) / 2);
  const Point2 centre = corner + (-cut) * in + std::copysign(radius, turn) * Point2{-in.y, in.x};
  curve.line_to(corner + (-cut) * in).arc_to(corner + cut * out, centre);
}

}  // namespace tread
