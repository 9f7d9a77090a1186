#pragma once
// Step 2: explicit rolling by central difference. [theory.md, Time step]

#include <memory>
#include <span>

#include "core/body_frame.hpp"
#include "core/state_list.hpp"
#include "drivers/engine/fields/node_fields.hpp"
#include "drivers/engine/model/model.hpp"
#include "drivers/engine/phase_clock.hpp"
#include "drivers/engine/start/preload.hpp"
#include "drivers/engine/step_features.hpp"

namespace tread {

/// Balance of impulses and momentum of wheelset, unsprung and sprung mass.
struct MomentumCheck {
  Vec3 impulse;          ///< of all external forces [N s]
  Vec3 change;           ///< of the momentum [N s]
  Vec3 contact_impulse;  ///< size of the contact's impulse, the scale of the error [N s]
};

class Simulation final : private RunEnd {
 public:
  /// Starts from a preload at the scene's speed. `dt`: the step [s]. InputError where it is not above zero,
  /// or the scene's corrugation is not applied to the model.
  Simulation(const Model& model, const Preload& preload, double dt);
  /// Bodies at rest, undeformed, for the fields of state() to be restored; `patch_y`: centre of the preload's
  /// patch [m].
  Simulation(const Model& model, double patch_y, double dt);

  double time() const { return time_; }
  double dt() const { return dt_; }
  std::int64_t steps() const { return steps_; }

  /// One step. Sampled steps fill sample(). NumericalError where the energies, looked at in sampled steps and
  /// every few steps between, are not finite or cannot be.
  void step();
  void set_sampling_interval(std::int64_t steps) { sampling_interval_ = steps; }
  /// Times the phases of every later step; null ends that. It must outlive the steps.
  void observe(PhaseClock* clock) { clock_ = clock; }
  bool sampled() const { return sampled_; }
  const Sample& sample() const { return features_.sampling().sample(); }
  /// Values of the last sample that the scene asks for, and their columns.
  const Measurements& measurements() const { return features_.measurements(); }

  /// Returns true if all displacements and velocities are finite.
  bool finite() const { return fetched().finite(); }
  /// The watch at the last sample.
  const EnergyWatch& energy_watch() const { return features_.sampling().energy_watch(); }

  /// Every field that outlives a step, those of the model's parts too.
  StateList state();

  /// The part of state() that other ranks than 0 get by spread(), as far as they need any of it.
  StateList unshared_state();
  /// Gives other ranks what they hold of rank 0's values, instead of state(). All ranks call it.
  void spread() { fields_->spread(); }
  /// As NodeFields' of this name.
  std::span<const unsigned char> groups_with_mass() const { return fields_->groups_with_mass(); }

  MomentumCheck momentum_check() const;
  std::uint64_t state_hash() const;
  const NodeFields& fields() const { return fetched(); }
  ConstNodeField displacement() const { return fetched().displacement(); }
  ConstNodeField velocity() const { return fetched().velocity(); }
  const BodyFrame& wheel() const { return frame_; }
  /// Motion of the wheel relative to its frame: of a guided bore, or else in the mean; zero without a wheel.
  MeanMotion wheel_motion() const;
  /// Record of the passage on the rail's surface; null without contact.
  const SurfaceFields* surface() const;
  /// The rail's surface along the patch's longitudinal axis, static and in the middle of the solution zone,
  /// or at the last sample before; null without contact.
  const RailLine* rail_line() const;

 private:
  void start(const Preload& preload);
  StepState begin_step();
  void apply(StepPhase phase, StepState& step);
  bool contact_beside(bool measured) const;
  void advance_time();
  /// Brings nodes that samples read to the views.
  void show_watched(StepState& step);
  /// The fields with all values at hand, wherever they live.
  const NodeFields& fetched() const {
    fields_->fetch();
    return *fields_;
  }
  Motion motion() const { return {displacement(), velocity(), frame_, dt_, *fields_}; }
  [[noreturn]] void stop() const override;
  void stop_if_unstable() const override;

  const Model* model_;
  double dt_;
  double time_ = 0;
  std::int64_t steps_ = 0;
  std::int64_t sampling_interval_ = 100;
  bool sampled_ = false;
  PhaseClock* clock_ = nullptr;

  std::unique_ptr<NodeFields> fields_;
  NodeField u_, v_, force_;  ///< of fields_
  BodyFrame frame_;
  ImpulseAccount impulse_;
  Vec3 start_momentum_;
  StepFeatures features_;
  WatchedNodes watched_;
};

}  // namespace tread
