#pragma once
// Fastenings between the rail and its support. [theory.md, Connectors]

#include "drivers/engine/features/feature.hpp"
#include "kernels/connectors/connectors.hpp"

namespace tread {

class Fastenings final : public Feature {
 public:
  explicit Fastenings(SpringDampers elements) : elements_(std::move(elements)) {}

  const char* name() const override { return "fastenings"; }
  std::vector<PhaseInfo> phases() const override;
  std::vector<FieldBytes> fields() const override;
  void apply(StepPhase phase, StepState& step) override;
  void list_state(StateList& list) override { elements_.list_state(list); }
  void begin_sample(const StepState& step, Sample& sample) override;
  void end_sample(const StepState& step, Sample& sample) const override;

 private:
  SpringDampers elements_;
};

}  // namespace tread
