#pragma once
// Turns about +y by an angle whose cosine and sine are at hand. [core/body_frame.hpp]

#include <cmath>

#include "core/math/vec.hpp"

namespace tread {

/// Turn by an angle about +y: between the bases (t, y, r) of two angles, or to Cartesian axes.
struct Turn {
  double cosine = 1, sine = 0;

  Turn() = default;
  TREAD_BODY explicit Turn(double angle) : cosine(std::cos(angle)), sine(std::sin(angle)) {}
  /// Returns turn(a, angle).
  TREAD_BODY Vec3 of(const Vec3& a) const {
    return {cosine * a.x + sine * a.z, a.y, -sine * a.x + cosine * a.z};
  }
  /// Returns cylindrical_to_cartesian(angle, a); to_cylindrical() is its inverse.
  TREAD_BODY Vec3 to_cartesian(const Vec3& a) const {
    return {-cosine * a.x - sine * a.z, a.y, sine * a.x - cosine * a.z};
  }
  TREAD_BODY Vec3 to_cylindrical(const Vec3& a) const {
    return {-cosine * a.x + sine * a.z, a.y, -sine * a.x - cosine * a.z};
  }
};

}  // namespace tread
