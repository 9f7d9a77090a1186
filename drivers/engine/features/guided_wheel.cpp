#include "drivers/engine/features/guided_wheel.hpp"

namespace tread {

std::vector<PhaseInfo> GuidedWheel::phases() const {
  return {{StepPhase::guided_bore,
           "bore of the wheel",
           {RunField::bore_nodes, RunField::wheel_frame},
           {RunField::bore_nodes, RunField::displacement, RunField::velocity}}};
}

void GuidedWheel::apply(StepPhase /*phase*/, StepState& step) {
  const BodyFrame& frame = step.wheel;
  const MeanMotion before = bore_.motion();
  const double balance = bore_.counterweight(frame.spin + before.spin, frame.angle + before.rotation);
  bore_.move({step.displacement, step.velocity}, frame, step.dt, {balance - load_, step.axle_torque});
  const double impulse = bore_.guide_impulse();
  work_ += 0.5 * (impulse_before_ + impulse) * frame.velocity.x;
  work_ += step.dt * balance * (frame.velocity.z + bore_.motion().velocity.z);
  impulse_before_ = impulse;
  step.impulse.total += Vec3{impulse, 0, step.dt * balance};
}

void GuidedWheel::list_state(StateList& list) {
  bore_.list_state(list);
  list.add("work", work_);
  list.add("impulse_before", impulse_before_);
}

void GuidedWheel::begin_sample(const StepState& step, Sample& sample) {
  const double height = step.wheel.origin.z + bore_.motion().displacement.z;
  sample.energy.gravity += load_ * height;
}

void GuidedWheel::end_sample(const StepState& /*step*/, Sample& sample) const {
  sample.energy.guide_work = work_;
}

}  // namespace tread
