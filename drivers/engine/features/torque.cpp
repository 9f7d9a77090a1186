#include "drivers/engine/features/torque.hpp"

namespace tread {

std::vector<PhaseInfo> Torque::phases() const {
  if (bore_) return {{StepPhase::torque, "guided bore", {RunField::wheel_frame, RunField::bore_nodes}, {}}};
  return {{StepPhase::torque,
           "end of the axle",
           {RunField::torque_nodes, RunField::displacement, RunField::velocity, RunField::wheel_frame},
           {RunField::force}}};
}

std::vector<FieldBytes> Torque::fields() const {
  if (bore_) return {};
  return {{RunField::torque_nodes, nodes_->bytes()}};
}

void Torque::apply(StepPhase /*phase*/, StepState& step) {
  const double before = torque_;
  torque_ = full_ * motion_.torque_share(step.time);
  const double spin = bore_
                          ? step.wheel.spin + bore_->motion().spin
                          : nodes_->apply(torque_, step.displacement, step.velocity, step.wheel, step.force);
  work_ += 0.5 * (before + torque_) * spin * step.dt;
  step.axle_torque = torque_;
}

void Torque::list_state(StateList& list) {
  list.add("torque", torque_);
  list.add("work", work_);
}

void Torque::end_sample(const StepState& /*step*/, Sample& sample) const {
  sample.energy.torque_work = work_;
  sample.torque = torque_;
}

}  // namespace tread
