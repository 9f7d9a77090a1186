#include "core/geometry/vignole_rail.hpp"

#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include "core/geometry/rounded_corner.hpp"
#include "core/millimetre.hpp"

namespace tread {

namespace {

constexpr double kDegree = std::numbers::pi / 180;

struct Head {
  std::array<Point2, 3> centre;  ///< of the right half's arcs: crown, shoulder, corner
  std::array<Point2, 3> end;     ///< of the arcs, from the middle outwards
};

/// The corner's arc touches the side face; the shoulder's arc touches both neighbours.
Head head_of(const VignoleRail& rail) {
  const auto [crown, shoulder, corner] = rail.head_radii;
  const Point2 face = unit({20, 1});  // outward normal of the side face
  Head head;
  head.centre[0] = {0, -crown};
  const Point2 to_crown_end =
      unit({rail.crown_end, std::sqrt(crown * crown - rail.crown_end * rail.crown_end)});
  head.end[0] = head.centre[0] + crown * to_crown_end;
  head.centre[1] = head.end[0] - shoulder * to_crown_end;
  // Direction u of the shoulder's end: face . (centre + (shoulder - corner) u) = face . side_face - corner.
  const double along = (dot(face, rail.side_face - head.centre[1]) - corner) / (shoulder - corner);
  const Point2 up = {-face.y, face.x};
  const Point2 to_shoulder_end = along * face + std::sqrt(1 - along * along) * up;
  head.end[1] = head.centre[1] + shoulder * to_shoulder_end;
  head.centre[2] = head.end[1] - corner * to_shoulder_end;
  head.end[2] = head.centre[2] + corner * face;
  return head;
}

/// Point of the right side face at height z.
Point2 side_face(const VignoleRail& rail, double z) {
  return {rail.side_face.x + (rail.side_face.y - z) / 20, z};
}

PlaneCurve running_of(const VignoleRail& rail, const Head& head) {
  const auto left = [](Point2 a) { return Point2{-a.x, a.y}; };
  PlaneCurve running(left(side_face(rail, -kRailSideDepth)));
  running.line_to(left(head.end[2]))
      .arc_to(left(head.end[1]), left(head.centre[2]))
      .arc_to(left(head.end[0]), left(head.centre[1]))
      .arc_to(head.end[0], head.centre[0])
      .arc_to(head.end[1], head.centre[1])
      .arc_to(head.end[2], head.centre[2])
      .line_to(side_face(rail, -kRailSideDepth));
  return running;
}

/// Arcs from the web to a fishing surface. `up` is 1 for the head and -1 for the foot.
struct WebArcs {
  std::array<Point2, 4> end;  ///< on the web, between the arcs, on the fishing surface
  std::array<Point2, 3> centre;
};

/// `meeting` is the height of the fishing surface on the middle line.
WebArcs web_arcs(const VignoleRail& rail, double meeting, double up) {
  const std::array<double, 4> angle = {std::numbers::pi / 2, rail.web_angles[0], rail.web_angles[1],
                                       std::atan(rail.fishing_slope)};
  WebArcs arcs;
  arcs.end[0] = {rail.web_thickness / 2, 0};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto normal = [&](double a) { return Point2{std::sin(a), -up * std::cos(a)}; };
    arcs.centre[i] = arcs.end[i] + rail.web_radii[i] * normal(angle[i]);
    arcs.end[i + 1] = arcs.centre[i] - rail.web_radii[i] * normal(angle[i + 1]);
  }
  const double lift = meeting + up * rail.fishing_slope * arcs.end[3].x - arcs.end[3].y;
  for (Point2& point : arcs.end) point.y += lift;
  for (Point2& point : arcs.centre) point.y += lift;
  return arcs;
}

/// Crossing of the line through `a` along `u` and the line through `b` along `v`.
Point2 crossing(Point2 a, Point2 u, Point2 b, Point2 v) {
  return a + (cross(b - a, v) / cross(u, v)) * u;
}

PlaneCurve lower_of(const VignoleRail& rail, const Head& head) {
  const double bottom = -rail.height, half = rail.foot_width / 2;
  const WebArcs upper = web_arcs(rail, -rail.head_depth, 1);
  const WebArcs lower = web_arcs(rail, bottom + rail.foot_height, -1);
  const Point2 head_corner =
      crossing(head.end[2], {1.0 / 20, -1}, {0, -rail.head_depth}, {1, rail.fishing_slope});
  const Point2 edge = {half, bottom + rail.foot_edge};
  const Point2 foot_break =
      crossing({0, bottom + rail.foot_height}, {1, -rail.fishing_slope}, edge, {1, -rail.foot_edge_slope});
  PlaneCurve curve(head.end[2]);
  round_corner(curve, head_corner, upper.end[3], rail.head_corner_radius);
  curve.line_to(upper.end[3]);
  for (std::size_t i = 3; i > 0; --i) curve.arc_to(upper.end[i - 1], upper.centre[i - 1]);
  curve.line_to(lower.end[0]);
  for (std::size_t i = 0; i < 3; ++i) curve.arc_to(lower.end[i + 1], lower.centre[i]);
  round_corner(curve, foot_break, edge, rail.foot_break_radius);
  round_corner(curve, edge, {half, bottom}, rail.foot_edge_radii[0]);
  round_corner(curve, {half, bottom}, {0, bottom}, rail.foot_edge_radii[1]);
  curve.line_to({0, bottom});
  return curve;
}

VignoleRail dimensions_60e1() {
  VignoleRail rail;
  rail.height = 172 * mm;
  rail.head_radii = {300 * mm, 80 * mm, 13 * mm};
  rail.crown_end = 20.456 / 2 * mm;
  rail.side_face = {36 * mm, -14.3 * mm};
  rail.head_corner_radius = 3 * mm;
  rail.fishing_slope = 1 / 2.75;
  rail.head_depth = 51 * mm;
  rail.foot_height = 31.5 * mm;
  rail.web_thickness = 16.5 * mm;
  rail.web_radii = {120 * mm, 35 * mm, 7 * mm};
  rail.web_angles = {76.6 * kDegree, 72.4 * kDegree};  // chosen for the area and the moments of inertia
  rail.foot_width = 150 * mm;
  rail.foot_edge = 11.5 * mm;
  rail.foot_edge_slope = 1.0 / 14;
  rail.foot_break_radius = 40 * mm;
  rail.foot_edge_radii = {4 * mm, 2 * mm};
  return rail;
}

}  // namespace

