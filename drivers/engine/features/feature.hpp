#pragma once
// A feature of a scene: its state, its phases of the step, its energies. An absent feature has no object.

#include <cstdint>
#include <span>
#include <vector>

#include "core/body_frame.hpp"
#include "core/mesh/node_field.hpp"
#include "core/state_list.hpp"
#include "drivers/engine/features/run_field.hpp"
#include "drivers/engine/features/sample.hpp"
#include "drivers/engine/features/step_phase.hpp"
#include "drivers/engine/features/whole_fields.hpp"
#include "kernels/material/law_state.hpp"

namespace tread {

class NodeFields;

/// Positions and velocities of all bodies between two steps.
struct Motion {
  ConstNodeField displacement;  ///< [m]
  ConstNodeField velocity;      ///< at the half step before [m/s]
  const BodyFrame& wheel;       ///< at the time of the displacements
  double dt;                    ///< [s]
  WholeFields& whole;           ///< the same motion, for sums over it

  /// The wheel's frame at the time of the velocities.
  BodyFrame half_step_frame() const { return wheel.after(-0.5 * dt); }
};

/// Impulses of external forces on the vehicle since the start.
struct ImpulseAccount {
  Vec3 total;    ///< by contact and guide [N s]
  Vec3 contact;  ///< size of the contact's [N s]
};

/// Ends a run.
class RunEnd {
 public:
  /// NumericalError that names instant, energies, place, cause and way out. All ranks call it.
  [[noreturn]] virtual void stop() const = 0;
  /// NumericalError where the step exceeds the stable one, which programs that link the engine may state: for
  /// a patch that leaves the searched surface. Rank 0 alone calls it.
  virtual void stop_if_unstable() const = 0;

 protected:
  ~RunEnd() = default;
};

/// Everything that phases read and write, during one step.
struct StepState {
  NodeFields& fields;
  WholeFields& whole;      ///< the same, to fetch all of them
  NodeField displacement;  ///< [m]
  NodeField velocity;      ///< at the half step [m/s]
  NodeField force;         ///< internal minus external [N]
  ConstNodeField lag;      ///< of Maxwell branches, where there are any [m]
  ConstLawState laws;      ///< state of laws that are not linear, where there are any
  BodyFrame& wheel;
  ImpulseAccount& impulse;
  const RunEnd& end;
  double time;             ///< at the start of the step [s]
  double dt;               ///< [s]
  std::int64_t steps;      ///< taken before this one
  std::int64_t sampling;   ///< steps between samples
  bool sampled;            ///< histories get a sample of this step
  bool measured;           ///< energies are looked at in this step
  bool contact_beside;     ///< contact is solved beside the elements away from the patch
  double axle_torque = 0;  ///< of this step, once its phase is done [N m]

  Motion motion() const { return {displacement, velocity, wheel, dt, whole}; }
};

/// The static state, from which a run starts.
struct StaticStart {
  NodeField displacement;  ///< [m]
  NodeField velocity;      ///< [m/s]
  BodyFrame& wheel;
  double dt;                               ///< [s]
  double traction = 0;                     ///< shear stress over pressure [-]
  std::span<const double> rail_rise = {};  ///< at rest, along the record's RailLine [m]
};

/// Motion of the sprung mass of a wheel that has been rolling, against that at rest.
struct SprungStart {
  double drop = 0;   ///< downwards [m]
  double speed = 0;  ///< upwards [m/s]
};

/// A phase as its feature declares it.
struct PhaseInfo {
  StepPhase phase;
  const char* body;  ///< the part of the model that it works on, in words
  std::vector<RunField> reads;
  std::vector<RunField> writes;
};

class Feature {
 public:
  Feature() = default;
  Feature(const Feature&) = delete;
  Feature& operator=(const Feature&) = delete;
  virtual ~Feature() = default;

  /// Group of its state in checkpoints.
  virtual const char* name() const = 0;
  /// Phases of the step that apply() carries out.
  virtual std::vector<PhaseInfo> phases() const = 0;
  /// Fields that the feature owns.
  virtual std::vector<FieldBytes> fields() const { return {}; }

  /// Carries out one of phases().
  virtual void apply(StepPhase phase, StepState& step) = 0;

  /// Lists the state that outlives a step.
  virtual void list_state(StateList& /*list*/) {}
  /// Lists the part of it that only rank 0 reads and writes.
  virtual void list_unshared_state(StateList& /*list*/) {}

  /// Takes over the static state.
  virtual void settle(const StaticStart& /*start*/) {}
  /// Finds its place in the first instant of the run, after settle() of all features.
  virtual void meet(const StaticStart& /*start*/) {}
  /// Begins with the motion of the first instant.
  virtual void begin(const Motion& /*motion*/, const SprungStart& /*sprung*/) {}

  /// Names nodes that it reads in the phases after the motion of a measured step, besides those on which it
  /// acts.
  virtual void watch(const StepState& /*step*/, WatchedNodes& /*nodes*/) const {}
  /// Adds stored energies and positions at the start of a step, whose force is that of the elements alone.
  virtual void begin_sample(const StepState& /*step*/, Sample& /*sample*/) {}
  /// Adds works, losses and the other values at the end of a step.
  virtual void end_sample(const StepState& /*step*/, Sample& /*sample*/) const {}
  /// Adds kinetic energy [J].
  virtual void add_kinetic_energy(const Motion& /*motion*/, double& /*sum*/) const {}
  /// Adds momentum of wheelset and vehicle [N s].
  virtual void add_momentum(const Motion& /*motion*/, Vec3& /*sum*/) const {}
};

}  // namespace tread
