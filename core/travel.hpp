#pragma once
// Reach of a wheel under traction, known before the model is built: the mesh must cover it.

#include <optional>

#include "core/scene.hpp"

namespace tread {

/// Least distance of the wheel's centre from the rail's ends [m].
inline constexpr double kRailEndMargin = 0.02;

/// Share of a turn that a part of a tyre has at the most.
inline constexpr double kLargestPart = 0.75;

/// The mass that traction drives. A guided wheel keeps its speed.
struct DrivenWheel {
  double load = 0;      ///< static wheel load [N]
  double mass = 1;      ///< mass that the longitudinal contact force accelerates [kg]
  double radius = 1;    ///< [m]
  double friction = 0;  ///< largest coefficient of friction, beyond which no torque drives [-]
  bool guided = false;  ///< at constant speed

  /// Acceleration under the full torque [m/s^2], negative under braking.
  double acceleration(const MotionSpec& motion) const;
};

/// Static force on the wheel's journal or bore [N]: the vehicle's weight, or [load].
double carried_load(const Scene& scene);

/// Driven wheel of a scene with [wheel]. The mass of a ring is that of a revolved rectangle; the curvature of
/// its crown is ignored.
DrivenWheel driven_wheel(const Scene& scene);

/// Farthest places of the wheel's centre.
struct Travel {
  double first = 0;  ///< rearmost x: the start's, or less if brakes turn the wheel back [m]
  double last = 0;   ///< foremost x [m]
};

/// Travel over motion.duration, with the traction's ramp and reversals; of a wheel at x = 0 without [motion].
Travel travel_of(const Scene& scene);

/// motion.duration with which the wheel of a scene with [motion] rolls to x [m], to four digits [s]; nullopt
/// if brakes stop it before.
std::optional<double> duration_to(const Scene& scene, double x);

}  // namespace tread
