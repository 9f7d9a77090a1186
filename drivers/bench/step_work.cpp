#include "drivers/bench/step_work.hpp"

#include "drivers/bench/work.hpp"

namespace tread {

namespace {

void add(Load& load, const Work& work, std::int64_t units) {
  load.flops += work.flops * static_cast<double>(units);
  load.bytes += work.bytes * static_cast<double>(units);
}

Load force_and_motion(const Model& model) {
  Load load;
  for (int b = 0; b < static_cast<int>(model.mesh.blocks.size()); ++b) {
    const SweptBlock& block = model.mesh.blocks[static_cast<std::size_t>(b)];
    const bool revolved = block.sweep == Sweep::revolved;
    const bool damped =
        model.beta[static_cast<std::size_t>(b)] != 0 || model.branches[static_cast<std::size_t>(b)];
    const std::int64_t perturbed = model.internal->perturbed_elements(b);
    for (const bool own : {false, true})
      add(load,
          element_work({block.sweep, damped, revolved, own, true, block.vertical_only}, block,
                       value_bytes(model.scene)),
          own ? perturbed : block.elements() - perturbed);
  }
  return load;
}

}  // namespace

Load phase_load(const Model& model, StepPhase phase) {
  Load load;
  const ValueBytes bytes = value_bytes(model.scene);
  const std::int64_t tied = model.ties ? model.ties->secondary_count() : 0;
  if (phase == StepPhase::internal_force) load = force_and_motion(model);
  if (phase == StepPhase::tied_forces) add(load, tie_hand_over_work(bytes), tied);
  if (phase == StepPhase::tied_motion) add(load, tie_follow_work(bytes), tied);
  load.working_set = static_cast<std::int64_t>(load.bytes);
  return load;
}

}  // namespace tread
