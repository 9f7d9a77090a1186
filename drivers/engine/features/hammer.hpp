#pragma once
// A blow on the rail head. [theory.md, Connectors]

#include "core/scene.hpp"
#include "drivers/engine/features/feature.hpp"
#include "kernels/connectors/connectors.hpp"

namespace tread {

class Hammer final : public Feature {
 public:
  Hammer(const HammerSpec& spec, const Attachment& point) : spec_(spec), point_(point) {}

  const char* name() const override { return "hammer"; }
  std::vector<PhaseInfo> phases() const override;
  void apply(StepPhase phase, StepState& step) override;
  void list_state(StateList& list) override;
  void begin(const Motion& motion, const SprungStart& sprung) override;
  void end_sample(const StepState& step, Sample& sample) const override;

 private:
  HammerSpec spec_;
  Attachment point_;
  double struck_at_ = 0;     ///< displacement of the struck point at the start, downwards [m]
  double force_ = 0;         ///< of the last step [N]
  double displacement_ = 0;  ///< since the start, downwards [m]
  double work_ = 0;          ///< [J]
};

}  // namespace tread
