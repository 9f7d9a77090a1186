#pragma once
// Samples of the histories and the energy balance, gathered from all features. [theory.md, Energy stop]

#include <vector>

#include "drivers/engine/energy_watch.hpp"
#include "drivers/engine/features/feature.hpp"
#include "drivers/engine/model/model.hpp"

namespace tread {

/// Samples that the scene's histories hold, about one a step at most; 0 without motion.
std::int64_t sample_count(const Model& model);

class Sampling final : public Feature {
 public:
  /// Keeps a reference. `features`: whose values make a sample.
  Sampling(const Model& model, std::vector<Feature*> features)
      : model_(&model), features_(std::move(features)) {}

  const Sample& sample() const { return sample_; }
  const EnergyWatch& energy_watch() const { return energy_watch_; }

  const char* name() const override { return "sampling"; }
  std::vector<PhaseInfo> phases() const override;
  std::vector<FieldBytes> fields() const override;
  void apply(StepPhase phase, StepState& step) override;
  void list_state(StateList& list) override;

 private:
  void open_sample(const StepState& step);
  void close_sample(const StepState& step);
  double kinetic_energy(const Motion& motion) const;

  const Model* model_;
  std::vector<Feature*> features_;
  Sample sample_;
  double kinetic_before_ = 0;
  EnergyWatch energy_watch_;
};

}  // namespace tread
