#include "drivers/engine/beam/beam_passage.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numeric>
#include <utility>

namespace tread {

namespace {

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

}  // namespace

BeamPassage::BeamPassage(const TrackBeam& beam, const BeamVehicle& vehicle, double x, double dt)
    : beam_(&beam), vehicle_(vehicle), dt_(dt), factor_(beam.stiffness()) {
  factor_.add(2 / dt, beam.damping());
  factor_.add(4 / (dt * dt), beam.mass());
  factor_.factorise();
  force_ = vehicle.load();
  u_ = beam.static_state(x, force_);
  v_.resize(u_.size());
  a_.resize(u_.size());
  rail_ = dot(beam.head_load(x), u_);
  approach_ = std::pow(force_ / vehicle.contact, 2.0 / 3);
  wheel_[0] = rail_ + approach_;
  if (vehicle.bending)
    wheel_[1] = (vehicle.sprung_mass * vehicle.gravity + vehicle.pressed +
                 vehicle.bending->coupling * vehicle.gravity) /
                vehicle.bending->stiffness;
  wheel_[2] = wheel_[0] + wheel_[1] + vehicle.static_stretch();
  assemble_vehicle();
}

void BeamPassage::add_sprung_mass(double mass) {
  const double before = vehicle_.static_stretch();
  vehicle_.sprung_mass += mass;
  wheel_[2] += vehicle_.static_stretch() - before;
  assemble_vehicle();
}

void BeamPassage::move_sprung_mass(double lower, double faster) {
  wheel_[2] += lower;
  wheel_speed_[2] += faster;
}

double BeamPassage::suspension() const {
  return vehicle_.stiffness * (wheel_[2] - wheel_[0] - wheel_[1]) +
         vehicle_.damping * (wheel_speed_[2] - wheel_speed_[0] - wheel_speed_[1]);
}

void BeamPassage::assemble_vehicle() {
  const BeamVehicle::Bending bending = vehicle_.bending.value_or(BeamVehicle::Bending{});
  vehicle_mass_ = {{{vehicle_.unsprung_mass, bending.coupling, 0},
                    {bending.coupling, bending.mass, 0},
                    {0, 0, vehicle_.sprung_mass}}};
  const Three stretch = {1, vehicle_.bending ? 1.0 : 0.0, -1};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      const double both = stretch[i] * stretch[j];
      vehicle_damping_[i][j] = vehicle_.damping * both;
      vehicle_system_[i][j] = vehicle_.stiffness * both + 2 / dt_ * vehicle_damping_[i][j] +
                              4 / (dt_ * dt_) * vehicle_mass_[i][j];
    }
  vehicle_system_[1][1] += bending.stiffness;
  // Masses of zero do not move.
  for (std::size_t i = 0; i < 3; ++i)
    if (vehicle_mass_[i][i] == 0) {
      for (std::size_t j = 0; j < 3; ++j) vehicle_system_[i][j] = vehicle_system_[j][i] = 0;
      vehicle_system_[i][i] = 1;
    }
}

BeamPassage::Three BeamPassage::static_load() const {
  const double g = vehicle_.gravity;
  if (!vehicle_.bending) return {vehicle_.unsprung_mass * g + vehicle_.pressed, 0, vehicle_.sprung_mass * g};
  return {vehicle_.unsprung_mass * g + vehicle_.pressed, vehicle_.bending->coupling * g + vehicle_.pressed,
          vehicle_.sprung_mass * g};
}

namespace {

using Three = std::array<double, 3>;

Three times(const std::array<Three, 3>& matrix, const Three& x) {
  Three y{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) y[i] += matrix[i][j] * x[j];
  return y;
}

/// Solution of a symmetric positive definite system.
Three solve(std::array<Three, 3> a, Three b) {
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t i = k + 1; i < 3; ++i) {
      const double factor = a[i][k] / a[k][k];
      for (std::size_t j = k; j < 3; ++j) a[i][j] -= factor * a[k][j];
      b[i] -= factor * b[k];
    }
  for (std::size_t k = 3; k-- > 0;) {
    for (std::size_t j = k + 1; j < 3; ++j) b[k] -= a[k][j] * b[j];
    b[k] /= a[k][k];
  }
  return b;
}

