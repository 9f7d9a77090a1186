#include "drivers/studies/multibody/modal_passage.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "core/error.hpp"

namespace tread {

ModalTrack::ModalTrack(ModalBeam beam, const std::vector<BeamSupport>& supports,
                       const std::vector<FootSpring>& foot, const std::vector<SleeperSupport>& sleepers)
    : beam_(std::move(beam)), omega_(beam_.omega()) {
  const std::size_t modes = omega_.size();
  omega_.resize(modes + sleepers.size(), 0.0);
  std::vector<double> values(coordinates(), 0.0);
  const auto add = [&](double stiffness, double damping) {
    stiffness_.push_back(stiffness);
    damping_.push_back(damping);
    by_support_.insert(by_support_.end(), values.begin(), values.end());
  };
  for (const BeamSupport& s : supports) {
    beam_.shapes(s.x, values);
    add(s.stiffness, s.damping);
  }
  std::vector<double> there(modes);
  for (const FootSpring& s : foot) {
    std::fill(values.begin(), values.end(), 0.0);
    for (const auto& [x, weight] : s.places) {
      beam_.foot_shapes(x, there);
      for (std::size_t i = 0; i < modes; ++i) values[i] += weight * there[i];
    }
    add(s.stiffness, s.damping);
  }
  std::fill(values.begin(), values.end(), 0.0);
  for (std::size_t i = 0; i < sleepers.size(); ++i) {
    const SleeperSupport& s = sleepers[i];
    beam_.shapes(s.x, values);
    values[modes + i] = -1 / std::sqrt(s.sleeper.mass);
    add(s.stiffness, s.damping);
    std::fill(values.begin(), values.end(), 0.0);
    values[modes + i] = 1 / std::sqrt(s.sleeper.mass);
    add(s.sleeper.stiffness, s.sleeper.damping);
    values[modes + i] = 0;
  }
}

std::vector<double> ModalTrack::static_state(double x, double force) const {
  const std::size_t n = coordinates();
  const auto rows = static_cast<int>(n);
  BandMatrix<double> system(rows, rows - 1);
  for (std::size_t i = 0; i < n; ++i) {
    const int row = static_cast<int>(i);
    system.at(row, row) = omega_[i] * omega_[i];
    for (std::size_t s = 0; s < supports(); ++s) {
      const double* mode = by_support_.data() + s * n;
      for (std::size_t j = 0; j <= i; ++j)
        system.at(row, static_cast<int>(j)) += stiffness_[s] * mode[i] * mode[j];
    }
  }
  system.factorise();
  std::vector<double> load(n);
  beam_.head_shapes(x, load);
  for (double& value : load) value *= force;
  return system.solve(std::move(load));
}

void ModalTrack::support_forces(const std::vector<double>& state, const std::vector<double>& rate,
                                std::vector<double>& forces, std::vector<double>& scratch) const {
  const std::size_t n = state.size();
  for (std::size_t s = 0; s < supports(); ++s) {
    const double* mode = by_support_.data() + s * n;
    // Four sums run side by side: one alone would wait for every addition.
    double sum[4] = {0, 0, 0, 0};
    std::size_t i = 0;
    for (; i + 4 <= n; i += 4)
      for (std::size_t k = 0; k < 4; ++k)
        sum[k] += mode[i + k] * (stiffness_[s] * state[i + k] + damping_[s] * rate[i + k]);
    for (; i < n; ++i) sum[0] += mode[i] * (stiffness_[s] * state[i] + damping_[s] * rate[i]);
    scratch[s] = (sum[0] + sum[1]) + (sum[2] + sum[3]);
  }
  for (std::size_t s = 0; s < supports(); ++s) {
    const double* mode = by_support_.data() + s * n;
    const double force = scratch[s];
    for (std::size_t i = 0; i < n; ++i) forces[i] -= force * mode[i];
  }
}

/// Largest eigenvalue of the weighted sum of the supports' dyads, by power iteration.
double ModalTrack::largest(const std::vector<double>& weight) const {
  const std::size_t n = coordinates();
  // All modes start alike at the first support, so that the high ones take part.
  std::vector<double> vector(by_support_.begin(), by_support_.begin() + static_cast<std::ptrdiff_t>(n));
  double value = 0;
  for (int iteration = 0; iteration < 30; ++iteration) {
    std::vector<double> next(n);
    for (std::size_t s = 0; s < supports(); ++s) {
      const double* mode = by_support_.data() + s * n;
      double sum = 0;
      for (std::size_t i = 0; i < n; ++i) sum += mode[i] * vector[i];
      for (std::size_t i = 0; i < n; ++i) next[i] += weight[s] * sum * mode[i];
    }
    double norm = 0;
    for (const double v : next) norm += v * v;
    norm = std::sqrt(norm);
    if (norm == 0) return 0;
    value = norm;
    for (std::size_t i = 0; i < n; ++i) vector[i] = next[i] / norm;
  }
  return value;
}

double ModalTrack::support_stiffness() const {
  return supports() == 0 ? 0 : largest(stiffness_);
}

double ModalTrack::support_damping() const {
  return supports() == 0 ? 0 : largest(damping_);
}

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
  track.beam().head_shapes(x, shape_);
  for (std::size_t i = 0; i < state_.size(); ++i) modal += shape_[i] * state_[i];
  wheel_.z = modal + flexibility() * vehicle.load() + std::pow(vehicle.load() / vehicle.contact, 2.0 / 3);
  for (std::size_t k = 0; k < wheel.modes.size(); ++k) {
    const WheelMode& mode = wheel.modes[k];
    waves_[2 * k].z = mode.amplitude * vehicle.load() / (mode.omega * mode.omega);
    wheel_.z += mode.amplitude * waves_[2 * k].z;
  }
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
  if (!std::isfinite(force_) || std::abs(wheel_.z) > 1)
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
  const ModalBeam& beam = track_->beam();
  beam.head_shapes(x, shape_);
  double modal = 0;
  for (std::size_t i = 0; i < state_.size(); ++i) modal += shape_[i] * state_[i];
  double bent = 0;
  for (std::size_t k = 0; k < modal_wheel_.modes.size(); ++k)
    bent += modal_wheel_.modes[k].amplitude * waves_[2 * k].z;
  force_ = contact_force(wheel_.z - bent - modal - roughness, vehicle_.contact, flexibility(), relief);
  rail_ = modal + beam.residual_flexibility() * force_;

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
  const ModalBeam& beam = track.beam();
  // The estimate takes the contact at ten times the static load, on the wheel and on the beam where its modes
  // add up.
  const double approach = std::pow(10 * vehicle.load() / vehicle.contact, 2.0 / 3);
  const double contact = 1.5 * vehicle.contact * std::sqrt(approach);
  std::vector<double> shape(static_cast<std::size_t>(beam.modes()));
  beam.head_shapes(beam.left(), shape);
  double mobility = 1 / vehicle.unsprung_mass;
  for (const double value : shape) mobility += 0.5 * value * value;  // at the end cos^2 = 1, elsewhere half
  for (const WheelMode& mode : wheel.modes) mobility += mode.amplitude * mode.amplitude;
  const double stiff = contact / (1 + contact * (beam.residual_flexibility() + wheel.flexibility));
  const double top = *std::max_element(beam.omega().begin(), beam.omega().end());
  const double omega = std::sqrt(top * top + track.support_stiffness() + stiff * mobility);
  return 0.5 / (0.5 * omega + track.support_damping());
}

}  // namespace tread
