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
  double load = 0;            ///< static wheel load [N]
  double mass = 1;            ///< mass that the longitudinal contact force accelerates [kg]
  double radius = 1;          ///< [m]
  double friction = 0;        ///< largest coefficient of friction, beyond which no torque drives [-]
  bool guided = false;        ///< at constant speed
  double own_mass = 1;        ///< part of `mass` that spins too: the wheel's [kg]
  double least_friction = 0;  ///< all that friction may give where the wheel slides [-]

  /// Largest acceleration by friction [m/s^2].
  double grip() const { return guided ? 0 : friction * load / mass; }
  /// Acceleration under the full torque [m/s^2], negative under braking: the largest in size that it may be.
  double acceleration(const MotionSpec& motion) const;
  /// The least in size. A torque spins the wheel up, too; its inertia is own_mass * radius^2 at the most.
  /// [theory.md, Connectors]
  double least_acceleration(const MotionSpec& motion) const;
  /// Largest change of speed by the slip of the start, MotionSpec::creepage, until friction has ended it
  /// [m/s]; negative where the wheel brakes. The wheel's inertia is own_mass * radius^2 at the most.
  double speed_of_slip(const MotionSpec& motion) const;
};

/// Static force on the wheel's journal or bore [N]: the vehicle's weight, or [load].
double carried_load(const Scene& scene);

/// Driven wheel of a scene with [wheel]. The mass of a ring is that of a revolved rectangle; the curvature of
/// its crown is ignored.
DrivenWheel driven_wheel(const Scene& scene);

/// Bounds of the places of the wheel's centre.
struct Travel {
  double first = 0;  ///< rearmost x: the start's, or less if brakes turn the wheel back [m]
  double last = 0;   ///< foremost x [m]
  double sure =
      0;  ///< foremost x that the wheel surely comes to: brakes at their most, a drive at its least [m]
};

/// Travel over motion.duration, with the traction's ramp and reversals and the creepage of the start; of a
/// wheel at x = 0 without [motion].
Travel travel_of(const Scene& scene);

/// Least motion.duration with which the wheel of a scene with [motion] surely rolls to x [m], to three digits
/// [s]; nullopt if it may stop or turn back before.
std::optional<double> duration_to(const Scene& scene, double x);

}  // namespace tread
