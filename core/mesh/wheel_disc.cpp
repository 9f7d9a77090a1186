#include "core/mesh/wheel_disc.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace tread {

namespace {

constexpr double kRimDepth = 65e-3;  // depth of the inner rim radius below the nominal rolling circle [m]
constexpr double kRimSlant = 5e-3;   // reduction of the rim's thickness at its faces [m]
constexpr double kFlare = 8e-3;      // widening of the web at rim and hub, each side [m]
constexpr double kFlareLength = 25e-3;
constexpr double kBrakeOuterDepth = 110e-3;  // depth of the brake ring below the nominal rolling circle [m]
constexpr double kBrakeInnerRadius = 175e-3;
constexpr double kBrakeGap = 10e-3;  // gap between web and brake ring, bridged at the bolt circle [m]
constexpr double kHubOuterRadius = 145e-3;
constexpr double kMostHub = 250e-3, kLeastHeight = 60e-3;  // of a web from a file [m]

/// InputError for an outline that does not fit between hub and rim.
void check_outline(const WheelShape& shape, const Web& web, double rim_width) {
  constexpr double kRoom = 8e-3;  // beside and beyond the web's ends [m]
  const auto refuse = [](double value, double least, double most, const char* what) {
    if (!(value >= least && value <= most))
      throw InputError(fmt::format("wheel.web: {} {:.1f} mm; it has to be from {:.1f} to {:.1f} mm", what,
                                   1e3 * value, 1e3 * least, 1e3 * most));
  };
  refuse(web.hub(), kHubTieRadius + kRoom, kMostHub, "the web begins at the hub's radius of");
  refuse(web.rim(), web.hub() + kLeastHeight, shape.diameter / 2 - kTreadTieDepth - kRoom,
         "the web ends at the rim's radius of");
  refuse(shape.thinnest_web(), kThinnestWeb, kThickestWeb, "the web's least thickness is");
  const auto within = [&](const Web::Faces& faces, double half, const char* what) {
    refuse(std::abs(faces.middle) + faces.half, 0, half - kRoom, what);
  };
  within(web.at(web.hub()), kHubLength / 2, "a face ends at the hub, from the middle of the rim,");
  within(web.at(web.rim()), rim_width / 2, "a face ends at the rim, from its middle,");
}

/// Left wing, web and right wing over |x| <= half.
std::vector<double> winged(double half, const Web::Faces& web, int columns, double size) {
  const double left = web.middle - web.half, right = web.middle + web.half;
  auto line = evenly(-half, left, element_count(left + half, size, 1));
  append(line, evenly(left, right, columns));
  append(line, evenly(right, half, element_count(half - right, size, 1)));
  return line;
}

/// Radii of the web's rows, and the rows at which brake ring and bolt circle begin and end.
struct WebRows {
  std::vector<double> r;
  int ring_first = 0, ring_last = 0, bolts_first = 0, bolts_last = 0;
};

WebRows web_rows(const WheelShape& shape, const Web& web, const SectionSize& size) {
  const double outer = shape.diameter / 2 - kBrakeOuterDepth, inner = kBrakeInnerRadius;
  const double height = outer - inner;
  std::vector<double> breaks = {web.hub(), web.rim()};
  if (shape.brake_ring_thickness > 0)
    breaks = {breaks[0], inner, inner + height / 3, outer - height / 3, outer, breaks[1]};
  WebRows rows;
  rows.r = graded(breaks, [&](double) { return size.coarse; });
  const auto row = [&](std::size_t k) {
    return static_cast<int>(std::find(rows.r.begin(), rows.r.end(), breaks[k]) - rows.r.begin());
  };
  if (shape.brake_ring_thickness > 0) {
    rows.ring_first = row(1);
    rows.bolts_first = row(2);
    rows.bolts_last = row(3);
    rows.ring_last = row(4);
  }
  return rows;
}

/// Rectangular patch from x0 to x1 with the rows r[first] ... r[last].
Patch ring_plate(double x0, double x1, int columns, std::span<const double> r, int first, int last) {
  const auto x = evenly(x0, x1, columns);
  Patch patch(columns, last - first);
  for (int row = first; row <= last; ++row)
    for (int i = 0; i <= columns; ++i)
      patch.at(i, row - first) = {x[static_cast<std::size_t>(i)], r[static_cast<std::size_t>(row)]};
  return patch;
}

/// Two ring plates that stand off the web and are joined to it over the middle third of their height.
void add_brake_rings(SectionBuilder& builder, const WebRows& rows, const WheelShape& shape, double coarse) {
  const double face = shape.web_thickness / 2, inside = face + kBrakeGap,
               outside = inside + shape.brake_ring_thickness;
  const int columns = element_count(shape.brake_ring_thickness, 1.5 * coarse, 1);
  builder.add(ring_plate(face, inside, 1, rows.r, rows.bolts_first, rows.bolts_last));
  builder.add(ring_plate(-inside, -face, 1, rows.r, rows.bolts_first, rows.bolts_last));
  builder.add(ring_plate(inside, outside, columns, rows.r, rows.ring_first, rows.ring_last));
  builder.add(ring_plate(-outside, -inside, columns, rows.r, rows.ring_first, rows.ring_last));
}

}  // namespace