/// Solves approach + flexibility C approach^1.5 = gap by Newton's method. [m, m/N, N/m^1.5]
double hertz_approach(double gap, double flexibility, double contact, double first_guess) {
  double d = first_guess;
  for (int i = 0; i < 50; ++i) {
    const double root = std::sqrt(std::max(d, 0.0));
    const double change =
        (d + flexibility * contact * root * root * root - gap) / (1 + 1.5 * flexibility * contact * root);
    d -= change;
    if (std::abs(change) < 1e-15) break;
  }
  return d;
}

}  // namespace

void BeamPassage::step(double x, double roughness) {
  const double h1 = 2 / dt_;
  const double h2 = 4 / (dt_ * dt_);
  // Beam without contact, and under a unit force at x.
  const std::size_t n = u_.size();
  std::vector<double> inertia(n), drag(n);
  for (std::size_t i = 0; i < n; ++i) {
    inertia[i] = h2 * u_[i] + 2 * h1 * v_[i] + a_[i];
    drag[i] = h1 * u_[i] + v_[i];
  }
  std::vector<double> load = beam_->mass().times(inertia);
  const std::vector<double> damped = beam_->damping().times(drag);
  for (std::size_t i = 0; i < n; ++i) load[i] += damped[i];
  const std::vector<double> head = beam_->head_load(x);
  std::vector<std::complex<double>> loads(n);
  for (std::size_t i = 0; i < n; ++i) loads[i] = {load[i], head[i]};
  const std::vector<std::complex<double>> both = factor_.solve(std::move(loads));
  std::vector<double> next(n), response(n);
  for (std::size_t i = 0; i < n; ++i) {
    next[i] = both[i].real();
    response[i] = both[i].imag();
  }

  // Vehicle without contact, and under a unit force on the wheel.
  Three inertia_of{}, drag_of{};
  for (std::size_t i = 0; i < 3; ++i) {
    inertia_of[i] = h2 * wheel_[i] + 2 * h1 * wheel_speed_[i] + wheel_acceleration_[i];
    drag_of[i] = h1 * wheel_[i] + wheel_speed_[i];
  }
  Three push = static_load();
  const Three accelerated = times(vehicle_mass_, inertia_of);
  const Three dragged = times(vehicle_damping_, drag_of);
  for (std::size_t i = 0; i < 3; ++i) push[i] += accelerated[i] + dragged[i];
  const Three free = solve(vehicle_system_, push);
  const Three pushed = solve(vehicle_system_, {-1, 0, 0});

  // approach = wheel - rail - roughness, both linear in the force.
  const double gap = free[0] - dot(head, next) - roughness;
  const double flexibility = dot(head, response) - pushed[0];
  approach_ = hertz_approach(gap, flexibility, vehicle_.contact, std::max(approach_, 1e-9));
  force_ = vehicle_.contact * std::pow(std::max(approach_, 0.0), 1.5);

  for (std::size_t i = 0; i < n; ++i) {
    next[i] += force_ * response[i];
    const double acceleration = h2 * (next[i] - u_[i]) - 2 * h1 * v_[i] - a_[i];
    v_[i] += 0.5 * dt_ * (a_[i] + acceleration);
    a_[i] = acceleration;
    u_[i] = next[i];
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const double moved = free[i] + force_ * pushed[i];
    const double acceleration = h2 * (moved - wheel_[i]) - 2 * h1 * wheel_speed_[i] - wheel_acceleration_[i];
    wheel_speed_[i] += 0.5 * dt_ * (wheel_acceleration_[i] + acceleration);
    wheel_acceleration_[i] = acceleration;
    wheel_[i] = moved;
  }
  rail_ = dot(head, u_);
  time_ += dt_;
}

}  // namespace tread
