#pragma once
// Torque on the axle, or on the carrier of a guided bore. [theory.md, Connectors]

#include "core/scene.hpp"
#include "drivers/engine/features/feature.hpp"
#include "kernels/connectors/connectors.hpp"
#include "kernels/connectors/guided_bore.hpp"

namespace tread {

class Torque final : public Feature {
 public:
  /// `full`: torque of which MotionSpec::torque_share() is the share [N m]. Keeps references; the torque acts
  /// on `bore` where there is one, else on `nodes`.
  Torque(const MotionSpec& motion, double full, const AxleTorque& nodes, const GuidedBore* bore)
      : motion_(motion), full_(full), nodes_(&nodes), bore_(bore) {}

  const char* name() const override { return "torque"; }
  std::vector<PhaseInfo> phases() const override;
  std::vector<FieldBytes> fields() const override;
  void apply(StepPhase phase, StepState& step) override;
  void list_state(StateList& list) override;
  void end_sample(const StepState& step, Sample& sample) const override;

 private:
  MotionSpec motion_;
  double full_;  ///< [N m]
  const AxleTorque* nodes_;
  const GuidedBore* bore_;
  double torque_ = 0;  ///< of the last step [N m]
  double work_ = 0;    ///< [J]
};

}  // namespace tread
