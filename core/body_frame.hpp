#pragma once
// Rigid motion of a spinning body, stored apart from the motion of its nodes. [theory.md, Body frames]

#include <cmath>

#include "core/math/vec.hpp"

namespace tread {

/// A frame that moves with constant velocity and constant spin about +y between two re-anchorings. Nodes of
/// the body store their displacement u in it and their velocity w relative to it, in local (t, y, r)
/// components.
struct BodyFrame {
  Vec3 origin;       ///< a point on the spin axis [m]
  Vec3 velocity;     ///< velocity of the origin [m/s]
  double angle = 0;  ///< rotation about +y [rad]
  double spin = 0;   ///< angular velocity about +y [rad/s]

  bool operator==(const BodyFrame&) const = default;
  void advance(double dt) {
    origin += dt * velocity;
    angle += dt * spin;
  }
  /// The frame at another time, `dt` later [s].
  BodyFrame after(double dt) const {
    BodyFrame frame = *this;
    frame.advance(dt);
    return frame;
  }
};

/// Vector a turned by `angle` about +y, in components (t, y, r).
TREAD_BODY Vec3 turn(const Vec3& a, double angle) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return {c * a.x + s * a.z, a.y, -s * a.x + c * a.z};
}

/// Returns spin * y-axis x a, in components (t, y, r).
TREAD_BODY Vec3 spin_cross(double spin, const Vec3& a) {
  return {spin * a.z, 0, -spin * a.x};
}

/// Turns components (t, y, r) at space angle `phi` [rad] to Cartesian axes. `cartesian_to_cylindrical` turns
/// them back.
TREAD_BODY Vec3 cylindrical_to_cartesian(double phi, const Vec3& a) {
  const double c = std::cos(phi);
  const double s = std::sin(phi);
  return {-c * a.x - s * a.z, a.y, s * a.x - c * a.z};
}
TREAD_BODY Vec3 cartesian_to_cylindrical(double phi, const Vec3& a) {
  const double c = std::cos(phi);
  const double s = std::sin(phi);
  return {-c * a.x + s * a.z, a.y, -s * a.x - c * a.z};
}

}  // namespace tread
