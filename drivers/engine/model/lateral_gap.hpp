#pragma once
// The gap across the rail between the undeformed surfaces of wheel and rail.

#include "kernels/contact/contact_surface.hpp"

namespace tread {

struct LateralGap {
  double lowest = 0;  ///< y where the profiles touch first [m]
  double radius = 0;  ///< of the gap about it: the parabola that fits best within 5 mm [m]
  double facing = 0;  ///< width over which they face each other [m]
  double width = 0;   ///< the same of a line contact: both are parallel all over it [m]; otherwise 0
};

LateralGap lateral_gap(const SurfaceProfile& rail, const SurfaceProfile& wheel);

}  // namespace tread
