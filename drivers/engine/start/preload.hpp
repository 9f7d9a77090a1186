#pragma once
// Step 1: static equilibrium under gravity, spin and wheel load with contact, by Newton's method on the
// contact set. [theory.md, Preload]

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/aligned.hpp"
#include "core/body_frame.hpp"
#include "core/state_list.hpp"
#include "drivers/engine/model/model.hpp"
#include "drivers/engine/start/run_in.hpp"

namespace tread {

/// Motion whose steady inertia the static state carries: material passes through a deflection that stays
/// under the wheel. [theory.md, Preload]
struct SteadyMotion {
  double spin = 0;       ///< of the wheel: centrifugal force about the bent axle [rad/s]
  double speed = 0;      ///< of the deflection along the track [m/s]
  bool rolling = false;  ///< run in over the fastenings: the static state then has that contact force
  double traction = 0;   ///< F_L of the wheelset's torque over the static wheel load [-]
};

struct Preload {
  AlignedVector<double> displacement;  ///< secondary nodes filled [m]
  std::optional<RunIn> run_in;         ///< where SteadyMotion::rolling wants it
  BodyFrame wheel;                     ///< at the start, angle 0, at rest; origin on the undeformed axis
  double traction = 0;                 ///< shear stress over pressure in the patch [-]
  double free_spin = 0;  ///< with traction: of free rolling at the start, over speed / radius [rad/s]
  double residual = 0;   ///< 2-norm of the balanced residual / wheel load (or external load) [-]
  std::int64_t newton_iterations = 0;
  std::int64_t cg_iterations = 0;
  // Without traction:
  double held_force_x = 0;  ///< reaction of the held longitudinal motion of the wheel [N]
  double held_moment = 0;   ///< reaction of its held rotation about the axle [N m]
  // At rest, before any run-in:
  double tilt = 0;             ///< of the wheel about x, from the tread's mean [rad]
  double rail_tilt = 0;        ///< of the rail's head under the wheel about x [rad]
  double rail_deflection = 0;  ///< downwards, of the rail's foot under the wheel [m]
  double slab_deflection = 0;  ///< [m]
  ContactTotals contact;
  double max_pressure = 0;        ///< nodal average [Pa]
  double run_in_change = 0;       ///< RunIn::change of a start as after a long way [-]
  std::vector<double> rail_rise;  ///< RailLine::rise() through the patch's centre [m]; empty without contact

  /// Lists the values, fields aside, that are of use once rolling has begun.
  void list_state(StateList& list) {
    list.add("wheel_frame", wheel);
    list.add("traction", traction);
    list.add("free_spin", free_spin);
    list.add("residual", residual);
    list.add("newton_iterations", newton_iterations);
    list.add("cg_iterations", cg_iterations);
    list.add("held_force_x", held_force_x);
    list.add("held_moment", held_moment);
    list.add("tilt", tilt);
    list.add("rail_tilt", rail_tilt);
    list.add("rail_deflection", rail_deflection);
    list.add("slab_deflection", slab_deflection);
    list.add_records("contact", std::span(&contact, 1));
    list.add("max_pressure", max_pressure);
    list.add("run_in_change", run_in_change);
  }
};

/// y of the corrugation's deepest line; without corrugation it matters to nothing [m].
double deepest_line(const Scene& scene, const Preload& preload);

using ProgressText = std::function<void(const std::string&)>;

/// Motion that the scene starts with: speed / radius by its creepage, as far as it wants them in the static
/// state.
SteadyMotion steady_motion(const Model& model);

/// Throws NumericalError if Newton's method or the linear solver does not converge, InputError if the scene
/// moves and refuse_heavy_damping() refuses it.
Preload solve_preload(Model& model, const SteadyMotion& motion, const ProgressText& progress);

}  // namespace tread