RailProfile vignole_rail(const VignoleRail& rail) {
  const Head head = head_of(rail);
  RailProfile profile = {running_of(rail, head), lower_of(rail, head), {}, rail.height, rail.web_thickness};
  const std::vector<double> s = profile.lower.joints(0, profile.lower.length());
  const auto middle = [&](std::size_t i) { return 0.5 * (s[i] + s[i + 1]); };
  profile.rounding = {middle(0), middle(2), middle(8), middle(12), middle(14)};
  return profile;
}

RailProfile rail_60e1() {
  return vignole_rail(dimensions_60e1());
}

RailProfile rail_60e2() {
  VignoleRail rail = dimensions_60e1();
  rail.head_radii = {200 * mm, 70 * mm, 13 * mm};
  rail.crown_end = 10.2 * mm;  // chosen for the area
  return vignole_rail(rail);
}

RailProfile rail_49e1() {
  VignoleRail rail = dimensions_60e1();
  rail.height = 149 * mm;
  rail.crown_end = 15.267 / 2 * mm;
  rail.side_face = {33.5 * mm, -14 * mm};
  rail.fishing_slope = 1.0 / 3;
  rail.head_depth = 51.5 * mm;
  rail.foot_height = 27.5 * mm;
  rail.web_thickness = 14 * mm;
  rail.web_angles = {82 * kDegree, 74 * kDegree};  // chosen for the area and the moments of inertia,
  rail.foot_edge_slope = 1.0 / 7;                  // and so is this slope
  rail.foot_width = 125 * mm;
  rail.foot_edge = 10.5 * mm;
  return vignole_rail(rail);
}

}  // namespace tread
