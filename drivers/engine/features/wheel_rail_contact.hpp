#pragma once
// Contact of wheel and rail in a step: search, then tractions of the middle of the step.
// [theory.md, Contact]

#include "drivers/engine/features/feature.hpp"
#include "kernels/contact/contact.hpp"

namespace tread {

class WheelRailContact final : public Feature {
 public:
  /// Keeps references. `mass`: scalar node field [kg]; `patch_y`: centre of the preload's patch [m]
  WheelRailContact(Contact& contact, const double* mass, double patch_y)
      : contact_(&contact), mass_(mass), patch_y_(patch_y) {}

  const char* name() const override { return "contact"; }
  std::vector<PhaseInfo> phases() const override;
  std::vector<FieldBytes> fields() const override;
  void apply(StepPhase phase, StepState& step) override;
  void list_state(StateList& list) override { contact_->list_state(list); }
  void list_unshared_state(StateList& list) override { contact_->list_searched(list); }
  void meet(const StaticStart& start) override;
  void end_sample(const StepState& step, Sample& sample) const override;

 private:
  void search(const StepState& step);
  void add_tractions(StepState& step);
  Vec3 mean_normal() const;

  Contact* contact_;
  const double* mass_;
  double patch_y_;
};

}  // namespace tread
