#pragma once
// The place where rigid profiles of wheel and rail touch.

#include "core/geometry/plane_curve.hpp"

namespace tread {

/// First contact of a wheel that is lowered on a rail without yaw and roll.
struct Touching {
  Point2 on_rail;      ///< the place in the rail's own axes [m]
  double y = 0;        ///< the place across the track, from the rail's middle [m]
  double wheel_y = 0;  ///< the place in wheel coordinates [m]
  double slope = 0;    ///< dz/dy of the rail there, in the track's axes [-]
};

/// Rail axes: z up; wheel axes: z towards the flange tip. The rail is turned by `inclination` about its
/// origin towards -y; `lateral_offset` is the rail's origin in wheel coordinates [m]. Throws InputError if
/// the wheel does not stand over the rail.
Touching touching(const PlaneCurve& rail, double inclination, const PlaneCurve& wheel, double lateral_offset);

}  // namespace tread
