#pragma once
// Step 2: explicit rolling by central difference. [theory.md, Time step]

#include <memory>
#include <optional>
#include <vector>

#include "core/body_frame.hpp"
#include "core/state_list.hpp"
#include "drivers/engine/energy_ledger.hpp"
#include "drivers/engine/energy_watch.hpp"
#include "drivers/engine/model.hpp"
#include "drivers/engine/node_fields.hpp"
#include "drivers/engine/phase_clock.hpp"
#include "drivers/engine/preload.hpp"
#include "kernels/contact/rail_line.hpp"
#include "kernels/contact/surface_fields.hpp"

namespace tread {

/// What Maxwell branches dissipate, from their power at the looks at the energies, linear between them.
struct BranchLoss {
  double work = 0;   ///< since the start [J]
  double power = 0;  ///< at the last look [W]
  double time = 0;   ///< of it [s]

  void look(double at, double power_now) {
    work += 0.5 * (power + power_now) * (at - time);
    power = power_now;
    time = at;
  }
  void list_state(StateList& list) {
    list.add("work", work);
    list.add("power", power);
    list.add("time", time);
  }
};

/// What one sample of the histories shows.
struct Sample {
  double time = 0;
  double wheel_x = 0, wheel_z = 0;         ///< of the frame's origin [m]
  double wheel_speed = 0, wheel_spin = 0;  ///< [m/s], [rad/s]
  double vertical_force = 0;               ///< F_N, on the wheel, upwards [N]
  double longitudinal_force = 0;           ///< F_L, on the wheel, forwards [N]
  double lateral_force = 0;                ///< on the wheel, to the field side [N]
  double patch_area = 0, slip_area = 0;    ///< [m2]
  double max_pressure = 0, max_shear = 0;  ///< nodal averages [Pa]
  double max_penetration = 0;              ///< [m]
  double creepage_node = 0;                ///< eq. (3) at the node that starts in the patch [-]
  double creepage_mean = 0;                ///< mean of 28 nodes [-]
  double torque = 0;                       ///< [N m]
  double corrugation_depth = 0;            ///< below the wheel [m]
  double hammer_force = 0;                 ///< on the rail, downwards [N]
  double hammer_displacement = 0;          ///< of the struck point since the start, downwards [m]
  EnergyLedger energy;
};

/// How far impulses and momentum of wheelset, unsprung and sprung mass agree.
struct MomentumCheck {
  Vec3 impulse;          ///< of all external forces [N s]
  Vec3 change;           ///< of the momentum [N s]
  Vec3 contact_impulse;  ///< size of the contact's impulse, the scale of the error [N s]
};

class Simulation {
 public:
  /// Starts from a preload at the scene's speed. `dt`: the step [s].
  Simulation(Model& model, const Preload& preload, double dt);
  /// Bodies at rest, undeformed, for the fields of state() to be restored; `patch_y`: centre of the preload's
  /// patch [m].
  Simulation(Model& model, double patch_y, double dt);

  double time() const { return time_; }
  double dt() const { return dt_; }
  std::int64_t steps() const { return steps_; }

  /// One step. Sampled steps fill sample(). NumericalError where the energies, looked at in sampled steps and
  /// every few steps between, are not finite or cannot be.
  void step();
  void set_sampling_interval(std::int64_t steps) { sampling_ = steps; }
  /// Times the phases of every later step; null ends that. It must outlive the steps.
  void observe(PhaseClock* clock) { clock_ = clock; }
  bool sampled() const { return sampled_; }
  const Sample& sample() const { return sample_; }

  /// Whether all displacements and velocities are.
  bool finite() const;
  /// Of the last sample.
  const EnergyWatch& energy_watch() const { return energy_watch_; }

  /// Every field that outlives a step, those of the model's parts too.
  StateList state();

  MomentumCheck momentum_check() const;
  std::uint64_t state_hash() const;
  const NodeFields& fields() const { return *fields_; }
  ConstNodeField displacement() const { return u_; }
  ConstNodeField velocity() const { return v_; }
  const BodyFrame& wheel() const { return frame_; }
  /// What the wheel leaves on the rail's surface; none without contact.
  const std::optional<SurfaceFields>& surface() const { return surface_; }
  /// The rail's surface along the patch's longitudinal axis, static and in the middle of the solution zone,
  /// or at the last sample before; none without contact.
  const std::optional<RailLine>& rail_line() const { return rail_line_; }
  double torque_at(double time) const;

 private:
  void enter(StepPhase phase) {
    if (clock_) clock_->enter(phase);
  }
  void start(const Preload& preload);
  void choose_creepage_nodes(double patch_y);
  void deform();
  void connect();
  void roll();
  void record();
  void drive();
  void strike();
  void carry();
  void search();
  void move();
  void guide();
  void finish();
  void begin_sample();
  void end_sample();
  void watch(double excess);
  [[noreturn]] void stop() const;
  StepLoads loads() const { return {dt_, model_->scene.gravity, frame_}; }
  BodyFrame half_step_frame() const;
  double kinetic_energy() const;
  double gravity_potential() const;
  Vec3 vehicle_momentum() const;
  double creepage(std::size_t node, const MeanMotion& mean) const;
  /// Of the wheel relative to its frame: of the guided bore, or else in the mean over the mass.
  MeanMotion wheel_motion(ConstNodeField u, ConstNodeField v) const;
  /// Height of the axle, where the load acts [m].
  double axle_height() const;
  void anchor(NodeField u, NodeField v);
  void follow_ties(NodeField u, NodeField v) const;

  Model* model_;
  std::vector<std::int64_t> held_;  ///< restrained unknowns that would move
  double dt_;
  double time_ = 0;
  std::int64_t steps_ = 0;
  std::int64_t sampling_ = 100;
  bool sampled_ = false;
  bool measured_ = false;  ///< energies are looked at in this step
  PhaseClock* clock_ = nullptr;

  std::unique_ptr<NodeFields> fields_;
  NodeField u_, v_, force_;  ///< of fields_
  BodyFrame frame_;
  SprungMass sprung_;
  double max_torque_ = 0;
  double torque_ = 0, torque_before_ = 0;
  double torque_work_ = 0;
  double guide_work_ = 0, guide_before_ = 0;
  Vec3 impulse_;          ///< on the vehicle by contact and guide [N s]
  Vec3 contact_impulse_;  ///< its size [N s]
  Vec3 start_momentum_;
  double struck_at_ = 0;  ///< displacement of the hammer's point at the start, downwards [m]
  double hammer_force_ = 0, hammer_displacement_ = 0;
  double hammer_work_ = 0;
  BranchLoss branch_loss_;
  /// A node of the tread whose speed makes the creepage.
  struct CreepageNode {
    std::int64_t slot;
    double angle;   ///< in the wheel [rad]
    double radius;  ///< [m]
  };
  std::vector<CreepageNode> creepage_nodes_;
  std::optional<SurfaceFields> surface_;
  std::optional<RailLine> rail_line_;

  Sample sample_;
  double kinetic_before_ = 0;
  EnergyWatch energy_watch_;
};

}  // namespace tread
