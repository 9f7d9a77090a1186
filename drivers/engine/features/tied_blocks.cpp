#include "drivers/engine/features/tied_blocks.hpp"

namespace tread {

std::vector<PhaseInfo> TiedBlocks::phases() const {
  return {{StepPhase::tied_forces, "tied nodes", {RunField::tie_links, RunField::force}, {RunField::force}},
          {StepPhase::tied_motion,
           "tied nodes",
           {RunField::tie_links, RunField::velocity, RunField::displacement},
           {RunField::velocity, RunField::displacement}}};
}

void TiedBlocks::apply(StepPhase phase, StepState& step) {
  if (step.whole.ties_follow()) return;
  if (phase == StepPhase::tied_forces)
    ties_->hand_over(step.force, step.whole.tie_items());
  else
    ties_->follow({step.displacement, step.velocity}, step.whole.tie_items());
}

}  // namespace tread
