#include "drivers/engine/energy_watch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tread {

namespace {

/// Rounding and re-anchoring leave less than these shares of the travelling bodies' energies.
constexpr double kKineticFloor = 1e-6;
constexpr double kGravityFloor = 1e-9;

/// An oscillation of frequency w shows (w dt/2)^2 / (1 - (w dt/2)^2) times the energy that it has as excess,
/// twice that at its turning points: 98 times at 0.99 of the stable step.
constexpr double kLargestExcess = 100;

/// Work of all drives, each by its size [J].
double work_done(const EnergyLedger& energy) {
  double sum = 0;
  for (const EnergyKind& kind : kEnergyKinds)
    if (kind.role == EnergyRole::supplied) sum += std::abs(energy.*kind.member);
  return sum;
}

}  // namespace

void EnergyWatch::start(const EnergyLedger& energy, double excess, double elastic_kinetic) {
  started_ = 1;
  total_ = energy.total();
  excess_ = excess;
  kinetic_ = energy.kinetic + excess;
  gravity_ = energy.gravity;
  stored_ = elastic_kinetic + energy.strain + energy.connectors + energy.penalty;
}

bool EnergyWatch::balanced(const EnergyLedger& energy, double excess) {
  slowed_ = std::max(slowed_, kinetic_ - energy.kinetic - excess);
  fallen_ = std::max(fallen_, gravity_ - energy.gravity);
  driven_ = std::max(driven_, work_done(energy));
  supplied_ =
      stored_ + slowed_ + fallen_ + driven_ + kKineticFloor * kinetic_ + kGravityFloor * std::abs(gravity_);
  const double unbalanced = energy.total() - total_;
  const double oscillating = (excess - excess_) / kLargestExcess;
  if (!std::isfinite(unbalanced + excess)) {
    missed_ = share_ = std::numeric_limits<double>::infinity();
    return false;
  }
  const bool by_balance = std::abs(unbalanced) >= oscillating;
  missed_ = by_balance ? unbalanced : excess - excess_;
  const double judged = by_balance ? std::abs(unbalanced) : oscillating;
  share_ = judged == 0 ? 0 : judged / supplied_;
  // The first push of a load on bodies at rest supplies no energy yet.
  breaches_ = share_ <= 1 ? 0 : breaches_ + 1;
  return breaches_ < 2;
}

}  // namespace tread
