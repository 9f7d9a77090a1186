#include "drivers/studies/multibody/modal_beam.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace tread {

ModalBeam::ModalBeam(const BeamProperties& properties, double left, double length, int modes, double spread,
                     Foot foot)
    : left_(left), length_(length) {
  const BeamProperties& p = properties;
  if (modes < 2) throw std::logic_error("a modal beam needs two modes");
  if (foot == Foot::moves && !(p.has_foot() && p.shear_stiffness > 0))
    throw std::logic_error("only a Timoshenko beam has a foot that moves along");
  const bool shears = p.shear_stiffness > 0;
  const double rigid = 1 / std::sqrt(p.mass * length);
  add({0, 0, rigid, rigid, 0});
  const auto wave_number = [&](int n) { return n * std::numbers::pi / length; };
  const auto share = [&](int n) { return std::exp(-0.5 * std::pow(wave_number(n) * spread, 2)); };
  // Each harmonic counts with half its peak, the mean over the beam. The omitted harmonics add less than a
  // thousandth of a contact's flexibility.
  constexpr int kHarmonics = 10000;
  constexpr double kOfAMetre = 650;
  const int harmonics = std::max({modes, kHarmonics, static_cast<int>(kOfAMetre * length)});
  for (int n = 1; n < harmonics; ++n) {
    const double k = wave_number(n);
    const double bent = 1 / (p.bending_stiffness * k * k * k * k);
    const double sheared = shears ? 1 / (p.shear_stiffness * k * k) : 0;
    residual_ += share(n) * share(n) * (bent + sheared) / length;
    if (n < modes) add_bending(p, n, 2 * std::numbers::pi * wave_frequency(p, k), share(n));
  }
  if (foot == Foot::still) return;
  const double top = omega_.back();
  const double lever = p.foot * p.foot / p.bending_stiffness;
  foot_residual_.resize(static_cast<std::size_t>(harmonics));
  for (int n = 1; n < harmonics; ++n) {
    const double k = wave_number(n);
    foot_residual_[static_cast<std::size_t>(n)] = (1 / p.axial_stiffness + lever) / (k * k * length);
    const double upper = 2 * std::numbers::pi * upper_wave_frequency(p, k);
    if (upper <= top) add_bending(p, n, upper, share(n));
  }
  for (int n = 1; n < harmonics; ++n) {
    const double omega = wave_number(n) * std::sqrt(p.axial_stiffness / p.mass);
    if (omega > top) break;
    add({n, omega, 0, 0, 1 / std::sqrt(0.5 * length * p.mass)});
  }
  for (std::size_t i = 1; i < mode_.size(); ++i)
    foot_residual_[static_cast<std::size_t>(mode_[i].harmonic)] -=
        0.5 * mode_[i].foot * mode_[i].foot / (omega_[i] * omega_[i]);
}

double ModalBeam::foot_residual_flexibility(double distance) const {
  double sum = 0;
  for (std::size_t n = 0; n < foot_residual_.size(); ++n)
    sum += foot_residual_[n] * std::cos(static_cast<double>(n) * std::numbers::pi * distance / length_);
  return sum;
}

ModalBeam::ModalBeam(double left, double length, Modes modes)
    : left_(left),
      length_(length),
      residual_(modes.residual),
      foot_residual_(std::move(modes.foot_residual)) {
  for (const BeamMode& mode : modes.modes) add(mode);
}

void ModalBeam::add(const BeamMode& mode) {
  omega_.push_back(mode.omega);
  mode_.push_back(mode);
}

void ModalBeam::add_bending(const BeamProperties& p, int harmonic, double omega, double share) {
  const double k = harmonic * std::numbers::pi / length_;
  // Ratio of the wave's rotation to its deflection.
  const double turn = p.shear_stiffness > 0 ? k - p.mass * omega * omega / (p.shear_stiffness * k) : k;
  const double mass = 0.5 * length_ * (p.mass + p.rotary_inertia * turn * turn);
  const double amplitude = 1 / std::sqrt(mass);
  const double foot = p.foot * turn + p.foot_warping * (k - turn);
  add({harmonic, omega, amplitude, share * amplitude, foot * amplitude});
  residual_ -= 0.5 * share * share / (mass * omega * omega);
}

void ModalBeam::values_at(double x, double BeamMode::*amplitude, std::vector<double>& values) const {
  // cos((n + 1) a) = 2 cos(a) cos(n a) - cos((n - 1) a), begun again with each family of modes
  const double angle = std::numbers::pi * (x - left_) / length_;
  const double twice = 2 * std::cos(angle);
  double before = 0;
  double now = 0;
  int harmonic = -2;
  for (std::size_t i = 0; i < mode_.size(); ++i) {
    const BeamMode& mode = mode_[i];
    if (mode.harmonic != harmonic + 1) {
      before = std::cos((mode.harmonic - 1) * angle);
      now = std::cos(mode.harmonic * angle);
    } else {
      const double next = twice * now - before;
      before = now;
      now = next;
    }
    harmonic = mode.harmonic;
    values[i] = mode.*amplitude * now;
  }
}

void ModalBeam::foot_shapes(double x, std::vector<double>& values) const {
  const double angle = std::numbers::pi * (x - left_) / length_;
  for (std::size_t i = 0; i < mode_.size(); ++i)
    values[i] = mode_[i].foot * std::sin(mode_[i].harmonic * angle);
}

int modes_below(const BeamProperties& properties, double length, double frequency) {
  return 1 + static_cast<int>(wave_number(properties, frequency) * length / std::numbers::pi);
}

}  // namespace tread
