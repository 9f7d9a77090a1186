#include "drivers/engine/start/preload.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/parallel/chunks.hpp"
#include "core/parallel/parallel.hpp"
#include "drivers/engine/model/attachments.hpp"
#include "drivers/engine/model/rail_foot.hpp"
#include "drivers/engine/start/moving_deflection.hpp"
#include "drivers/engine/start/poses.hpp"
#include "drivers/engine/start/static_loads.hpp"
#include "drivers/engine/start/static_system.hpp"
#include "drivers/engine/start/step_limit.hpp"
#include "drivers/engine/start/traction.hpp"
#include "kernels/contact/rail_line.hpp"
#include "kernels/solver/two_level_preconditioner.hpp"

namespace tread {

namespace {

/// The wheel's translation along x and rotation about the axle, held in the mass-weighted mean; without a
/// rail its height too.
std::optional<HeldMotions> held_wheel(const Model& model) {
  if (!model.wheelset || model.guide) return std::nullopt;
  std::vector<RigidMotion> motions = {{{1, 0, 0}, {}}, {{}, {0, 1, 0}}};
  if (!model.contact) motions.push_back({{0, 0, 1}, {}});
  return std::optional<HeldMotions>(std::in_place, model.mesh, model.wheelset->blocks(), model.mass.data(),
                                    std::move(motions));
}

/// Adds the carrier's unknown, which couples to the whole bore, to a preconditioner that does not know it.
class WithCarrier : public Preconditioner {
 public:
  WithCarrier(const Preconditioner& others, std::int64_t unknown, double stiffness)
      : others_(&others), unknown_(unknown), stiffness_(stiffness) {}
  void apply(const double* r, double* z) const override {
    others_->apply(r, z);
    z[unknown_] = r[unknown_] / stiffness_;
  }

 private:
  const Preconditioner* others_;
  std::int64_t unknown_;
  double stiffness_;  ///< [N/m]
};

/// Stiffness of the wheel's elements against the carrier's unknown alone [N/m].
double carrier_stiffness(const StaticSystem& system, std::int64_t values, std::int64_t unknown) {
  AlignedVector<double> unit(static_cast<std::size_t>(values), 0.0);
  AlignedVector<double> force(unit.size());
  unit[static_cast<std::size_t>(unknown)] = 1;
  system.apply(unit.data(), force.data());
  return force[static_cast<std::size_t>(unknown)];
}

/// Reason for which the bodies find no balance, and what helps.
std::string too_far(const Model& model) {
  return fmt::format(
      "under the wheel load of {:.4g} kN and the spin of this speed the bodies move too far for small "
      "strain, or points keep entering and leaving the patch; a lower load, speed or motion.creepage, a "
      "thicker wheel, a finer quality or a softer contact.penetration_ratio helps",
      1e-3 * model.wheel_load());
}

/// Reason for a failure of Newton's method; `residual`: norm of the unbalanced force, `size`: norm of the
/// external load [N].
std::string why_unbalanced(const Model& model, double residual, double size) {
  constexpr double kRounding = 1e-8;  // of forces that cancel inside the bodies
  if (residual < kRounding * size)
    return fmt::format(
        "the wheel load of {:.3g} N is lost in the rounding of the bodies' own forces; raise it, lower "
        "motion.speed or state motion.spin_in_preload = false",
        model.wheel_load());
  return too_far(model);
}

std::vector<TiedSlot> tied_slots(const Model& model) {
  return model.ties ? model.ties->tied_slots() : std::vector<TiedSlot>{};
}

/// Fills the figures of the static state.
void describe(const Model& model, Preload& out) {
  if (model.contact) {
    model.contact->require_room(out.wheel);
    out.contact = model.contact->totals();
    const SweptBlock& rail = model.mesh.blocks[static_cast<std::size_t>(model.index.rail_cap)];
    out.rail_rise = RailLine(rail, out.contact.centre.y).rise(out.displacement.data());
    out.max_pressure = model.contact->nodes().max_pressure();
  }
  const double* u = out.displacement.data();
  out.tilt = wheel_tilt(model, u, out.wheel.angle);
  const double x = out.wheel.origin.x;
  if (model.index.rail_cap >= 0 && model.index.tread >= 0) {
    out.rail_tilt = head_pose(model, u, x).roll;
    out.rail_deflection = -foot_of_rail(model.scene, model.mesh, model.index).attach_near(x, 0).value(u, 2);
  }
  if (model.index.slab >= 0)
    out.slab_deflection =
        -attach(model.mesh.blocks[static_cast<std::size_t>(model.index.slab)], "top", x, 0).value(u, 2);
}

}  // namespace

double deepest_line(const Scene& scene, const Preload& preload) {
  const double peak = preload.contact.pressure_peak.y;
  return scene.corrugation ? scene.corrugation->centre.value_or(peak) : peak;
}

SteadyMotion steady_motion(const Model& model) {
  SteadyMotion out;
  if (!model.scene.motion || !model.scene.wheel) return out;
  const MotionSpec& motion = *model.scene.motion;
  if (motion.spin_in_preload) out.spin = motion.speed / model.wheel_radius() * motion.spin_ratio();
  if (model.scene.start() == "moving") out.speed = motion.speed;
  out.rolling = model.scene.start() == "rolling" && motion.speed > 0;
  out.traction = steady_traction(model);
  return out;
}

namespace {

/// The equations of the static state and their tangent.
class Equilibrium {
 public:
  Equilibrium(Model& model, const SteadyMotion& motion)
      : model_(&model), motion_(motion), system_(model), held_(held_wheel(model)) {
    if (model.fastenings) fixed_springs_ = model.fastenings->springs();
  }