Web::Web(const WheelShape& shape, double middle)
    : shape_(&shape),
      middle_(middle),
      hub_(shape.web_outline ? shape.web_outline->hub() : kHubOuterRadius),
      rim_(shape.web_outline ? shape.web_outline->rim() : shape.diameter / 2 - kRimDepth) {}

Web::Faces Web::at(double r) const {
  if (shape_->web_outline) {
    const auto [gauge, field] = shape_->web_outline->at(r);
    return {0.5 * (gauge + field) - middle_, 0.5 * (field - gauge)};
  }
  const double reach = std::max(0.0, 1 - std::min(r - hub_, rim_ - r) / kFlareLength);
  const WebLine line = shape_->web_line((r - hub_) / (rim_ - hub_));
  const double lean = std::hypot(1, line.slope / (rim_ - hub_));
  return {line.p, lean * shape_->web_thickness / 2 + kFlare * reach * reach};
}

DiscLines disc_lines(double rim_width, const WheelShape& shape, const Web& web, const SectionSize& size) {
  if (shape.web_outline) check_outline(shape, web, rim_width);
  DiscLines lines;
  lines.web = element_count(shape.thinnest_web(), size.coarse, 2);
  lines.rim = winged(rim_width / 2, web.at(web.rim()), lines.web, size.coarse);
  lines.axle_hub =
      evenly(-kHubLength / 2, kHubLength / 2, element_count(kHubLength, kAxleRatio * size.coarse, 3));
  lines.hub = winged(kHubLength / 2, web.at(web.hub()), lines.web, size.coarse);
  return lines;
}

Section make_disc(const DiscLines& lines, const WheelShape& shape, const Web& web, const SectionSize& size) {
  const double tie = shape.diameter / 2 - kTreadTieDepth;

  PatchSides rim_sides;
  rim_sides.top = at_height(lines.rim, tie);
  const Web::Faces top = web.at(web.rim());
  for (const double x : lines.rim) {
    const double beside = std::abs(x - top.middle) - top.half;
    const double wing =
        (x > top.middle ? lines.rim.back() - top.middle : top.middle - lines.rim.front()) - top.half;
    rim_sides.bottom.push_back({x, web.rim() + kRimSlant * std::max(0.0, beside / wing)});
  }
  const int rim_count = element_count(tie - web.rim(), size.coarse, 2);
  rim_sides.left = straight(rim_sides.bottom.front(), rim_sides.top.front(), rim_count);
  rim_sides.right = straight(rim_sides.bottom.back(), rim_sides.top.back(), rim_count);

  const WebRows rows = web_rows(shape, web, size);
  PatchSides plate;
  for (const double r : rows.r) {
    const Web::Faces faces = web.at(r);
    plate.left.push_back({faces.middle - faces.half, r});
    plate.right.push_back({faces.middle + faces.half, r});
  }
  plate.bottom = straight(plate.left.front(), plate.right.front(), lines.web);
  plate.top = straight(plate.left.back(), plate.right.back(), lines.web);

  PatchSides hub;
  hub.bottom = at_height(nested(lines.hub, lines.axle_hub, "wheel hub"), kHubTieRadius);
  hub.top = at_height(lines.hub, web.hub());
  const int hub_count = element_count(web.hub() - kHubTieRadius, size.coarse, 1);
  hub.left = straight(hub.bottom.front(), hub.top.front(), hub_count);
  hub.right = straight(hub.bottom.back(), hub.top.back(), hub_count);

  SectionBuilder builder;
  for (const PatchSides* sides : {&rim_sides, &plate, &hub}) builder.add(fill(*sides));
  if (shape.brake_ring_thickness > 0) add_brake_rings(builder, rows, shape, size.coarse);
  builder.path("tie_outer", rim_sides.top);
  builder.path("tie_inner", hub.bottom);
  return builder.take();
}

}  // namespace tread
