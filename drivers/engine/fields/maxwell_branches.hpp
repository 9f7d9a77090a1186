#pragma once
// Maxwell branches in a step: their lag, their energies. [theory.md, Maxwell branch]

#include "drivers/engine/features/feature.hpp"
#include "drivers/engine/fields/node_fields.hpp"

namespace tread {

class MaxwellBranches final : public Feature {
 public:
  /// `bytes`: of the lag
  explicit MaxwellBranches(std::int64_t bytes) : bytes_(bytes) {}

  const char* name() const override { return "branches"; }
  std::vector<PhaseInfo> phases() const override {
    return {{StepPhase::branch_lag,
             "blocks that have branches",
             {RunField::velocity, RunField::branch_lag},
             {RunField::branch_lag}}};
  }
  std::vector<FieldBytes> fields() const override { return {{RunField::branch_lag, bytes_, true}}; }

  void apply(StepPhase /*phase*/, StepState& step) override { step.fields.advance_lag(step.dt); }

  void list_state(StateList& list) override {
    list.add("work", work_);
    list.add("power", power_);
    list.add("time", time_);
  }

  /// The loss is linear between the looks at the energies.
  void begin_sample(const StepState& step, Sample& sample) override {
    const BranchEnergy branches = step.fields.branch_energy();
    sample.energy.strain += branches.stored;
    work_ += 0.5 * (power_ + branches.power) * (step.time - time_);
    power_ = branches.power;
    time_ = step.time;
    sample.energy.material_loss += work_;
  }

 private:
  std::int64_t bytes_;
  double work_ = 0;   ///< dissipated since the start [J]
  double power_ = 0;  ///< at the last look [W]
  double time_ = 0;   ///< of the last look [s]
};

}  // namespace tread
