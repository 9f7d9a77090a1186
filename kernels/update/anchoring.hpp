#pragma once
// The frame of a spinning body moved onto its motion: what becomes of the nodes. For one node, on processor
// and device. [theory.md, Body frames]

#include "core/body_frame.hpp"
#include "kernels/update/mean_motion.hpp"
#include "kernels/update/turn.hpp"

namespace tread {

/// Absolute positions at the time of the displacements do not change, nor do absolute velocities at the half
/// step before it.
class Anchoring {
 public:
  /// `mean`: motion relative to the frame; along y the frame stays, as the body is restrained there. `dt` [s]
  Anchoring(MeanMotion mean, const BodyFrame& frame, double dt);

  const BodyFrame& moved() const { return moved_; }

  /// Shares of the nodes of a station.
  struct Station {
    Vec3 shift, shift_half, faster;
  };
  /// `angle`: of the station in the body [rad].
  TREAD_BODY Station at(double angle) const {
    const Turn half(angle + half_angle_);
    return {Turn(angle + angle_).to_cylindrical(displacement_), half.to_cylindrical(step_half_),
            half.to_cylindrical(speed_change_)};
  }
  /// `reference`: place of the node in the basis of its station, (0, y, r) in a swept block [m]; u:
  /// displacement [m], w: relative velocity [m/s].
  TREAD_BODY void move(const Station& at, const Vec3& reference, Vec3& u, Vec3& w) const {
    const Vec3 displacement = u;
    const Vec3 velocity = w;
    // Absolute displacement, seen from the moved frame.
    u = back_.of(reference + displacement - at.shift) - reference;
    // Absolute velocity at the half step, seen from the moved frame.
    const Vec3 arm_half = reference + displacement - half_step_ * velocity;
    const Vec3 absolute = velocity + spin_cross(spin_, arm_half);
    w = back_half_.of(absolute - at.faster) -
        spin_cross(moved_.spin, back_half_.of(arm_half - at.shift_half));
  }

 private:
  double angle_, half_angle_, spin_;  ///< of the frame before
  double half_step_;                  ///< [s]
  BodyFrame moved_;
  Vec3 displacement_, step_half_, speed_change_;
  Turn back_, back_half_;
};

}  // namespace tread
