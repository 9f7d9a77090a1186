#pragma once
// The vehicle over the wheelset: the sprung mass on the primary suspension, and the unsprung mass on the
// journal. [theory.md, Connectors]

#include "core/scene.hpp"
#include "drivers/engine/features/feature.hpp"
#include "kernels/connectors/connectors.hpp"

namespace tread {

class Vehicle final : public Feature {
 public:
  /// Keeps a reference to the journal. `gravity` [m/s2]
  Vehicle(const VehicleSpec& spec, const Journal& journal, double gravity);

  const SprungMass& sprung_mass() const { return sprung_; }

  const char* name() const override { return "sprung_mass"; }
  std::vector<PhaseInfo> phases() const override;
  std::vector<FieldBytes> fields() const override;
  void apply(StepPhase phase, StepState& step) override;
  void list_state(StateList& list) override { sprung_.list_state(list); }
  void begin(const Motion& motion, const SprungStart& start) override;
  void begin_sample(const StepState& step, Sample& sample) override;
  void end_sample(const StepState& step, Sample& sample) const override;
  void add_kinetic_energy(const Motion& motion, double& sum) const override;
  void add_momentum(const Motion& motion, Vec3& sum) const override;

 private:
  void apply_suspension(StepState& step);
  void add_carried_masses(StepState& step);

  const Journal* journal_;
  SprungMass sprung_;
  double unsprung_mass_;  ///< [kg]
  double carried_mass_;   ///< sprung mass that the journal carries along x [kg]
  double gravity_;        ///< [m/s2]
};

}  // namespace tread