  /// r = external loads of the bodies, with those of `state.run_in` where there is one [N].
  void load(const Preload& state, double* r) const {
    std::fill_n(r, 3 * model_->mesh.slots, 0.0);
    add_load(state, r);
    finish(state, r);
  }

  /// r = loads less internal forces, balanced by the holding forces, which `state` takes over; finds contact
  /// and tangent at the displacement, whose secondary nodes are filled. [N]
  void residual(Preload& state, double* r);

  /// Product with the tangent at the last residual(). [N]
  void apply_tangent(double* x, double* y) const {
    system_.apply(x, y);
    add_springs(springs_, x, y);
  }
  const StaticSystem& system() const { return system_; }
  const std::vector<Spring>& springs() const { return springs_; }
  const HeldMotions* held() const { return held_ ? &*held_ : nullptr; }

 private:
  void add_load(const Preload& state, double* r) const {
    add_external_load(*model_, state.wheel, motion_.spin, r);
    if (state.run_in) add_run_in(*model_, *state.run_in, state.wheel, r);
    if (state.traction != 0) add_traction(*model_, motion_.traction, state.wheel, r);
  }
  void finish(const Preload& state, double* r) const {
    system_.reduce(r);
    add_carrier_load(*model_, state.wheel, motion_.spin, r);
  }

  Model* model_;
  SteadyMotion motion_;
  StaticSystem system_;
  std::optional<HeldMotions> held_;
  std::vector<Spring> fixed_springs_, springs_;
};

void Equilibrium::residual(Preload& state, double* r) {
  double* u = state.displacement.data();
  const auto n = static_cast<std::int64_t>(state.displacement.size());
  system_.expand(u);
  springs_ = fixed_springs_;
  model_->internal_force(u, r);
  add_springs(fixed_springs_, u, r);
  if (model_->contact) {
    model_->contact->find_static({u, nullptr, &state.wheel}, state.traction);
    model_->contact->add_forces(r);
    for (Spring& spring : model_->contact->springs()) springs_.push_back(std::move(spring));
  }
  for_chunks(n, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i) r[i] = -r[i];
  });
  add_load(state, r);
  add_steady_inertia(*model_, motion_.speed, motion_.spin, u, r);
  finish(state, r);
  if (!held_) return;
  if (state.traction == 0) {  // else they are the inertia of the wheel that it speeds up
    const auto work = held_->work(r);
    state.held_force_x = work[0];
    state.held_moment = work[1];
  }
  held_->balance(r);
}

