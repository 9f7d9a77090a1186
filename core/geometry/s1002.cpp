// The wheel profile S1002 from the equations of its zones.

#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "core/geometry/profiles.hpp"
#include "core/millimetre.hpp"

namespace tread {

namespace {

/// Value and slope of a polynomial, coefficients by rising power [mm].
struct Polynomial {
  std::span<const double> coefficients;

  double value(double y) const {
    double sum = 0;
    for (std::size_t i = coefficients.size(); i-- > 0;) sum = sum * y + coefficients[i];
    return sum;
  }
  double slope(double y) const {
    double sum = 0;
    for (std::size_t i = coefficients.size(); i-- > 1;)
      sum = sum * y + static_cast<double>(i) * coefficients[i];
    return sum;
  }
};

// Zones of the tread beside the flange's root and about the nominal rolling circle. [UIC 510-2; EN 13715]
constexpr std::array kRoot = {-4.320221063e+3, -1.038384026e+3, -1.065501873e+2, -6.051367875,
                              -2.054332446e-1, -4.169739389e-3, -4.687195829e-5, -2.252755540e-7};
constexpr std::array kTread = {0.0,
                               -3.358537058e-2,
                               1.565681624e-3,
                               -2.810427944e-5,
                               5.844240864e-8,
                               -1.562379023e-8,
                               5.309217349e-15,
                               -5.957839843e-12,
                               2.646656573e-13};
constexpr double kFieldSlope = -1.0 / 15;

/// Appends the polynomial from the curve's end to `last` [mm] as cubics of about 0.5 mm.
void follow(PlaneCurve& curve, const Polynomial& zone, double last) {
  const double first = curve.end().x / mm;
  const int count = static_cast<int>(std::ceil((last - first) / 0.5));
  double slope = zone.slope(first);
  for (int i = 1; i <= count; ++i) {
    const double y = first + (last - first) * i / count;
    const double next = zone.slope(y);
    curve.cubic_to({y * mm, zone.value(y) * mm}, slope, next);
    slope = next;
  }
}

/// Point at y on the arc about `centre`; `sign` 1: above the centre. [mm]
Point2 on_arc(Point2 centre, double radius, double sign, double y) {
  const double reach = y - centre.x;
  return {y * mm, (centre.y + sign * std::sqrt(radius * radius - reach * reach)) * mm};
}

}  // namespace

WheelProfile s1002() {
  constexpr double kTip = -62.764705882, kFace = -49.662510381, kFlank = -39.764473993,
                   kFlankEnd = -38.426669071, kRootEnd = -35, kTreadStart = -26, kTreadEnd = 32.15796,
                   kEdge = 60;
  const Point2 back = {-49.5, 9.519259302}, tip = {-55, 16}, face = {-58.558326413, 8.834924130},
               root = {-26.210665, 16.446};
  PlaneCurve curve(mm * Point2{-70, back.y});
  curve.arc_to(on_arc(back, 20.5, 1, kTip), mm * back)
      .arc_to(on_arc(tip, 12, 1, kFace), mm * tip)
      .arc_to(on_arc(face, 20, 1, kFlank), mm * face)
      .line_to(on_arc(root, 13, -1, kFlankEnd))
      .arc_to(on_arc(root, 13, -1, kRootEnd), mm * root);
  follow(curve, {kRoot}, kTreadStart);
  follow(curve, {kTread}, kTreadEnd);
  curve.line_to(curve.end() + (kEdge - kTreadEnd) * mm * Point2{1, kFieldSlope});
  return {curve};
}

}  // namespace tread
