#include "drivers/engine/features/fastenings.hpp"

namespace tread {

std::vector<PhaseInfo> Fastenings::phases() const {
  return {{StepPhase::fastenings,
           "spring-dampers",
           {RunField::fastening_elements, RunField::displacement, RunField::velocity},
           {RunField::force}}};
}

std::vector<FieldBytes> Fastenings::fields() const {
  return {{RunField::fastening_elements, elements_.bytes()}};
}

void Fastenings::apply(StepPhase /*phase*/, StepState& step) {
  elements_.apply(step.displacement, step.velocity, step.dt, step.force);
}

void Fastenings::begin_sample(const StepState& step, Sample& sample) {
  sample.energy.connectors += elements_.energy(step.displacement);
}

void Fastenings::end_sample(const StepState& /*step*/, Sample& sample) const {
  sample.energy.connector_loss += elements_.dissipated();
}

}  // namespace tread
