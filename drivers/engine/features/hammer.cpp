#include "drivers/engine/features/hammer.hpp"

namespace tread {

std::vector<PhaseInfo> Hammer::phases() const {
  return {{StepPhase::hammer, "rail head", {RunField::displacement}, {RunField::force}}};
}

void Hammer::apply(StepPhase /*phase*/, StepState& step) {
  const double force = spec_.force_at(step.time);
  const double displacement = -point_.value(step.displacement, 2) - struck_at_;
  work_ += 0.5 * (force_ + force) * (displacement - displacement_);
  force_ = force;
  displacement_ = displacement;
  point_.add(step.force, 2, force);
}

void Hammer::list_state(StateList& list) {
  list.add("struck_at", struck_at_);
  list.add("force", force_);
  list.add("displacement", displacement_);
  list.add("work", work_);
}

void Hammer::begin(const Motion& motion, const SprungStart& /*sprung*/) {
  struck_at_ = -point_.value(motion.displacement, 2);
}

void Hammer::end_sample(const StepState& /*step*/, Sample& sample) const {
  sample.energy.hammer_work = work_;
  sample.hammer_force = force_;
  sample.hammer_displacement = displacement_;
}

}  // namespace tread
