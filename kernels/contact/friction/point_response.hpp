#pragma once
// Traction of a point of the patch under the motion of a step. [theory.md, eqs. 9b and 10]

#include "core/inline.hpp"
#include "kernels/contact/friction/elastic_stick.hpp"

namespace tread {

/// Springs of a point: the normal penalty and the elastic stick.
struct PointSprings {
  double penalty;  ///< normal stiffness per area [Pa/m]
  ElasticStick stick;

  /// Energy stored per area [J/m2].
  constexpr double stored(double pressure, const Traction& shear) const {
    return 0.5 * pressure * pressure / penalty + stick.stored(shear);
  }
};

/// Pressure and shear stress of a point, or of a lane each. [Pa]
template <class V>
struct PointTraction {
  V pressure;
  TractionOf<V> shear;
};

/// Velocity of the wheel against the rail in a point's frame: closing, slip. [m/s]
template <class V>
struct PointVelocity {
  V closing;
  TractionOf<V> slip;
};

/// Constants of a point in a step.
template <class V>
struct PointStep {
  V gap;                       ///< at the start of the step, < 0: penetration [m]
  TractionOf<V> slip_before;   ///< slip speed of the step before [m/s]
  TractionOf<V> shear_before;  ///< in the middle of the step before [Pa]
  V friction;                  ///< coefficient f of the step [-]
  V compliance;                ///< with which the traction is taken to yield [m/Pa]
};

/// Traction in the middle of a step of length dt [s]. `velocity` is the motion of the step under the traction
/// `held`; a change of the traction parts the surfaces by the compliance times itself.
template <class V>
TREAD_INLINE PointTraction<V> respond(const PointStep<V>& point, const PointSprings& springs, double dt,
                                      const PointVelocity<V>& velocity, const PointTraction<V>& held) {
  const V& a = point.compliance;
  // Gap in the middle of the step, and slip between both middles, if the traction were zero.
  const V gap = point.gap - 0.5 * dt * velocity.closing - a * held.pressure;
  const TractionOf<V> slip{
      0.5 * dt * (point.slip_before.along + velocity.slip.along) + a * held.shear.along,
      0.5 * dt * (point.slip_before.across + velocity.slip.across) + a * held.shear.across};
  const V free = -springs.penalty * gap / (1 + springs.penalty * a);
  const V open{};
  const V pressure = free > open ? free : open;
  return {pressure, springs.stick.traction<V>(point.shear_before, slip, point.friction * pressure, a)};
}

}  // namespace tread
