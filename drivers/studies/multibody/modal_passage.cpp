#include "drivers/studies/multibody/modal_passage.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "core/error.hpp"

namespace tread {

ModalPassage::ModalPassage(const ModalTrack& track, const BeamVehicle& vehicle, double x, double dt,
                           const ModalWheel& wheel)
    : track_(&track), vehicle_(vehicle), dt_(dt), modal_wheel_(wheel), waves_(2 * wheel.modes.size()) {
  if (vehicle.bending) throw std::logic_error("the wheel of a modal passage does not bend");
  state_ = track.static_state(x, vehicle.load());
  rate_.resize(state_.size());
  acceleration_.resize(state_.size());
  before_.resize(state_.size());
  shape_.resize(state_.size());
  scratch_.resize(track.supports());
  // The contact's law gives the height of the wheel.
  double modal = 0;
  track.head_shapes(x, shape_);
  for (std::size_t i = 0; i < state_.size(); ++i) modal += shape_[i] * state_[i];
  wheel_.z = modal + flexibility(x) * vehicle.load() + std::pow(vehicle.load() / vehicle.contact, 2.0 / 3);
  for (std::size_t k = 0; k < wheel.modes.size(); ++k) {
    const WheelMode& mode = wheel.modes[k];
    waves_[2 * k].z = mode.amplitude * vehicle.load() / (mode.omega * mode.omega);
    wheel_.z += mode.amplitude * waves_[2 * k].z;
  }
  rest_ = wheel_.z;
  sprung_.z = wheel_.z + vehicle.static_stretch();
  accelerate(x, 0, {});
}

void ModalPassage::Mass::move(double dt, double blend) {
  z += dt * rate + dt * dt * ((0.5 + blend) * acceleration - blend * before);
  rate += dt * ((1 + blend) * acceleration - blend * before);
  before = acceleration;
}

void ModalPassage::step(double x, double roughness, const ContactRelief& relief) {
  const double blend = std::exchange(first_, false) ? 0 : 0.5;  // psi and phi
  const double now = dt_ * dt_ * (0.5 + blend);
  const double then = dt_ * dt_ * blend;
  for (std::size_t i = 0; i < state_.size(); ++i) {
    state_[i] += dt_ * rate_[i] + now * acceleration_[i] - then * before_[i];
    rate_[i] += dt_ * ((1 + blend) * acceleration_[i] - blend * before_[i]);
  }
  before_.swap(acceleration_);
  wheel_.move(dt_, blend);
  sprung_.move(dt_, blend);
  for (Mass& wave : waves_) wave.move(dt_, blend);
  time_ += dt_;
  accelerate(x, roughness, relief);
  if (!std::isfinite(force_) || !(std::abs(wheel_.z - rest_) <= 1))
    throw NumericalError(
        fmt::format("the multi-body model became unstable at x = {:.4f} m with a step of {:.3e} s; state a "
                    "smaller one with --step, or fewer modes",
                    x, dt_));
}

namespace {

/// Solves approach = (F / C)^(2/3) + flexibility F + relief for F > 0 by Newton's method; 0 without contact.
double contact_force(double approach, double contact, double flexibility, const ContactRelief& relief) {
  if (approach <= relief.at(0)) return 0;
  const double hertz = std::pow(contact, -2.0 / 3);
  double s = std::max(0.0, approach - relief.at(0)) / hertz;  // F^(2/3), from above
  for (int i = 0; i < 50; ++i) {
    const double root = std::sqrt(s);
    double value = hertz * s + flexibility * s * root;
    double slope = hertz + 1.5 * flexibility * root;
    if (relief.pitch > 0) {
      const auto [more, steeper] = relief.value(s);
      value += more;
      slope += steeper;
    }
    const double next = std::max(0.0, s - (value - approach) / slope);
    const double change = next - s;
    s = next;
    if (std::abs(change) <= 1e-14 * s) break;
  }
  return s * std::sqrt(s);
}

}  // namespace

void ModalPassage::accelerate(double x, double roughness, const ContactRelief& relief) {
  track_->head_shapes(x, shape_);
  double modal = 0;
  for (std::size_t i = 0; i < state_.size(); ++i) modal += shape_[i] * state_[i];
  double bent = 0;
  for (std::size_t k = 0; k < modal_wheel_.modes.size(); ++k)
    bent += modal_wheel_.modes[k].amplitude * waves_[2 * k].z;
  force_ = contact_force(wheel_.z - bent - modal - roughness, vehicle_.contact, flexibility(x), relief);
  rail_ = modal + track_->flexibility(x) * force_;

  for (std::size_t i = 0; i < state_.size(); ++i)
    acceleration_[i] = force_ * shape_[i] - track_->omega()[i] * track_->omega()[i] * state_[i];
  track_->support_forces(state_, rate_, acceleration_, scratch_);

  const double suspension =
      vehicle_.stiffness * (wheel_.z - sprung_.z) + vehicle_.damping * (wheel_.rate - sprung_.rate);
  wheel_.acceleration = vehicle_.gravity + (vehicle_.pressed - force_ - suspension) / vehicle_.unsprung_mass;
  for (std::size_t k = 0; k < modal_wheel_.modes.size(); ++k) {
    const WheelMode& mode = modal_wheel_.modes[k];
    Mass& wave = waves_[2 * k];
    Mass& companion = waves_[2 * k + 1];
    const double square = mode.omega * mode.omega;
    const double coupling = 2 * modal_wheel_.spin * mode.turning;
    wave.acceleration = mode.amplitude * force_ - square * wave.z - coupling * companion.rate;
    companion.acceleration = coupling * wave.rate - square * companion.z;
  }
  sprung_.acceleration = vehicle_.sprung_mass > 0 ? vehicle_.gravity + suspension / vehicle_.sprung_mass : 0;
}

double passage_step(const ModalTrack& track, const BeamVehicle& vehicle, const ModalWheel& wheel) {
  // The estimate takes the contact at ten times the static load, on the wheel and on the beam where its modes
  // add up.
  const double approach = std::pow(10 * vehicle.load() / vehicle.contact, 2.0 / 3);
  const double contact = 1.5 * vehicle.contact * std::sqrt(approach);
  std::vector<double> shape(track.coordinates());
  track.head_shapes(track.left(), shape);
  double mobility = 1 / vehicle.unsprung_mass;
  for (const double value : shape) mobility += 0.5 * value * value;  // at the end cos^2 = 1, elsewhere half
  for (const WheelMode& mode : wheel.modes) mobility += mode.amplitude * mode.amplitude;
  const double stiff = contact / (1 + contact * (track.flexibility(track.left()) + wheel.flexibility));
  const double top = *std::max_element(track.omega().begin(), track.omega().end());
  const double omega = std::sqrt(top * top + track.support_stiffness() + stiff * mobility);
  return 0.5 / (0.5 * omega + track.support_damping());
}

}  // namespace tread
