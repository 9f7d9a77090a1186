#include "drivers/energy_watch.hpp"

#include <algorithm>
#include <cmath>

#include "drivers/simulation.hpp"

namespace tread {

namespace {

/// Rounding and re-anchoring leave less than these shares of the travelling bodies' energies.
constexpr double kKineticFloor = 1e-6;
constexpr double kGravityFloor = 1e-9;

double total_of(const EnergyLedger& e, double kinetic) {
  return kinetic + e.strain + e.connectors + e.penalty + e.gravity + e.frictional_work + e.connector_loss +
         e.damping_loss - e.torque_work;
}

}  // namespace

void EnergyWatch::start(const EnergyLedger& energy, double kinetic, double elastic_kinetic) {
  total_ = total_of(energy, kinetic);
  kinetic_ = kinetic;
  gravity_ = energy.gravity;
  stored_ = elastic_kinetic + energy.strain + energy.connectors + energy.penalty;
}

bool EnergyWatch::sound(const EnergyLedger& energy, double kinetic) {
  slowed_ = std::max(slowed_, kinetic_ - kinetic);
  fallen_ = std::max(fallen_, gravity_ - energy.gravity);
  driven_ = std::max(driven_, std::abs(energy.torque_work));
  supplied_ =
      stored_ + slowed_ + fallen_ + driven_ + kKineticFloor * kinetic_ + kGravityFloor * std::abs(gravity_);
  missed_ = total_of(energy, kinetic) - total_;
  return std::abs(missed_) <= supplied_;  // false for what is not finite
}

}  // namespace tread
