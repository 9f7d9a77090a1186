#pragma once
// Rigid motions of swept nodes and the resultants of their forces, tile by tile.

#include <cmath>
#include <cstdint>

#include "core/mesh/swept_block.hpp"

namespace tread {

/// Displacement translation + rotation x (position - centre), or the dual: a force and its moment about the
/// centre. Cartesian, with positions from position() at frame angle 0. [m, rad] or [N, N m]
struct RigidMotion {
  Vec3 translation, rotation;

  RigidMotion& operator+=(const RigidMotion& other) {
    translation += other.translation;
    rotation += other.rotation;
    return *this;
  }
};
inline RigidMotion operator*(double scale, const RigidMotion& motion) {
  return {scale * motion.translation, scale * motion.rotation};
}
inline double dot(const RigidMotion& a, const RigidMotion& b) {
  return dot(a.translation, b.translation) + dot(a.rotation, b.rotation);
}

/// Values of the nodes (p, q) of one station as constant + p along_p + q along_q, in their local basis; or
/// the dual: sums of values, of p and of q times values.
struct StationValues {
  Vec3 constant, along_p, along_q;
};

/// Place of a station's nodes, shifts of single nodes left out: x + p e_y + q e_z in extruded blocks, p e_y +
/// q e_r in revolved ones.
class StationPlace {
 public:
  StationPlace(const SweptBlock& block, int station)
      : revolved_(block.sweep == Sweep::revolved),
        x_(revolved_ ? 0 : block.stations[static_cast<std::size_t>(station)]),
        cosine_(revolved_ ? std::cos(block.stations[static_cast<std::size_t>(station)]) : 1),
        sine_(revolved_ ? std::sin(block.stations[static_cast<std::size_t>(station)]) : 0) {}

  /// Place of nodes at x of a body with Cartesian components, whose p and q are y and z.
  explicit StationPlace(double x) : revolved_(false), x_(x), cosine_(1), sine_(0) {}

  Vec3 position(double p, double q) const { return {x_ + q * q_axis().x, p, q * q_axis().z}; }
  StationValues displacement(const RigidMotion& motion, const Vec3& centre) const {
    return {to_local(motion.translation + cross(motion.rotation, Vec3{x_, 0, 0} - centre)),
            to_local(cross(motion.rotation, {0, 1, 0})), to_local(cross(motion.rotation, q_axis()))};
  }
  /// Resultant of forces in the local basis.
  RigidMotion resultant(const StationValues& sums, const Vec3& centre) const {
    const Vec3 force = to_cartesian(sums.constant);
    return {force, cross(Vec3{x_, 0, 0} - centre, force) + cross({0, 1, 0}, to_cartesian(sums.along_p)) +
                       cross(q_axis(), to_cartesian(sums.along_q))};
  }

 private:
  Vec3 q_axis() const { return revolved_ ? Vec3{-sine_, 0, -cosine_} : Vec3{0, 0, 1}; }
  Vec3 to_local(const Vec3& v) const {
    return revolved_ ? Vec3{-cosine_ * v.x + sine_ * v.z, v.y, -sine_ * v.x - cosine_ * v.z} : v;
  }
  Vec3 to_cartesian(const Vec3& v) const {
    return revolved_ ? Vec3{-cosine_ * v.x - sine_ * v.z, v.y, sine_ * v.x - cosine_ * v.z} : v;
  }

  bool revolved_;
  double x_;  ///< [m]
  double cosine_, sine_;
};

/// StationValues of the lanes of a tile.
struct TileValues {
  double constant[3][kLanes] = {};
  double along_p[3][kLanes] = {};
  double along_q[3][kLanes] = {};

  void set(int lane, const StationValues& values) {
    for (int c = 0; c < 3; ++c) {
      constant[c][lane] = values.constant[c];
      along_p[c][lane] = values.along_p[c];
      along_q[c][lane] = values.along_q[c];
    }
  }
  StationValues at(int lane) const {
    const auto vector = [lane](const double(&of)[3][kLanes]) {
      return Vec3{of[0][lane], of[1][lane], of[2][lane]};
    };
    return {vector(constant), vector(along_p), vector(along_q)};
  }

  /// Adds the values of a node's lanes to the sums, times `weight(component, lane)`.
  template <class Weight>
  void add(double p, double q, const double* values, const Weight& weight) {
    for (int c = 0; c < 3; ++c)
      for (int lane = 0; lane < kLanes; ++lane) {
        const double value = weight(c, lane) * values[c * kLanes + lane];
        constant[c][lane] += value;
        along_p[c][lane] += p * value;
        along_q[c][lane] += q * value;
      }
  }
  /// Adds these values to those of a node's lanes, times `weight(component, lane)`.
  template <class Weight>
  void add_to(double p, double q, double* values, const Weight& weight) const {
    for (int c = 0; c < 3; ++c)
      for (int lane = 0; lane < kLanes; ++lane)
        values[c * kLanes + lane] +=
            weight(c, lane) * (constant[c][lane] + p * along_p[c][lane] + q * along_q[c][lane]);
  }
};

}  // namespace tread
