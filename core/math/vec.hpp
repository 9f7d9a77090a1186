#pragma once
// Small fixed-size vectors and matrices.

#include <array>
#include <cmath>

#include "core/math/body.hpp"

namespace tread {

/// Three components in a body's local basis (sweep, p, q) or in Cartesian axes (x, y, z), as the owner says.
struct Vec3 {
  double x = 0, y = 0, z = 0;

  TREAD_BODY double& operator[](int i) { return i == 0 ? x : (i == 1 ? y : z); }
  TREAD_BODY double operator[](int i) const { return i == 0 ? x : (i == 1 ? y : z); }
  bool operator==(const Vec3&) const = default;
  TREAD_BODY Vec3& operator+=(const Vec3& b) {
    x += b.x;
    y += b.y;
    z += b.z;
    return *this;
  }
  TREAD_BODY Vec3& operator-=(const Vec3& b) {
    x -= b.x;
    y -= b.y;
    z -= b.z;
    return *this;
  }
};

TREAD_BODY Vec3 operator+(Vec3 a, const Vec3& b) {
  return a += b;
}
TREAD_BODY Vec3 operator-(Vec3 a, const Vec3& b) {
  return a -= b;
}
TREAD_BODY Vec3 operator-(const Vec3& a) {
  return {-a.x, -a.y, -a.z};
}
TREAD_BODY Vec3 operator*(double s, const Vec3& a) {
  return {s * a.x, s * a.y, s * a.z};
}
TREAD_BODY Vec3 operator*(const Vec3& a, double s) {
  return s * a;
}
TREAD_BODY double dot(const Vec3& a, const Vec3& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
TREAD_BODY Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
TREAD_BODY double norm(const Vec3& a) {
  return std::sqrt(dot(a, a));
}

using Mat3 = std::array<std::array<double, 3>, 3>;

}  // namespace tread
