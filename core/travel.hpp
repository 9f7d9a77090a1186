#pragma once
// Where a wheel under traction gets to, known before anything is built: the mesh must be there.

#include "core/scene.hpp"

namespace tread {

/// What traction drives. A guided wheel keeps its speed.
struct DrivenWheel {
  double load = 0;      ///< static wheel load [N]
  double mass = 1;      ///< that the longitudinal contact force accelerates [kg]
  double radius = 1;    ///< [m]
  double friction = 0;  ///< coefficient of friction, beyond which no torque drives [-]
  bool guided = false;  ///< at constant speed

  /// Under the full torque, negative where it brakes [m/s^2].
  double acceleration(const MotionSpec& motion) const;
};

/// Static force on the wheel's journal or bore [N]: the vehicle's weight, or [load].
double carried_load(const Scene& scene);

/// Of a scene with [wheel]. The mass of a ring is that of a rectangle revolved, its arc not cut.
DrivenWheel driven_wheel(const Scene& scene);

/// Farthest places of the wheel's centre in x, counted from its first.
struct Travel {
  double first = 0;  ///< not positive; negative where brakes turn the wheel back [m]
  double last = 0;   ///< not negative [m]
};

/// Over motion.duration, its traction as the ramp and the reversals have it; none without [wheel] or
/// [motion].
Travel travel_of(const Scene& scene);

}  // namespace tread
