#pragma once
// Record of a passage on the rail's running surface: largest stresses, frictional work, deflection.
// [theory.md, Fields of the surface]

#include "drivers/engine/features/feature.hpp"
#include "kernels/contact/contact.hpp"
#include "kernels/contact/rail_line.hpp"
#include "kernels/contact/surface_fields.hpp"

namespace tread {

/// Observes; changes nothing of the motion.
class SurfaceRecord final : public Feature {
 public:
  /// The part of the rail that is observed.
  struct Place {
    double patch_y;  ///< of the line whose deflection is noted [m]
    double last_x;   ///< wheel's last place at which it is noted, but for the first sample [m]
  };
  /// Keeps references.
  SurfaceRecord(Contact& contact, const InternalForce& internal, const SweptBlock& rail, const Place& place);

  const SurfaceFields& surface() const { return surface_; }
  const RailLine& line() const { return line_; }

  const char* name() const override { return "surface_record"; }
  std::vector<PhaseInfo> phases() const override;
  std::vector<FieldBytes> fields() const override;
  void apply(StepPhase phase, StepState& step) override;
  void watch(const StepState& step, WatchedNodes& nodes) const override;
  void list_state(StateList& list) override;
  void settle(const StaticStart& start) override { line_.note_static(start.rail_rise); }

 private:
  /// Returns true if a sample of this step notes the deflection.
  bool notes_deflection(const StepState& step) const {
    return step.steps == 0 || step.wheel.origin.x <= last_x_;
  }

  const Contact* contact_;
  const InternalForce* internal_;
  SurfaceFields surface_;
  RailLine line_;
  double last_x_;
};

}  // namespace tread
