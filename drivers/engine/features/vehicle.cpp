#include "drivers/engine/features/vehicle.hpp"

namespace tread {

Vehicle::Vehicle(const VehicleSpec& spec, const Journal& journal, double gravity)
    : journal_(&journal),
      unsprung_mass_(spec.unsprung_mass),
      carried_mass_(spec.mass_along() - spec.unsprung_mass),
      gravity_(gravity) {
  sprung_.mass = spec.sprung_mass;
  sprung_.stiffness = spec.suspension_stiffness;
  sprung_.damping = spec.suspension_damping;
  sprung_.free_length_height = sprung_.mass * gravity / sprung_.stiffness;
}

std::vector<PhaseInfo> Vehicle::phases() const {
  return {{StepPhase::suspension,
           "sprung mass and journal",
           {RunField::journal_nodes, RunField::displacement, RunField::velocity, RunField::wheel_frame},
           {RunField::force, RunField::sprung_mass}},
          {StepPhase::unsprung_mass,
           "journal",
           {RunField::journal_nodes, RunField::force, RunField::wheel_frame},
           {RunField::force, RunField::sprung_mass}}};
}

std::vector<FieldBytes> Vehicle::fields() const {
  return {{RunField::journal_nodes, journal_->bytes()},
          {RunField::sprung_mass, static_cast<std::int64_t>(sizeof(SprungMass))}};
}

void Vehicle::apply(StepPhase phase, StepState& step) {
  if (phase == StepPhase::suspension)
    apply_suspension(step);
  else
    add_carried_masses(step);
}

void Vehicle::apply_suspension(StepState& step) {
  const double height = step.wheel.origin.z + journal_->displacement(step.displacement, step.wheel).z;
  const double speed = journal_->velocity(step.displacement, step.velocity, step.wheel).z;
  const double up = sprung_.force(height, speed);
  journal_->add(step.force, step.wheel, {0, 0, up});
  const double rate = sprung_.speed - speed;
  sprung_.dissipated += sprung_.damping * rate * rate * step.dt;
  sprung_.advance(up, gravity_, step.dt);
}

/// The unsprung mass shares the journal's acceleration, a carried sprung mass that along x; gravity and spin
/// terms come with the update. [theory.md, eq. 8]
void Vehicle::add_carried_masses(StepState& step) {
  const Vec3 alone = journal_->acceleration(step.force, step.wheel);
  const auto share = [&](double mass) { return journal_->mass() / (journal_->mass() + mass); };
  const double along = unsprung_mass_ + carried_mass_;
  const Vec3 together{share(along) * alone.x, share(unsprung_mass_) * alone.y,
                      share(unsprung_mass_) * alone.z};
  journal_->add(step.force, step.wheel,
                {-along * together.x, -unsprung_mass_ * together.y, -unsprung_mass_ * together.z});
  sprung_.speed_along -= step.dt * together.x;
}

void Vehicle::begin(const Motion& motion, const SprungStart& start) {
  sprung_.height = (motion.wheel.origin + journal_->displacement(motion.displacement, motion.wheel)).z;
  sprung_.height -= start.drop;
  sprung_.speed = start.speed;
  sprung_.speed_along = journal_->velocity(motion.displacement, motion.velocity, motion.wheel).x;
}

void Vehicle::begin_sample(const StepState& step, Sample& sample) {
  const double rise = journal_->displacement(step.displacement, step.wheel).z;
  const double stretch = sprung_.height - step.wheel.origin.z - rise - sprung_.free_length_height;
  sample.energy.connectors += 0.5 * sprung_.stiffness * stretch * stretch;
  const double height = step.wheel.origin.z + rise;
  sample.energy.gravity += gravity_ * unsprung_mass_ * height + gravity_ * sprung_.mass * sprung_.height;
}

void Vehicle::end_sample(const StepState& /*step*/, Sample& sample) const {
  sample.energy.connector_loss += sprung_.dissipated;
}

void Vehicle::add_kinetic_energy(const Motion& motion, double& sum) const {
  const Vec3 v = journal_->velocity(motion.displacement, motion.velocity, motion.wheel);
  sum += 0.5 * unsprung_mass_ * dot(v, v) + 0.5 * sprung_.mass * sprung_.speed * sprung_.speed +
         0.5 * carried_mass_ * sprung_.speed_along * sprung_.speed_along;
}

void Vehicle::add_momentum(const Motion& motion, Vec3& sum) const {
  sum += unsprung_mass_ * journal_->velocity(motion.displacement, motion.velocity, motion.wheel);
  sum.x += carried_mass_ * sprung_.speed_along;
  sum.z += sprung_.mass * sprung_.speed;
}

}  // namespace tread
