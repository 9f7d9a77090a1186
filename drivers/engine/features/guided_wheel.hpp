#pragma once
// A wheel whose bore sits on a rigid carrier that moves forward at a given speed. [theory.md, Connectors]

#include "drivers/engine/features/feature.hpp"
#include "kernels/connectors/guided_bore.hpp"

namespace tread {

class GuidedWheel final : public Feature {
 public:
  /// Begins with the carrier of statics. `load`: downwards on the carrier [N]
  GuidedWheel(GuidedBore bore, double load) : bore_(std::move(bore)), load_(load) {}

  GuidedBore& bore() { return bore_; }

  const char* name() const override { return "guided_bore"; }
  std::vector<PhaseInfo> phases() const override;
  std::vector<FieldBytes> fields() const override { return {{RunField::bore_nodes, bore_.bytes()}}; }
  void apply(StepPhase phase, StepState& step) override;
  void list_state(StateList& list) override;
  void settle(const StaticStart& start) override { bore_.settle(start.displacement); }
  void begin_sample(const StepState& step, Sample& sample) override;
  void end_sample(const StepState& step, Sample& sample) const override;

 private:
  GuidedBore bore_;
  double load_;                ///< [N]
  double work_ = 0;            ///< of the guide [J]
  double impulse_before_ = 0;  ///< of the guide in the last step [N s]
};

}  // namespace tread
