#include "drivers/multibody/modal_beam.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace tread {

ModalBeam::ModalBeam(const BeamProperties& properties, double left, double length, int modes)
    : left_(left), length_(length) {
  if (modes < 2) throw std::logic_error("a modal beam needs two modes");
  const BeamProperties& p = properties;
  const bool shears = p.shear_stiffness > 0;
  omega_.push_back(0);
  amplitude_.push_back(1 / std::sqrt(p.mass * length));
  for (int n = 1; n < modes; ++n) {
    const double k = n * std::numbers::pi / length;
    const double omega = 2 * std::numbers::pi * wave_frequency(p, k);
    // Rotation over deflection of the wave.
    const double turn = shears ? k - p.mass * omega * omega / (p.shear_stiffness * k) : k;
    const double mass = 0.5 * length * (p.mass + p.rotary_inertia * turn * turn);
    omega_.push_back(omega);
    amplitude_.push_back(1 / std::sqrt(mass));
    // Half the peak of each harmonic: the mean over the beam.
    const double bent = 1 / (p.bending_stiffness * k * k * k * k);
    const double sheared = shears ? 1 / (p.shear_stiffness * k * k) : 0;
    residual_ += (bent + sheared) / length - 0.5 / (mass * omega * omega);
  }
  // Harmonics beyond the last mode, sums of 1 / n^4 and 1 / n^2 by the midpoint rule.
  const double next = modes - 0.5;
  const double first = length / std::numbers::pi;
  residual_ += std::pow(first, 4) / (p.bending_stiffness * length * 3 * next * next * next);
  if (shears) residual_ += first * first / (p.shear_stiffness * length * next);
}

void ModalBeam::shapes(double x, std::vector<double>& values) const {
  // cos((n + 1) a) = 2 cos(a) cos(n a) - cos((n - 1) a)
  const double angle = std::numbers::pi * (x - left_) / length_;
  const double twice = 2 * std::cos(angle);
  double before = 0.5 * twice;
  double now = 1;
  for (std::size_t n = 0; n < omega_.size(); ++n) {
    values[n] = amplitude_[n] * now;
    const double next = twice * now - before;
    before = now;
    now = next;
  }
}

int modes_below(const BeamProperties& properties, double length, double frequency) {
  return 1 + static_cast<int>(wave_number(properties, frequency) * length / std::numbers::pi);
}

}  // namespace tread
