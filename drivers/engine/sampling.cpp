#include "drivers/engine/sampling.hpp"

#include <algorithm>
#include <cmath>

namespace tread {

std::int64_t sample_count(const Model& model) {
  const Scene& scene = model.scene;
  if (!scene.motion) return 0;
  double fastest = 0;  // wave [m/s]
  for (const auto& [name, material] : scene.materials)
    fastest = std::max(fastest, material.pressure_wave_speed());
  const double step = model.sizes.contact / fastest;
  return static_cast<std::int64_t>(
             std::ceil(scene.motion->duration / std::max(scene.output.history_interval, step))) +
         1;
}

std::vector<PhaseInfo> Sampling::phases() const {
  const std::vector<RunField> reads = {RunField::displacement, RunField::velocity, RunField::force};
  return {{StepPhase::energies, "all features, at samples and every few steps", reads, {RunField::samples}},
          {StepPhase::samples, "all features, at samples and every few steps", reads, {RunField::samples}}};
}

std::vector<FieldBytes> Sampling::fields() const {
  return {{RunField::samples, sample_count(*model_) * static_cast<std::int64_t>(sizeof(Sample))}};
}

void Sampling::apply(StepPhase phase, StepState& step) {
  if (!step.measured) return;
  if (phase == StepPhase::energies)
    open_sample(step);
  else
    close_sample(step);
}

void Sampling::list_state(StateList& list) {
  list.add_records("sample", std::span(&sample_, 1));
  list.add_part("energy_watch", energy_watch_);
}

void Sampling::open_sample(const StepState& step) {
  sample_ = {};
  sample_.time = step.time;
  kinetic_before_ = kinetic_energy(step.motion());
  for (Feature* feature : features_) feature->begin_sample(step, sample_);
}

void Sampling::close_sample(const StepState& step) {
  EnergyLedger& energy = sample_.energy;
  const double excess = step.whole.half_step_excess(step.dt);
  energy.kinetic = 0.5 * (kinetic_before_ + kinetic_energy(step.motion())) - excess;
  for (const Feature* feature : features_) feature->end_sample(step, sample_);
  if (!energy_watch_.started()) energy_watch_.start(energy, excess, step.whole.fixed_kinetic_energy());
  if (!energy_watch_.balanced(energy, excess)) step.end.stop();
  energy.residual = energy.total() - energy_watch_.start_energy();
}

double Sampling::kinetic_energy(const Motion& motion) const {
  double sum = 0;
  for (const Feature* feature : features_) feature->add_kinetic_energy(motion, sum);
  return sum;
}

}  // namespace tread
