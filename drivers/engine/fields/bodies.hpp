#pragma once
// The elastic bodies of a step: internal force, motion of the nodes, restraints. [theory.md, Time step]

#include <cstdint>
#include <vector>

#include "drivers/engine/features/feature.hpp"
#include "drivers/engine/fields/node_fields.hpp"
#include "drivers/engine/model/model.hpp"

namespace tread {

class Bodies final : public Feature {
 public:
  /// Keeps a reference.
  explicit Bodies(const Model& model);

  const char* name() const override { return "bodies"; }
  std::vector<PhaseInfo> phases() const override;
  std::vector<FieldBytes> fields() const override;
  void apply(StepPhase phase, StepState& step) override;
  void begin_sample(const StepState& step, Sample& sample) override;
  void add_kinetic_energy(const Motion& motion, double& sum) const override;

 private:
  StepLoads loads(const StepState& step) const { return {step.dt, model_->scene.gravity, step.wheel}; }
  void internal_force(StepState& step) const;
  void update(StepState& step) const;

  const Model* model_;
  std::vector<std::int64_t> held_;
};

}  // namespace tread
