#include "drivers/engine/features/wheel_rail_contact.hpp"

#include <cmath>

#include "drivers/engine/features/wheel_motion.hpp"

namespace tread {

std::vector<PhaseInfo> WheelRailContact::phases() const {
  return {{StepPhase::contact_search,
           "rail faces near the wheel",
           {RunField::displacement, RunField::velocity, RunField::wheel_frame},
           {RunField::contact_points}},
          {StepPhase::contact_tractions,
           "points of the patch",
           {RunField::mass, RunField::wheel_frame, RunField::contact_points},
           {RunField::contact_points, RunField::velocity, RunField::displacement}}};
}

std::vector<FieldBytes> WheelRailContact::fields() const {
  return {{RunField::contact_points, contact_->bytes(), true}};
}

void WheelRailContact::apply(StepPhase phase, StepState& step) {
  if (phase == StepPhase::contact_search)
    search(step);
  else
    add_tractions(step);
}

void WheelRailContact::search(const StepState& step) {
  if (!std::isfinite(step.wheel.origin.x)) step.end.stop();
  if (step.contact_beside)
    contact_->aim(step.wheel, step.dt);
  else
    contact_->search({step.displacement, step.velocity, &step.wheel}, step.time, step.dt);
}

void WheelRailContact::add_tractions(StepState& step) {
  if (!step.contact_beside) contact_->resolve({step.displacement, step.velocity, mass_}, step.wheel, step.dt);
  if (!contact_->settled() || contact_->point_at_the_end(step.wheel)) {
    step.end.stop_if_unstable();
    contact_->require_room(step.wheel);
    contact_->require_settled();
  }
  if (step.measured && step.whole.adds_forces()) contact_->add_forces(step.force);
  const Vec3 on_wheel = -contact_->totals().force_on_rail;
  step.impulse.total += step.dt * on_wheel;
  step.impulse.contact += step.dt * Vec3{std::abs(on_wheel.x), std::abs(on_wheel.y), std::abs(on_wheel.z)};
}

void WheelRailContact::meet(const StaticStart& start) {
  contact_->find_static({start.displacement, nullptr, &start.wheel}, start.traction);
  contact_->begin();
}

void WheelRailContact::end_sample(const StepState& step, Sample& sample) const {
  const ContactTotals& totals = contact_->totals();
  sample.energy.penalty = totals.penalty_energy;
  sample.energy.frictional_work = contact_->frictional_work();
  sample.energy.contact_loss = contact_->contact_loss();
  sample.vertical_force = -totals.force_on_rail.z;
  sample.longitudinal_force = -totals.force_on_rail.x;
  sample.lateral_force = -totals.force_on_rail.y;
  sample.patch_area = totals.area;
  sample.slip_area = totals.slip_area;
  sample.max_pressure = contact_->nodes().max_pressure();
  sample.max_shear = contact_->nodes().max_shear();
  sample.max_penetration = totals.max_penetration;
  const double speed = step.wheel.velocity.x;
  sample.spin_creepage = std::abs(speed) > kLeastSpeed ? -mean_normal().y * step.wheel.spin / speed : 0.0;
  sample.corrugation_depth = contact_->surfaces().depth_at(sample.wheel_x, patch_y_);
}

/// Pressure-weighted mean of the normals into the rail; zero without contact.
Vec3 WheelRailContact::mean_normal() const {
  Vec3 sum;
  double force = 0;
  for (const ContactPoint& point : contact_->points()) {
    sum += point.pressure * point.area * point.normal;
    force += point.pressure * point.area;
  }
  return force > 0 ? 1 / force * sum : Vec3{};
}

}  // namespace tread