/// "; or the depths of surface.a keep the bodies apart: ..." where the scene has such, else "".
std::string apart_by_depths(const Scene& scene) {
  std::vector<std::string> names;
  for (const auto& [name, surface] : scene.surfaces) names.push_back("surface." + name);
  if (names.empty()) return "";
  return fmt::format(
      "; or the depths of {} keep rail and wheel apart: state smaller or longer ones, or another place",
      fmt::join(names, ", "));
}

/// Throws NumericalError if no point is in contact. `size`: norm of the load [N].
void require_contact(const Model& model, int iteration, double residual, double size) {
  if (!model.contact || !model.contact->points().empty()) return;
  throw NumericalError(
      iteration == 0
          ? fmt::format(
                "preload: no integration point of the rail touches the wheel; check "
                "wheel.lateral_offset; if the patch under the wheel load of {1:.3g} N is smaller than an "
                "element, state a scene.element_size below {0:.3g} mm or a larger load{2}",
                1e3 * model.sizes.contact, model.wheel_load(), apart_by_depths(model.scene))
          : fmt::format("preload: after {} iterations no point of the wheel touches the rail: {}", iteration,
                        why_unbalanced(model, residual, size)));
}

/// Solves with the tangent of an Equilibrium.
class TangentSolver {
 public:
  TangentSolver(const Model& model, const Equilibrium& equilibrium)
      : model_(&model),
        equilibrium_(&equilibrium),
        two_level_(
            model.mesh, [&](double* x, double* y) { equilibrium.system().apply(x, y); },
            equilibrium.system().diagonal(), tied_slots(model)) {
    if (model.guide)
      with_carrier_.emplace(
          two_level_, model.guide->unknown(),
          carrier_stiffness(equilibrium.system(), 3 * model.mesh.slots, model.guide->unknown()));
  }

  /// Moves u until the linear system leaves no more than `tolerance` of `residual`; returns the iterations
  /// that took.
  int correct(double tolerance, AlignedVector<double>& residual, AlignedVector<double>& u) {
    const Operator tangent = [this](double* x, double* y) { equilibrium_->apply_tangent(x, y); };
    const Preconditioner* preconditioner = &two_level_;
    if (with_carrier_) preconditioner = &*with_carrier_;
    two_level_.update(tangent, equilibrium_->springs());
    const CgResult solved = conjugate_gradients(tangent, preconditioner, equilibrium_->held(), residual, u,
                                                {tolerance, 5000}, vectors_);
    if (!solved.converged)
      throw NumericalError(fmt::format("preload: the linear solver stalled at {:.2e} after {} iterations: {}",
                                       solved.residual_history.back() / solved.residual_history.front(),
                                       solved.iterations, too_far(*model_)));
    return solved.iterations;
  }

 private:
  const Model* model_;
  const Equilibrium* equilibrium_;
  TwoLevelPreconditioner two_level_;
  std::optional<WithCarrier> with_carrier_;
  CgVectors vectors_;
};

/// Newton's method on the equations of an Equilibrium.
class NewtonSolver {
 public:
  /// `size`: norm of the load [N]
  NewtonSolver(const Model& model, Equilibrium& equilibrium, double size, const ProgressText& progress)
      : model_(&model),
        equilibrium_(&equilibrium),
        progress_(&progress),
        size_(size),
        scale_(model.wheel_load() > 0 ? model.wheel_load() : size),
        solver_(model, equilibrium) {}

  /// Moves the state until it is balanced. `residual`: room for 3 * mesh.slots values. Throws NumericalError
  /// without convergence.
  void balance(Preload& state, AlignedVector<double>& residual) {
    constexpr int kMaxNewton = 40;
    for (int corrections = 0;; ++corrections) {
      look_at(state, residual);
      if (state.residual < kTolerance) return;
      if (corrections == kMaxNewton)
        throw NumericalError(fmt::format(
            "preload: residual {:.2e} of the load after {} iterations (wanted {:.0e}): {}", state.residual,
            corrections, kTolerance, why_unbalanced(*model_, state.residual * scale_, size_)));
      correct(state, residual);
    }
  }

