#include "drivers/engine/start/traction.hpp"

#include <fmt/core.h>

#include <cmath>
#include <optional>

#include "core/error.hpp"
#include "drivers/engine/model/lateral_gap.hpp"
#include "kernels/half_space/half_space_steady.hpp"

namespace tread {

namespace {

/// Torque over radius and longitudinal force of a wheelset whose spin and speed grow together [-].
double spin_up(const Model& model) {
  if (model.guide) return 1;
  const std::optional<VehicleSpec>& vehicle = model.scene.vehicle;
  const double mass = model.wheelset->mass() + (vehicle ? vehicle->mass_along() : 0.0);
  const double radius = model.wheel_radius();
  return 1 + model.wheelset->inertia() / (mass * radius * radius);
}

/// Width of a patch whose length is that of a line contact [m]: of bodies that are parallel across, or that
/// end within the ellipse of their curvatures; otherwise 0.
double width_of_line(const Model& model) {
  if (model.line_width > 0) return model.line_width;
  const SurfacePair& surfaces = model.contact->surfaces();
  const double facing = lateral_gap(surfaces.rail_profile(), surfaces.wheel_profile()).facing;
  return model.hertz_patch.semi_axis_y > 0.5 * facing ? facing : 0;
}

}  // namespace

double full_torque(const Model& model) {
  const std::optional<MotionSpec>& motion = model.scene.motion;
  if (!motion || !model.wheelset) return 0;
  if (!motion->traction_mu) return motion->traction_torque.value_or(0);
  return *motion->traction_mu * model.wheel_load() * model.wheel_radius() * spin_up(model);
}

double full_traction(const Model& model) {
  const double torque = full_torque(model), load = model.wheel_load();
  return torque != 0 && load > 0 ? torque / (model.wheel_radius() * spin_up(model)) / load : 0;
}

void require_grip(const Model& model, double traction) {
  if (traction == 0) return;
  const double x = model.scene.start_x();
  const double friction = model.contact->friction_at_rest(x);
  constexpr double kRounding = 1e-9;
  if (std::abs(traction) >= friction * (1 - kRounding))
    throw InputError(fmt::format(
        "motion.traction.ramp = 0: the wheel would have long been rolling under F_L / F_N = {:.4g}, but the "
        "coefficient of friction is {:.4g} at x = {:.4g} m, where it starts: its patch would slide; state a "
        "smaller motion.traction.mu or torque, or a ramp above 0",
        traction, friction, x));
}

double steady_traction(const Model& model) {
  const std::optional<MotionSpec>& motion = model.scene.motion;
  const bool steady = motion && motion->ramp == 0 && motion->speed > 0 && model.scene.start() != "rigid";
  if (!steady || !model.contact || model.torque.empty()) return 0;
  const double traction = full_traction(model);
  require_grip(model, traction);
  return traction;
}

double start_creepage(const Model& model, double traction) {
  const double stated = model.scene.motion ? model.scene.motion->creepage : 0;
  if (stated != 0 || traction == 0) return stated;
  const double load = model.wheel_load();
  const double friction = model.contact->friction_at_rest(model.scene.start_x());
  if (const double width = width_of_line(model); width > 0) {
    const double sticking = std::sqrt(1 - std::abs(traction) / friction);  // part of the patch [Carter 1926]
    const double semi_axis =
        line_semi_axis(model.wheel_radius(), model.scene.elastic_pair().contact_modulus(), load / width);
    return std::copysign(friction * semi_axis / model.wheel_radius() * (1 - sticking), traction);
  }
  try {
    const half_space::SteadyCreepage steady =
        half_space::steady_creepage({model.scene.elastic_pair().alike(), model.wheel_radius(),
                                     model.hertz_radius_y, load, friction, std::abs(traction) * load});
    return std::copysign(steady.mean, traction);
  } catch (const NumericalError& error) {
    throw InputError(fmt::format(
        "motion.traction.ramp = 0: the creepage of a wheel that has long been rolling under F_L / F_N = "
        "{:.4g} on contact.friction = {:.4g} is not found ({}); state motion.creepage, a smaller "
        "motion.traction.mu or torque, or a ramp above 0",
        traction, friction, error.what()));
  }
}

}  // namespace tread
