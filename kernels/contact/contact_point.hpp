#pragma once
// One integration point of the contact between a rail's surface and a wheel's.

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/inline.hpp"
#include "core/math/vec.hpp"
#include "kernels/contact/friction/elastic_stick.hpp"

namespace tread {

/// Nodes that carry a point of a surface: 4 stations x 4 nodes across.
inline constexpr std::size_t kSupport = 16;

/// State of an integration point between steps.
struct PointHistory {
  Traction shear;       ///< [Pa]
  double pressure = 0;  ///< [Pa]
};

/// Nodes that carry a point of a surface.
struct SurfaceSupport {
  std::array<std::int64_t, kSupport> slot;  ///< station by station
  std::array<double, 4> along;              ///< weights of the stations
  std::array<double, 4> across;             ///< weights of a station's nodes

  TREAD_BODY double weight(std::size_t k) const { return along[k / 4] * across[k % 4]; }
};

/// Place, bases, history and tractions of a point in a step.
struct ContactPoint {
  SurfaceSupport rail;                             ///< nodes about the point
  SurfaceSupport wheel;                            ///< nodes about the opposite point of the wheel
  std::array<double, 4> wheel_angle;               ///< space angle of the four wheel stations [rad]
  std::array<double, 4> wheel_cosine, wheel_sine;  ///< of these angles
  std::array<double, 4> face_share;  ///< shares of the rail face's corners in the point (for nodal averages)
  std::array<int, 2> face;           ///< rail station and surface edge
  Vec3 normal;                       ///< out of the wheel, into the rail; Cartesian
  Vec3 along, across;                ///< tangents: along the rolling direction; across, to the field side
  Vec3 position;                     ///< on the rail surface [m]
  std::int64_t history;              ///< number of the point among all of the rail
  double area;                       ///< the point's share of the surface [m2]
  double gap;                        ///< at the start of the step, < 0: penetration [m]
  Vec3 velocity_before;              ///< of the wheel against the rail, mean of the step before [m/s]
  Traction shear_before;             ///< in the middle of the step before [Pa]
  double pressure_before;            ///< in the middle of the step before [Pa]
  double pressure;                   ///< in the middle of the step [Pa]
  Traction shear;                    ///< on the rail, in the middle of the step [Pa]
  double closing_speed;              ///< of the surfaces at the start of the step [m/s]
  Traction slip_speed;               ///< of the wheel against the rail at the start of the step [m/s]
  bool slips;
  double frictional_work;  ///< of the step per area [J/m2]

  /// Traction on the rail [Pa].
  TREAD_BODY Vec3 traction() const { return pressure * normal + shear.along * along + shear.across * across; }

  /// Power of the shear stress at the start of the step on the slip speed at that time, elastic slip included
  /// [W/m2].
  TREAD_BODY double frictional_power() const {
    return 0.5 * ((shear_before.along + shear.along) * slip_speed.along +
                  (shear_before.across + shear.across) * slip_speed.across);
  }
};

/// Local (t, y, r) components at the space angle with this cosine and sine, and back.
TREAD_BODY Vec3 localise(double c, double s, const Vec3& v) {
  return {-c * v.x + s * v.z, v.y, -s * v.x - c * v.z};
}
TREAD_BODY Vec3 globalise(double c, double s, const Vec3& v) {
  return {-c * v.x - s * v.z, v.y, s * v.x - c * v.z};
}

}  // namespace tread
