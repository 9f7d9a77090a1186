#include "core/mesh/rail_section.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"

namespace tread {

namespace {

constexpr double kRailTieDepth = 24e-3;  // [m]
constexpr double kLargestColumn = 4e-3;  // largest column on the cap's surface: resolves the R13 corners [m]

std::vector<Point2> mirrored(std::vector<Point2> points) {
  for (Point2& point : points) point.x = -point.x;
  std::reverse(points.begin(), points.end());
  return points;
}

PatchSides mirrored(const PatchSides& sides) {
  const auto flip = [](std::vector<Point2> points) {
    for (Point2& point : points) point.x = -point.x;
    return points;
  };
  return {mirrored(sides.bottom), mirrored(sides.top), flip(sides.right), flip(sides.left)};
}

/// A strip symmetric about x = 0 between two rows of points and the right outline with its mirror image.
PatchSides strip(std::vector<Point2> bottom, std::vector<Point2> top, std::vector<Point2> right) {
  PatchSides sides = {std::move(bottom), std::move(top), {}, std::move(right)};
  for (Point2 point : sides.right) sides.left.push_back({-point.x, point.y});
  return sides;
}

/// Node at the convex rounding with the middle `s`. The node lies on the bisector between arc and sharp
/// corner, such that edges of a few radii keep the area. Fitted to the three corners of CN60: 0.59, 0.60 and
/// 0.80 of the distance.
Point2 corner_node(const PlaneCurve& lower, double s) {
  const auto before = lower.joints(0, s), after = lower.joints(s, lower.length());
  const CurvePoint a = lower.at(before.back()), b = lower.at(after.front());
  const double reach = cross(b.position - a.position, b.tangent) / cross(a.tangent, b.tangent);
  const Point2 sharp = a.position + reach * a.tangent, middle = lower.at(s).position;
  return middle + 0.6 * (sharp - middle);
}

/// Half the tie: x of the coarse nodes and the number of elements in the middle strip and in each wing.
struct CoarseTie {
  std::vector<double> x;  // all nodes, left to right [m]
  double end = 0;         // end on the side face [m]
  double strip = 0;       // half width of the middle strip [m]
  double s_end = 0;       // parameter of the end on `lower`
  int middle = 0, wing = 0;
};

CoarseTie coarse_tie(const RailProfile& rail, const SectionSize& size) {
  CoarseTie tie;
  tie.s_end = rail.lower.first(0, rail.rounding[0],
                               [](const CurvePoint& point) { return -kRailTieDepth - point.position.y; });
  tie.end = rail.lower.at(tie.s_end).position.x;
  tie.middle = element_count(rail.web_width, size.coarse, 2);
  tie.strip = 0.95 * rail.lower.at(rail.rounding[1]).position.x;
  tie.wing = element_count(tie.end - tie.strip, size.coarse, 1);
  tie.x = evenly(-tie.end, -tie.strip, tie.wing);
  const auto middle = evenly(-tie.strip, tie.strip, tie.middle), right = evenly(tie.strip, tie.end, tie.wing);
  tie.x.insert(tie.x.end(), middle.begin() + 1, middle.end());
  tie.x.insert(tie.x.end(), right.begin() + 1, right.end());
  return tie;
}

PatchSides head_wing(const RailProfile& rail, const CoarseTie& tie, const std::vector<Point2>& strip_side) {
  const double s_head = rail.rounding[0];
  const Point2 tie_end = {tie.end, -kRailTieDepth};
  PatchSides sides;
  sides.left = strip_side;
  sides.right = positions(rail.lower, s_head, tie.s_end, static_cast<int>(strip_side.size()) - 1);
  sides.bottom = positions(rail.lower, rail.rounding[1], s_head, tie.wing);
  sides.top = straight(strip_side.back(), tie_end, tie.wing);
  sides.right.front() = sides.bottom.back() = corner_node(rail.lower, s_head);
  sides.right.back() = tie_end;
  return sides;
}

PatchSides foot_wing(const RailProfile& rail, const std::vector<Point2>& strip_side, int columns) {
  const Point2 top = corner_node(rail.lower, rail.rounding[3]);
  const Point2 bottom = {corner_node(rail.lower, rail.rounding[4]).x, -rail.height};
  PatchSides sides;
  sides.left = strip_side;
  sides.right = straight(bottom, top, static_cast<int>(strip_side.size()) - 1);
  sides.bottom = straight(strip_side.front(), bottom, columns);
  sides.top = positions(rail.lower, rail.rounding[2], rail.rounding[3], columns);
  sides.top.back() = top;
  return sides;
}

Section make_base(const RailProfile& rail, const CoarseTie& tie, const SectionSize& size) {
  const double s_web_top = rail.rounding[1], s_web_bottom = rail.rounding[2];
  const Point2 web_top = rail.lower.at(s_web_top).position, web_bottom = rail.lower.at(s_web_bottom).position;
  const Point2 tie_strip = {tie.strip, -kRailTieDepth}, foot_strip = {0.9 * web_bottom.x, -rail.height};
  const int head_rows = std::max(1, static_cast<int>((tie_strip.y - web_top.y) / size.coarse));
  const int web_rows = element_count(web_top.y - web_bottom.y, size.coarse, 4);
  const int foot_rows = element_count(web_bottom.y + rail.height, 1.5 * size.coarse, 2);
  const int foot_columns = element_count(rail.rounding[3] - s_web_bottom, size.coarse, 3);
  const auto across = [&](Point2 right) { return straight({-right.x, right.y}, right, tie.middle); };

  const auto head_side = straight(web_top, tie_strip, head_rows);
  const auto foot_side = straight(foot_strip, web_bottom, foot_rows);
  const PatchSides head = head_wing(rail, tie, head_side), foot = foot_wing(rail, foot_side, foot_columns);

  SectionBuilder builder;
  builder.add(fill(strip(across(web_top), across(tie_strip), head_side)));
  builder.add(fill(head));
  builder.add(fill(mirrored(head)));
  builder.add(fill(
      strip(across(web_bottom), across(web_top), positions(rail.lower, s_web_bottom, s_web_top, web_rows))));
  builder.add(fill(strip(across(foot_strip), across(web_bottom), foot_side)));
  builder.add(fill(foot));
  builder.add(fill(mirrored(foot)));

  builder.path("tie", at_height(tie.x, -kRailTieDepth));
  std::vector<Point2> line = mirrored(foot.bottom);
  const auto middle = across(foot_strip);
  line.insert(line.end(), middle.begin() + 1, middle.end());
  line.insert(line.end(), foot.bottom.begin() + 1, foot.bottom.end());
  builder.path("foot", line);
  return builder.take();
}

struct CapEdges {
  double left, right;          // parameters of the logical corners, where the surface leans by 45 degrees
  double left_tie, right_tie;  // parameters where the side faces meet the tie
};

CapEdges cap_edges(const PlaneCurve& running) {
  const double middle = running.at_x(0), sine = std::sqrt(0.5);
  const auto below = [](const CurvePoint& point) { return -kRailTieDepth - point.position.y; };
  const auto rising = [&](const CurvePoint& point) { return point.tangent.y - sine; };
  const auto falling = [&](const CurvePoint& point) { return -point.tangent.y - sine; };
  return {running.first(middle, 0, rising), running.first(middle, running.length(), falling),
          running.first(middle, 0, below), running.first(middle, running.length(), below)};
}

/// Values along a line, with one more among the first `count` intervals. The ends of these intervals stay.
std::vector<double> with_one_more(std::span<const double> values, int count) {
  std::vector<double> result;
  for (int i = 0; i <= count; ++i) {
    const double at = static_cast<double>(i) * count / (count + 1);
    const auto k = static_cast<std::size_t>(at);
    result.push_back(values[k] + (at - static_cast<double>(k)) * (values[k + 1] - values[k]));
  }
  result.insert(result.end(), values.begin() + count, values.end());
  return result;
}

/// Wanted abscissae on the tie below the running surface's nodes `top` and the two columns that end in the
/// collapsed corners.
std::vector<double> below(std::span<const Point2> top, double tie_end) {
  std::vector<double> x;
  for (const Point2& point : top) x.push_back(point.x);
  const int outer = std::min(4, static_cast<int>(top.size() - 1) / 2);
  for (int side = 0; side < 2; ++side) {
    x = with_one_more(x, outer);
    std::reverse(x.begin(), x.end());
  }
  for (double& value : x) {
    const double reach = value < 0 ? -top.front().x : top.back().x;
    value += (tie_end - reach) * std::pow(value / reach, 3);
  }
  return x;
}

/// Head cap. Its upper corners are collapsed, because the outline is smooth there.
Section make_cap(const RailProfile& rail, const CoarseTie& tie, const SectionSize& size) {
  const PlaneCurve& running = rail.running;
  const CapEdges edges = cap_edges(running);
  const auto s = graded(breaks_on(running, edges.left, edges.right),
                        [&](double at) { return size.column(running.at(at).position.x, kLargestColumn); });
  const auto layers = from_below(layer_depths(size, kRailTieDepth));
  const int side_edges = static_cast<int>(layers.size()) - 2;

  PatchSides sides;
  sides.top = positions(running, s);
  sides.left = positions(running, edges.left_tie, edges.left, side_edges);
  sides.right = positions(running, edges.right_tie, edges.right, side_edges);
  sides.bottom = at_height(nested(below(sides.top, tie.end), tie.x, "rail head"), -kRailTieDepth);
  collapse_upper_corners(sides);
  std::vector<double> weight;
  for (const Point2& point : sides.top)
    weight.push_back(size.layer_weight(point.x, sides.top.front().x, sides.top.back().x));

  SectionBuilder builder;
  builder.add(fill_layered(sides, layers, weight));
  builder.surface(running, s);
  builder.path("tie", sides.bottom);
  return builder.take();
}

}  // namespace

RailSections make_rail_sections(const RailProfile& profile, double inclination, const SectionSize& wanted) {
  check(wanted, kRailTieDepth, "rail");
  SectionSize size = wanted;
  size.coarse = std::max(size.coarse, kCoarseRatio * size.surface);
  if (!(std::abs(inclination) <= 0.2))
    throw InputError(fmt::format("rail inclination {} is outside -0.2 ... 0.2 (1:40 is 0.025)", inclination));
  const CoarseTie tie = coarse_tie(profile, size);
  RailSections sections = {make_cap(profile, tie, size), make_base(profile, tie, size)};
  for (Section* section : {&sections.cap, &sections.base}) rotate(*section, std::atan(inclination));
  validate(sections.cap, "rail head");
  validate(sections.base, "rail base");
  return sections;
}

Section make_box_rail_section(double width, double height, double crown_radius, const SectionSize& size) {
  Section section = block_under(crowned(width, crown_radius).surface, -height, size, "foot", "rail.height");
  validate(section, "box rail");
  return section;
}

}  // namespace tread
