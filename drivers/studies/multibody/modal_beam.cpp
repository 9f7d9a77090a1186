#include "drivers/studies/multibody/modal_beam.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace tread {

ModalBeam::ModalBeam(const BeamProperties& properties, double left, double length, int modes, double spread)
    : left_(left), length_(length) {
  if (modes < 2) throw std::logic_error("a modal beam needs two modes");
  const BeamProperties& p = properties;
  const bool shears = p.shear_stiffness > 0;
  omega_.push_back(0);
  amplitude_.push_back(1 / std::sqrt(p.mass * length));
  head_amplitude_ = amplitude_;
  // Each harmonic counts with half its peak, the mean over the beam. The omitted harmonics add less than a
  // thousandth of a contact's flexibility.
  constexpr int kHarmonics = 10000;
  for (int n = 1; n < std::max(modes, kHarmonics); ++n) {
    const double k = n * std::numbers::pi / length;
    const double share = std::exp(-0.5 * k * k * spread * spread);
    const double bent = 1 / (p.bending_stiffness * k * k * k * k);
    const double sheared = shears ? 1 / (p.shear_stiffness * k * k) : 0;
    residual_ += share * share * (bent + sheared) / length;
    if (n >= modes) continue;
    const double omega = 2 * std::numbers::pi * wave_frequency(p, k);
    // Ratio of the wave's rotation to its deflection.
    const double turn = shears ? k - p.mass * omega * omega / (p.shear_stiffness * k) : k;
    const double mass = 0.5 * length * (p.mass + p.rotary_inertia * turn * turn);
    omega_.push_back(omega);
    amplitude_.push_back(1 / std::sqrt(mass));
    head_amplitude_.push_back(share * amplitude_.back());
    residual_ -= 0.5 * share * share / (mass * omega * omega);
  }
}

void ModalBeam::shapes(double x, const std::vector<double>& amplitude, std::vector<double>& values) const {
  // cos((n + 1) a) = 2 cos(a) cos(n a) - cos((n - 1) a)
  const double angle = std::numbers::pi * (x - left_) / length_;
  const double twice = 2 * std::cos(angle);
  double before = 0.5 * twice;
  double now = 1;
  for (std::size_t n = 0; n < amplitude.size(); ++n) {
    values[n] = amplitude[n] * now;
    const double next = twice * now - before;
    before = now;
    now = next;
  }
}

int modes_below(const BeamProperties& properties, double length, double frequency) {
  return 1 + static_cast<int>(wave_number(properties, frequency) * length / std::numbers::pi);
}

}  // namespace tread
