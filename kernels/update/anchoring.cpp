#include "kernels/update/anchoring.hpp"

namespace tread {

Anchoring::Anchoring(MeanMotion mean, const BodyFrame& frame, double dt)
    : angle_(frame.angle), spin_(frame.spin), half_step_(0.5 * dt), moved_(frame) {
  mean.displacement.y = mean.velocity.y = 0;
  moved_.origin += mean.displacement;
  moved_.velocity += mean.velocity;
  moved_.angle += mean.rotation;
  moved_.spin += mean.spin;

  const BodyFrame before_half = frame.after(-0.5 * dt);
  const BodyFrame after_half = moved_.after(-0.5 * dt);
  half_angle_ = before_half.angle;
  displacement_ = mean.displacement;
  step_half_ = after_half.origin - before_half.origin;
  speed_change_ = moved_.velocity - frame.velocity;
  back_ = Turn(-mean.rotation);
  back_half_ = Turn(before_half.angle - after_half.angle);
}

}  // namespace tread
