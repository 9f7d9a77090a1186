#pragma once
// Cross-section outlines of rails and wheels, unrotated and in their own axes.

#include <array>
#include <span>
#include <string>

#include "core/geometry/plane_curve.hpp"

namespace tread {

/// Rail axes: y across (field side of a left rail positive), z up, origin at the crown top.
struct RailProfile {
  /// Outline across the head with increasing y: up the left side face, over the running surface, down the
  /// right side face. Both ends lie at z = -kRailSideDepth, on the side faces where `lower` passes.
  PlaneCurve running;
  /// Outline of the right half below: from the upper end of the side face by head underside, web and foot to
  /// the middle of the foot's bottom. The left half mirrors it.
  PlaneCurve lower;
  /// Parameters on `lower` of the middles of its roundings: head corner, web top, web bottom, foot edge top
  /// and bottom.
  std::array<double, 5> rounding = {};
  double height = 0;     ///< crown top to foot bottom [m]
  double web_width = 0;  ///< least thickness of the web [m]
};

/// Depth of the ends of RailProfile::running below the crown [m].
inline constexpr double kRailSideDepth = 30e-3;

/// CN60 (60 kg/m, GB 2585), from its arcs. The fillets are chosen so that area and moments of inertia agree
/// with the standard.
RailProfile cn60();

/// `section` with the head's surface from a measured table (y increasing, z up) [m]; z is shifted so that the
/// surface passes through the origin. Points deeper than 18 mm are left out; straight lines join the table to
/// the side faces. Throws InputError if the table does not reach across the head; `shift`: what y contains of
/// rail.profile_shift already, for that message [m].
RailProfile rail_with_head(std::span<const double> y, std::span<const double> z, RailProfile section,
                           double shift = 0);

/// Slope of a head from 10 mm left to 10 mm right of y = `middle` [m], positive towards the track's middle;
/// 0 below 1:100 [-].
double head_lean(const PlaneCurve& head, double middle);

/// Way out for a head that leans because it was measured in the track or belongs to the other rail; "" for 0.
std::string lean_hint(double lean);

/// Wheel axes: y across (field side positive, flange negative), z towards the flange tip, origin on the
/// nominal rolling circle; the radius is D / 2 + z.
struct WheelProfile {
  PlaneCurve surface;  ///< surface with increasing y, from the flange back to the rim's field side
};

/// LMA tread for a rim 135 mm wide, -70 ... 65 mm. The chamfer beyond 65 mm is cut off.
WheelProfile lma();

/// A measured or designed wheel profile (y increasing, z towards the flange tip) [m]; z is shifted so that
/// the surface passes through the origin. Throws InputError if the table does not contain y = 0.
WheelProfile wheel_from_table(std::span<const double> y, std::span<const double> z);

/// S1002 from the flange's back to the field side, y = -70 ... 60 mm. The chamfer beyond 60 mm is cut off.
/// [UIC 510-2; EN 13715]
WheelProfile s1002();

/// Wheel profile of |y| <= width / 2 [m] with a crown of radius `crown_radius` [m] that bulges outward; 0
/// means a cylinder.
WheelProfile crowned(double width, double crown_radius);

}  // namespace tread
