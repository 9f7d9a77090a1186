#include "core/mesh/wheel_section.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.hpp"
#include "core/mesh/wheel_disc.hpp"

namespace tread {

namespace {

constexpr double kSeatRadius = 95e-3, kAxleRadius = 87.5e-3, kJournalRadius = 65e-3;
constexpr double kTrackCentre = -746.5e-3, kJournalCentre = 253.5e-3, kAxleEnd = 343.5e-3;  // y_wheel [m]

constexpr double kFlangeSize = 4.2e-3;  // size on the flange and its root [m]: two elements on half the R14
constexpr double kFlangeRatio = 1.8;    // least ratio of the flange's size to the surface size: the flange
                                        // costs no time step

/// Breaks for graded() on a curve without the joints that would leave an element shorter than about a third
/// of `size` [m] at an end.
std::vector<double> wide_breaks(const PlaneCurve& curve, double from, double to, double size) {
  const double least = std::min(0.35 * size, 3e-3);
  std::vector<double> result = {from};
  for (const double s : curve.joints(from, to))
    if (s - from > least && to - s > least) result.push_back(s);
  result.push_back(to);
  return result;
}

/// Parameters on the profile: the two upper corners of the flange's patch and its foot in the root.
struct Flange {
  bool present = false;
  double tip_back = 0, tip_front = 0, root = 0;
};

Flange find_flange(const PlaneCurve& profile) {
  constexpr double kBack = 0.12, kFront = 0.5;  // sines of the inclination at the patch's upper corners
  const double length = profile.length(), steep = std::sqrt(0.5);
  const auto falls = [&](double from, double sine) {
    return profile.first(from, length, [&](const CurvePoint& point) { return -point.tangent.y - sine; });
  };
  Flange flange;
  flange.tip_back =
      profile.first(0, length, [&](const CurvePoint& point) { return kBack - point.tangent.y; });
  const double face = falls(flange.tip_back, steep);
  flange.present = face < length;
  if (!flange.present) return flange;
  flange.tip_front = falls(flange.tip_back, kFront);
  constexpr double kSmooth = 4e-3;  // least length of the flange's tip between these slopes
  if (flange.tip_front - flange.tip_back < kSmooth)
    throw InputError(fmt::format(
        "wheel profile: the flange's tip at y = {:.1f} mm leans by 7 and by 30 degrees within {:.2g} mm: the "
        "points are rough there; state wheel.profile_smoothing, for example \"0.1 mm\"",
        1e3 * profile.at(flange.tip_back).position.x, 1e3 * (flange.tip_front - flange.tip_back)));
  flange.root =
      profile.first(face + 1e-4, length, [&](const CurvePoint& point) { return point.tangent.y + steep; });
  if (!(flange.root < length) || profile.at(flange.root).position.x > 0)
    throw InputError(
        "wheel profile: no tread found beyond the flange; y has to grow from the flange back to the field "
        "side and z "
        "towards the flange tip");
  return flange;
}

/// Wanted bottom position below a point of the tread. Columns lean outward under the flange's root.
double below(const Point2& top, const Point2& root) {
  constexpr double reach = 20e-3;
  const double lean = 0.35 * (root.y + kTreadTieDepth);
  return top.x - lean * std::clamp(1 - (top.x - root.x) / reach, 0.0, 1.0);
}

/// Tread ring in (y_wheel, z). `coarse` holds the tie nodes of the disc.
Section make_tread(const PlaneCurve& profile, std::span<const double> coarse, const SectionSize& size) {
  const Flange flange = find_flange(profile);
  const double largest = std::max(kFlangeSize, 0.55 * size.coarse);
  const auto column = [&](double s) {
    const double x = profile.at(s).position.x;
    return size.column(x, x < size.band_centre ? kFlangeSize : largest);
  };
  const auto flange_size = [&](double) { return std::max(kFlangeSize, kFlangeRatio * size.surface); };

  const auto tread = graded(wide_breaks(profile, flange.root, profile.length(), kFlangeSize), column);
  const Point2 root = profile.at(flange.root).position;
  const Point2 low_left = {profile.start().x, -kTreadTieDepth},
               low_right = {profile.end().x, -kTreadTieDepth};
  PlaneCurve outline(low_left);
  outline.line_to(profile.start()).append(profile);
  const double start = norm(profile.start() - low_left);  // start of the profile on the outline
  const double join = outline.first(0, start + flange.tip_back + 1e-9, [&](const CurvePoint& point) {
    return point.position.y - root.y + 1e-12;
  });

  const auto layers = from_below(layer_depths(size, kTreadTieDepth));
  const int rows = static_cast<int>(layers.size()) - 1;
  PatchSides ring;
  ring.left = positions(outline, 0, join, rows);
  ring.right = straight(low_right, profile.end(), rows);

  SectionBuilder builder;
  std::vector<double> surface = {flange.root};
  std::vector<double> wanted;
  if (flange.present) {
    surface = graded(wide_breaks(profile, flange.tip_back, flange.tip_front, flange_size(0)), flange_size);
    const auto front =
        graded(wide_breaks(profile, flange.tip_front, flange.root, flange_size(0)), flange_size);
    PatchSides sides;
    sides.top = positions(profile, surface);
    sides.right = positions(profile, front);
    std::reverse(sides.right.begin(), sides.right.end());
    sides.left = positions(outline, join, start + flange.tip_back, static_cast<int>(front.size()) - 1);
    collapse_upper_corners(sides);
    const int columns = static_cast<int>(sides.top.size()) - 1;
    sides.bottom = straight(ring.left.back(), root, columns);
    builder.add(fill_layered(sides, evenly(0, 1, static_cast<int>(front.size())),
                             std::vector<double>(sides.top.size(), 0.0)));
    ring.top.assign(sides.bottom.begin(), sides.bottom.end() - 1);
    wanted = evenly(low_left.x, below(root, root), columns);
    wanted.pop_back();
    append(surface, front);
  }
  for (const Point2& point : positions(profile, tread)) {
    ring.top.push_back(point);
    wanted.push_back(flange.present ? below(point, root) : point.x);
  }
  append(surface, tread);
  ring.bottom = at_height(nested(wanted, coarse, "wheel tread"), -kTreadTieDepth);
  std::vector<double> weight;
  for (const Point2& point : ring.top)
    weight.push_back(point.x < root.x ? 0 : size.layer_weight(point.x, root.x, low_right.x));
  builder.add(fill_layered(ring, layers, weight));
  builder.surface(profile, surface);
  builder.path("tie", ring.bottom);
  return builder.take();
}

/// Outer surface of the axle without the hub core, y in wheel coordinates.
std::vector<Point2> axle_outline(double hub_centre, std::span<const double> axle_hub, double size) {
  const double left = hub_centre - kHubLength / 2, right = hub_centre + kHubLength / 2;
  const Point2 before[] = {{kTrackCentre, kAxleRadius}, {left - 30e-3, kAxleRadius}, {left, kSeatRadius}};
  const Point2 behind[] = {{right, kSeatRadius},
                           {right + 20e-3, 82.5e-3},
                           {right + 60e-3, 77.5e-3},
                           {right + 78e-3, kJournalRadius},
                           {kJournalCentre, kJournalRadius},
                           {kAxleEnd, kJournalRadius}};
  std::vector<Point2> line = {before[0]};
  const auto extend = [&](std::span<const Point2> corners) {
    for (std::size_t k = 1; k < corners.size(); ++k) {
      const auto part =
          straight(corners[k - 1], corners[k], element_count(corners[k].x - corners[k - 1].x, size, 1));
      line.insert(line.end(), part.begin() + 1, part.end());
    }
  };
  extend(before);
  line.pop_back();
  for (const double x : axle_hub) line.push_back({hub_centre + x, kSeatRadius});
  extend(behind);
  return line;
}

/// Axle with the core of the hub in (y_wheel, r).
Section make_axle(const DiscLines& lines, double hub_centre, const WheelShape& shape, double size) {
  const double bore = shape.axle_bore / 2;
  const int rows = element_count(kSeatRadius - bore, size, 2);
  PatchSides body;
  body.top = axle_outline(hub_centre, lines.axle_hub, size);
  for (const Point2& point : body.top) body.bottom.push_back({point.x, bore});
  body.left = straight(body.bottom.front(), body.top.front(), rows);
  body.right = straight(body.bottom.back(), body.top.back(), rows);

  PatchSides core;
  for (const double x : lines.axle_hub) {
    core.bottom.push_back({hub_centre + x, kSeatRadius});
    core.top.push_back({hub_centre + x, kHubTieRadius});
  }
  const int core_rows = element_count(kHubTieRadius - kSeatRadius, size, 1);
  core.left = straight(core.bottom.front(), core.top.front(), core_rows);
  core.right = straight(core.bottom.back(), core.top.back(), core_rows);

  SectionBuilder builder;
  builder.add(fill(body));
  builder.add(fill(core));
  builder.path("tie", core.top);
  builder.path("symmetry_end", body.left);
  const auto centre = std::find_if(body.top.begin(), body.top.end(), [](const Point2& point) {
    return std::abs(point.x - kJournalCentre) < 1e-9;
  });
  builder.path("journal", std::span(centre - 1, centre + 2));
  return builder.take();
}

}  // namespace

WheelSections make_wheel_sections(const WheelProfile& profile, const WheelShape& shape,
                                  const SectionSize& wanted) {
  check(wanted, kTreadTieDepth, "wheel");
  shape.check();
  SectionSize size = wanted;
  size.coarse = std::max(size.coarse, kCoarseRatio * size.surface);
  size.band_centre += shape.lateral_offset;

  const double left = profile.surface.start().x, right = profile.surface.end().x;
  if (!(right - left > 0.09 && left < 0 && right > 0))
    throw InputError(
        fmt::format("wheel profile: spans y = {:.1f} ... {:.1f} mm; a half wheelset needs the whole rim, "
                    "more than 90 mm about the nominal rolling circle y = 0",
                    left * 1e3, right * 1e3));
  const double middle = 0.5 * (left + right);
  const Web web(shape, middle);
  const DiscLines lines = disc_lines(right - left, shape, web, size);
  std::vector<double> tie = lines.rim;
  for (double& x : tie) x += middle;

  WheelSections sections = {make_tread(profile.surface, tie, size), make_disc(lines, shape, web, size),
                            make_axle(lines, middle, shape, kAxleRatio * size.coarse)};
  translate(sections.tread, {-shape.lateral_offset, shape.diameter / 2});
  translate(sections.disc, {middle - shape.lateral_offset, 0});
  translate(sections.axle, {-shape.lateral_offset, 0});
  validate(sections.tread, "wheel tread");
  validate(sections.disc, "wheel disc");
  validate(sections.axle, "axle");
  return sections;
}

Section make_tyre_section(const WheelProfile& profile, double diameter, double lateral_offset,
                          double thickness, const SectionSize& wanted) {
  if (!(thickness > 0) || !(thickness < diameter / 2))
    throw InputError(
        fmt::format("tyre: thickness {} m does not fit into a wheel of {} m diameter", thickness, diameter));
  SectionSize size = wanted;
  size.band_centre += lateral_offset;
  Section section = block_under(profile.surface, -thickness, size, "bore", "wheel.thickness");
  translate(section, {-lateral_offset, diameter / 2});
  validate(section, "tyre");
  return section;
}

}  // namespace tread
