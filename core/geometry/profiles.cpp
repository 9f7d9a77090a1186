#include "core/geometry/profiles.hpp"

#include <fmt/core.h>

#include <cmath>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/geometry/rounded_corner.hpp"
#include "core/millimetre.hpp"

namespace tread {

namespace {

/// Tangent circle between a straight face and the web's arc.
struct Fillet {
  Point2 on_face, on_web, centre;
};

/// Fillet outside the metal: `face` lies on the face, `normal` points away from the metal. Of the two tangent
/// circles, the one nearer to the web is taken.
Fillet web_fillet(Point2 face, Point2 normal, double radius, Point2 web_centre, double web_radius) {
  const Point2 origin = face + radius * normal;
  Point2 along = {-normal.y, normal.x};
  if (along.x > 0) along = -1.0 * along;
  const Point2 d = origin - web_centre;
  const double reach = web_radius - radius;
  const double b = dot(d, along);
  const double t = -b + std::sqrt(b * b - dot(d, d) + reach * reach);
  const Point2 centre = origin + t * along;
  return {centre - radius * normal, web_centre + web_radius * unit(centre - web_centre), centre};
}

struct Cn60Head {
  Point2 crown_end, shoulder_end, corner_end;  // joints R300-R80, R80-R13, R13-side face
  Point2 crown, shoulder, corner;              // centres of the arcs
};

Cn60Head cn60_head() {
  Cn60Head head;
  head.crown = {0, -300 * mm};
  const Point2 to_crown_end = unit({10, std::sqrt(300.0 * 300 - 100)});
  head.crown_end = head.crown + 300 * mm * to_crown_end;
  head.shoulder = head.crown_end - 80 * mm * to_crown_end;
  const double sine = (25.35 * mm - head.shoulder.x) / (80 * mm);
  const Point2 to_shoulder_end = {sine, std::sqrt(1 - sine * sine)};
  head.shoulder_end = head.shoulder + 80 * mm * to_shoulder_end;
  head.corner = head.shoulder_end - 13 * mm * to_shoulder_end;
  head.corner_end = head.corner + 13 * mm * unit({20, 1});
  return head;
}

/// Point of the side face, 1 in 20 from the vertical, at height z.
Point2 side_face(const Cn60Head& head, double z) {
  return {head.corner_end.x + (head.corner_end.y - z) / 20, z};
}

PlaneCurve cn60_lower() {
  const Cn60Head head = cn60_head();
  const double height = 176 * mm;
  const auto point = [&](double x, double above_base) { return Point2{x * mm, above_base * mm - height}; };

  const Point2 web_centre = point(408.25, 79);
  const Point2 under = point(0, 127.5);
  const Point2 foot = point(46, 15.222), foot_edge = point(75, 12), foot_corner = point(75, 0);
  const Fillet upper = web_fillet(under, unit({1, -3}), 12 * mm, web_centre, 400 * mm);
  const Fillet lower = web_fillet(foot, unit({1, 3}), 20 * mm, web_centre, 400 * mm);

  // The side face x = corner_end.x + (corner_end.y - z) / 20 meets the underside z = under.y + x / 3.
  const double corner_x = (head.corner_end.x + (head.corner_end.y - under.y) / 20) / (1 + 1.0 / 60);
  const Point2 head_corner = {corner_x, under.y + corner_x / 3};

  PlaneCurve curve(head.corner_end);
  round_corner(curve, head_corner, upper.on_face, 3 * mm);
  curve.line_to(upper.on_face).arc_to(upper.on_web, upper.centre);
  curve.arc_to(lower.on_web, web_centre).arc_to(lower.on_face, lower.centre);
  round_corner(curve, foot, foot_edge, 40 * mm);
  round_corner(curve, foot_edge, foot_corner, 4 * mm);
  round_corner(curve, foot_corner, {0, -height}, 2 * mm);
  curve.line_to({0, -height});
  return curve;
}

RailProfile cn60_under(PlaneCurve running) {
  RailProfile rail = {std::move(running), cn60_lower(), {}, 176 * mm, 16.5 * mm};
  const std::vector<double> s = rail.lower.joints(0, rail.lower.length());
  const auto middle = [&](std::size_t i) { return 0.5 * (s[i] + s[i + 1]); };
  rail.rounding = {middle(0), middle(2), middle(4), middle(8), middle(10)};
  return rail;
}

}  // namespace

RailProfile cn60() {
  const Cn60Head head = cn60_head();
  const auto left = [](Point2 a) { return Point2{-a.x, a.y}; };
  PlaneCurve running(left(side_face(head, -kRailSideDepth)));
  running.line_to(left(head.corner_end))
      .arc_to(left(head.shoulder_end), left(head.corner))
      .arc_to(left(head.crown_end), left(head.shoulder))
      .arc_to(head.crown_end, head.crown)
      .arc_to(head.shoulder_end, head.shoulder)
      .arc_to(head.corner_end, head.corner)
      .line_to(side_face(head, -kRailSideDepth));
  return cn60_under(std::move(running));
}

RailProfile rail_with_head(std::span<const double> y, std::span<const double> z, RailProfile section,
                           double shift) {
  constexpr double kDeepest = 18 * mm;    // of the table's points
  constexpr double kNarrowest = 27 * mm;  // half a worn head
  constexpr double kOverhang = 1.5 * mm;  // of a head that has flowed beyond the side face
  constexpr double kJoin = 20 * mm;       // depth at which the straight lines meet the side faces
  const PlaneCurve measured = curve_through(y, z, "rail profile");
  const double crown = measured.at(measured.at_x(0)).position.y;
  std::vector<double> kept_y, kept_z;
  for (std::size_t i = 0; i < y.size(); ++i)
    if (z[i] - crown > -kDeepest) {
      kept_y.push_back(y[i]);
      kept_z.push_back(z[i] - crown);
    }
  const Point2 high = section.lower.start(), low = section.running.end();
  const auto side = [&](double depth) {
    return Point2{high.x + (low.x - high.x) * (depth + high.y) / (high.y - low.y), -depth};
  };
  constexpr double kWhole = 4 * mm;  // a head less narrow than this is not worn at its sides
  const double widest = side(kDeepest).x + kOverhang;
  if (kept_y.size() < 3)
    throw InputError("rail profile: fewer than 3 points lie less than 18 mm below the point at y = 0");
  if (kept_y.front() > -kNarrowest || kept_y.back() < kNarrowest || kept_y.front() < -widest ||
      kept_y.back() > widest) {
    const double middle = (kept_y.front() + kept_y.back()) / 2, half = (kept_y.back() - kept_y.front()) / 2;
    const std::string lean = lean_hint(head_lean(measured, middle));
    throw InputError(fmt::format(
        "rail profile: the table spans y = {:.1f} ... {:.1f} mm above 18 mm below the crown; it has to end "
        "between {:.1f} and {:.1f} mm on either side of the middle: {}",
        kept_y.front() / mm, kept_y.back() / mm, kNarrowest / mm, widest / mm,
        half >= widest - kWhole && half <= widest
            ? fmt::format(
                  "its own middle is y = {:.1f} mm, which rail.profile_shift = \"{:.1f} mm\" corrects{}{}",
                  middle / mm, (shift - middle) / mm, lean.empty() ? "" : "; ", lean)
            : "are the units right, is the whole head measured, and does rail.section name the rail?"));
  }

  const auto left = [](Point2 a) { return Point2{-a.x, a.y}; };
  PlaneCurve running(left(low));
  running.line_to(left(side(kJoin)))
      .line_to({kept_y.front(), kept_z.front()})
      .append(curve_through(kept_y, kept_z, "rail profile"))
      .line_to(side(kJoin))
      .line_to(low);
  section.running = std::move(running);
  return section;
}

double head_lean(const PlaneCurve& head, double middle) {
  constexpr double kBeside = 10 * mm;
  constexpr double kLean = 0.01;  // rails lean by 1:40 or 1:20 in the track
  const Point2 left = head.at(head.at_x(middle - kBeside)).position;
  const Point2 right = head.at(head.at_x(middle + kBeside)).position;
  const double lean = (right.y - left.y) / (right.x - left.x);
  return std::abs(lean) > kLean ? lean : 0;
}

std::string lean_hint(double lean) {
  if (lean == 0) return "";
  return fmt::format("the head leans by 1:{:.0f} to the {}", 1 / std::abs(lean),
                     lean > 0 ? "track's middle: if it was measured in the track, state rail.inclination = 0"
                              : "field side: if it is a right rail, state rail.profile_mirrored = true");
}

WheelProfile lma() {
  // Centres to the micrometre from the standard; only the directions between them are used, so that the arcs
  // are tangent to rounding. [TB/T 449]
  const auto direction = [](Point2 from, Point2 to) { return unit(to - from); };
  const Point2 c450_stated = {15.500, 449.733}, c90_stated = {-5.500, 90.347}, c14_stated = {-24.869, 16.856},
               c15_stated = {-53.615, 13.025}, c12_stated = {-54.000, 16.000}, c25_stated = {-45.000, 6.619};
  const Point2 c450 = {15.5 * mm, std::sqrt(450.0 * 450 - 15.5 * 15.5) * mm};
  const Point2 u90 = direction(c450_stated, c90_stated), c90 = c450 + 360 * mm * u90;
  const Point2 u14 = direction(c90_stated, c14_stated), c14 = c90 + 76 * mm * u14;
  const Point2 u15 = direction(c14_stated, c15_stated), c15 = c14 + 29 * mm * u15;
  const Point2 u12 = direction(c15_stated, c12_stated), c12 = c15 + 3 * mm * u12;
  const Point2 u25 = direction(c25_stated, c12_stated), c25 = c12 - 13 * mm * u25;

  PlaneCurve curve(c25 + Point2{-25 * mm, 0});
  curve.arc_to(c25 + 25 * mm * u25, c25)
      .arc_to(c15 + 15 * mm * u12, c12)
      .arc_to(c14 + 14 * mm * u15, c15)
      .arc_to(c90 + 90 * mm * u14, c14)
      .arc_to(c450 + 450 * mm * u90, c90);
  const Point2 cone = c450 + 450 * mm * unit({-1, -40});
  const Point2 break_point = cone + (30 * mm - cone.x) * Point2{1, -1.0 / 40};
  const Point2 edge = break_point + 35 * mm * Point2{1, -1.0 / 15};
  curve.arc_to(cone, c450).line_to(break_point).line_to(edge);
  return {curve};
}

WheelProfile wheel_from_table(std::span<const double> y, std::span<const double> z) {
  const PlaneCurve raw = curve_through(y, z, "wheel profile");
  if (!(y.front() < 0 && y.back() > 0))
    throw InputError(
        fmt::format("wheel profile: the table spans y = {:.1f} ... {:.1f} mm and misses the nominal rolling "
                    "circle y = 0; "
                    "state the wheel.profile_shift that brings it there",
                    y.front() / mm, y.back() / mm));
  const double nominal = raw.at(raw.at_x(0)).position.y;
  std::vector<double> shifted(z.begin(), z.end());
  for (double& value : shifted) value -= nominal;
  return {curve_through(y, shifted, "wheel profile")};
}

WheelProfile crowned(double width, double crown_radius) {
  const double half = width / 2;
  if (!(width > 0) || crown_radius < 0 || (crown_radius > 0 && crown_radius <= half))
    throw InputError(
        fmt::format("profile of width {} m with crown radius {} m: the radius must exceed half the width, or "
                    "be 0 for a straight "
                    "profile",
                    width, crown_radius));
  if (crown_radius == 0) {
    PlaneCurve straight({-half, 0});
    return {straight.line_to({half, 0})};
  }
  const double drop = half * half / (crown_radius + std::sqrt(crown_radius * crown_radius - half * half));
  PlaneCurve arc({-half, -drop});
  return {arc.arc_to({half, -drop}, {0, -crown_radius})};
}

}  // namespace tread
