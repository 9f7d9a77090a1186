#pragma once
// A force that presses on the wheel in place of a vehicle.

#include "drivers/engine/features/feature.hpp"
#include "kernels/connectors/connectors.hpp"

namespace tread {

class WheelLoad final : public Feature {
 public:
  /// Keeps a reference to the journal. `load`: downwards [N]
  WheelLoad(double load, const Journal& journal) : load_(load), journal_(&journal) {}

  const char* name() const override { return "wheel_load"; }
  std::vector<PhaseInfo> phases() const override {
    return {{StepPhase::wheel_load,
             "journal",
             {RunField::journal_nodes, RunField::wheel_frame},
             {RunField::force}}};
  }
  std::vector<FieldBytes> fields() const override { return {{RunField::journal_nodes, journal_->bytes()}}; }
  void apply(StepPhase /*phase*/, StepState& step) override {
    journal_->add(step.force, step.wheel, {0, 0, load_});
  }
  void begin_sample(const StepState& step, Sample& sample) override {
    const double height = step.wheel.origin.z + journal_->displacement(step.displacement, step.wheel).z;
    sample.energy.gravity += load_ * height;
  }

 private:
  double load_;  ///< [N]
  const Journal* journal_;
};

}  // namespace tread