 private:
  static constexpr double kTolerance = 1e-7;

  void look_at(Preload& state, AlignedVector<double>& residual) {
    equilibrium_->residual(state, residual.data());
    require_contact(*model_, iteration_, state.residual * scale_, size_);
    const auto n = static_cast<std::int64_t>(residual.size());
    state.residual = std::sqrt(dot(n, residual.data(), residual.data())) / scale_;
    const Contact* contact = model_->contact.get();
    (*progress_)(fmt::format("iteration {}, residual {:.2e}, {} points in contact, F_N {:.3f} kN", iteration_,
                             state.residual, contact ? contact->points().size() : 0,
                             contact ? -1e-3 * contact->totals().force_on_rail.z : 0.0));
    state.newton_iterations = iteration_++;
  }

  void correct(Preload& state, AlignedVector<double>& residual) {
    // Linear systems are solved to this share of their right sides: the more roughly, the less the last
    // iteration gained. At 0.5 points keep entering and leaving the patch.
    constexpr double kForcing = 0.03, kRoughly = 0.1;
    // The tangent of bodies that rotate is not exact: a step gains a digit or two however well it is solved.
    const double forcing = std::clamp(0.5 * state.residual / before_, kForcing, kRoughly);
    before_ = state.residual;
    const double wanted = std::max(0.3 * kTolerance, forcing * state.residual);
    state.cg_iterations += solver_.correct(wanted * scale_, residual, state.displacement);
  }

  const Model* model_;
  Equilibrium* equilibrium_;
  const ProgressText* progress_;
  double size_;
  double scale_;  ///< of residuals [N]
  TangentSolver solver_;
  double before_ = 1;  ///< residual of the last iteration
  int iteration_ = 0;  ///< of all states that were balanced
};

/// Bodies without strain. The undeformed surfaces overlap by about the Hertz patch when they are half the
/// approach into each other.
Preload undeformed_state(const Model& model) {
  Preload out;
  out.displacement.assign(static_cast<std::size_t>(3 * model.mesh.slots), 0.0);
  out.wheel.origin.x = model.scene.start_x();
  if (!model.contact) return out;
  const double overlap = 0.6 * model.scale_patch().approach;
  const Corrugation& corrugation = model.contact->corrugation();
  const double depth = corrugation.depth(out.wheel.origin.x, corrugation.centre()) +
                       model.contact->touching_depth(out.wheel.origin.x);
  out.wheel.origin.z = model.contact->touching_height() - depth - overlap;
  return out;
}

/// Adds the loads of rolling to those at rest, under which `state` is balanced.
void add_rolling(const Model& model, const SteadyMotion& motion, Preload& state) {
  if (motion.rolling) {
    state.run_in = run_in(model, axle_bending(model, state.displacement.data(), state.wheel));
    state.run_in_change = state.run_in->change;
  }
  if (motion.traction != 0)
    state.free_spin = free_spin(model, state.displacement, state.wheel, model.scene.motion->speed);
  // F_L stays where the fastenings change F_N.
  state.traction = motion.traction * (state.run_in ? model.wheel_load() / state.run_in->force : 1);
  require_grip(model, state.traction);
}

}  // namespace

Preload solve_preload(Model& model, const SteadyMotion& motion, const ProgressText& progress) {
  if (model.scene.motion) refuse_heavy_damping(model);
  const auto n = 3 * model.mesh.slots;
  Preload out = undeformed_state(model);
  Equilibrium equilibrium(model, motion);
  AlignedVector<double> residual(static_cast<std::size_t>(n));
  equilibrium.load(out, residual.data());
  const double size = std::sqrt(dot(n, residual.data(), residual.data()));
  if (size == 0) return out;  // no load: the bodies stay undeformed

  NewtonSolver newton(model, equilibrium, size, progress);
  newton.balance(out, residual);
  describe(model, out);
  if (!motion.rolling && motion.traction == 0) return out;
  add_rolling(model, motion, out);
  newton.balance(out, residual);
  return out;
}

}  // namespace tread
