// Free bodies in a spinning frame: rigid rotation, drift, conservation, wobble. [theory.md, Body frames]

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <memory>
#include <numbers>
#include <vector>

#include "core/mesh/structured.hpp"
#include "kernels/blocks/internal_force.hpp"
#include "kernels/blocks/time_update.hpp"
#include "kernels/update/body_motion.hpp"
#include "kernels/update/node_motion_body.hpp"
#include "tests/measured.hpp"
#include "tests/swept_samples.hpp"

namespace tread {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr int kAnchorInterval = 256;

std::size_t index(std::int64_t i) {
  return static_cast<std::size_t>(i);
}

/// Section of a ring; one row or more of quads over p x r.
struct RingShape {
  double inner, outer, width;
  int rows, columns, around;
};

/// A free elastic ring, driven as the time step drives a wheel.
class FreeRing {
 public:
  explicit FreeRing(const RingShape& s) {
    mesh_.add(make_swept_block("ring", Sweep::revolved,
                               rectangle(-0.5 * s.width, 0.5 * s.width, s.columns, s.inner, s.outer, s.rows),
                               {samples::steel()}, 0.1, {{s.around, kTurn / s.around, 0}}));
    internal_ = std::make_unique<InternalForce>(mesh_);
    internal_->set_finite_rotation(0, true);
    mass_.assign(index(mesh_.slots), 0.0);
    internal_->lumped_mass(mass_.data());
    inverse_.assign(mass_.size(), 0.0);
    for (std::size_t i = 0; i < mass_.size(); ++i)
      if (mass_[i] > 0) inverse_[i] = 1 / mass_[i];
    body_ = SpinningBody(mesh_, {0}, mass_.data());
    u_.assign(index(3 * mesh_.slots), 0.0);
    w_ = force_ = u_;
    dt_ = 1.8 / internal_->max_frequency(0).omega;
  }

  void step() {
    internal_->internal_force(u_.data(), nullptr, force_.data());
    TimeUpdate(mesh_, inverse_.data()).move_all({dt_, 0, frame}, {u_.data(), w_.data(), force_.data()});
    frame.advance(dt_);
    if (++steps_ % kAnchorInterval == 0) anchor();
  }
  void anchor() { body_.anchor(u_.data(), w_.data(), frame, dt_); }

  /// Adds Cartesian velocities field(position relative to the axis) to the relative ones.
  template <class Field>
  void push(const Field& field) {
    each_node([&](std::int64_t slot, double phi, const Vec3& reference) {
      const Vec3 v = cartesian_to_cylindrical(phi, field(cylindrical_to_cartesian(phi, reference)));
      for (int c = 0; c < 3; ++c) w_[index(dof(slot, c))] += v[c];
    });
  }

  /// Calls visit(slot, space angle, (0, y, r)).
  template <class Visit>
  void each_node(const Visit& visit) const {
    samples::for_each_node(mesh_, [&](const SweptBlock& block, int node, int station, std::int64_t slot) {
      visit(slot, block.stations[index(station)] + frame.angle,
            Vec3{0, block.section.p[index(node)], block.section.q[index(node)]});
    });
  }
  Vec3 read(const AlignedVector<double>& field, std::int64_t slot) const {
    return {field[index(dof(slot, 0))], field[index(dof(slot, 1))], field[index(dof(slot, 2))]};
  }

  double energy() const {
    const DeformationEnergy elastic = internal_->energy(0, u_.data());
    return elastic.strain + elastic.hourglass + body_.kinetic_energy(u_.data(), w_.data(), frame);
  }

  /// Inertial angular momentum about the mass centre; positions at the half step of the velocities.
  Vec3 angular_momentum() const {
    BodyFrame half = frame;
    half.advance(-0.5 * dt_);
    const Vec3 centre = mass_centre();
    Vec3 sum;
    each_node([&](std::int64_t slot, double phi, const Vec3& reference) {
      const Vec3 w = read(w_, slot);
      const Vec3 arm = reference + read(u_, slot) - 0.5 * dt_ * w;
      const double phi_half = phi - 0.5 * dt_ * frame.spin;
      const Vec3 x = half.origin + cylindrical_to_cartesian(phi_half, arm) - centre;
      const Vec3 v = frame.velocity + cylindrical_to_cartesian(phi_half, w + spin_cross(frame.spin, arm));
      sum += mass_[index(slot)] * cross(x, v);
    });
    return sum;
  }
  Vec3 momentum() const { return body_.momentum(u_.data(), w_.data(), frame); }
  Vec3 mass_centre() const {
    return frame.origin + body_.mean_motion(u_.data(), w_.data(), frame).displacement;
  }

  /// Inertial tilt of the figure axis: its (z, x) components as a complex number, positive about +y.
  std::complex<double> figure_axis() const {
    // The mean of r u_y over the ring is that of a turned disc: u_y = -(n_x x + n_z z).
    Vec3 sum;
    each_node([&](std::int64_t slot, double phi, const Vec3& reference) {
      const Vec3 x = cylindrical_to_cartesian(phi, {0, 0, reference.z});
      sum += mass_[index(slot)] * read(u_, slot).y * x;
    });
    const double second = 0.5 * body_.inertia();
    return {-sum.z / second, -sum.x / second};
  }

  double largest_stress() const {
    double largest = 0;
    for (int station = 0; station < mesh_.blocks[0].station_count(); ++station)
      for (int quad = 0; quad < static_cast<int>(mesh_.blocks[0].section.quads.size()); ++quad)
        for (const double s : internal_->stress(0, quad, station, u_.data()))
          largest = std::max(largest, std::abs(s));
    return largest;
  }

  /// Computes u += dt w with the velocities of a rigid rotation at `spin`: chords of the true circles.
  void impose_rotation(double spin) {
    const double relative = (spin - frame.spin) * dt_;
    each_node([&](std::int64_t slot, double, const Vec3& reference) {
      const Vec3 arm = reference + read(u_, slot);
      const Vec3 chord = turn(arm, relative) - arm;
      for (int c = 0; c < 3; ++c) {
        w_[index(dof(slot, c))] = chord[c] / dt_;
        u_[index(dof(slot, c))] += dt_ * w_[index(dof(slot, c))];
      }
    });
    frame.advance(dt_);
    if (++steps_ % kAnchorInterval == 0) anchor();
  }

  double dt() const { return dt_; }
  void set_dt(double dt) { dt_ = dt; }
  const SpinningBody& body() const { return body_; }
  BodyFrame frame;

 private:
  Mesh mesh_;
  std::unique_ptr<InternalForce> internal_;
  std::vector<double> mass_;
  AlignedVector<double> inverse_;
  SpinningBody body_;
  AlignedVector<double> u_, w_, force_;
  double dt_ = 0;
  std::int64_t steps_ = 0;
};

constexpr RingShape kSmallRing = {0.08, 0.12, 0.04, 2, 2, 24};
constexpr RingShape kDisc = {0.06, 0.30, 0.06, 4, 2, 28};

TEST(Spinning, RigidRotationThroughATurnLeavesNoStress) {
  FreeRing ring(kSmallRing);
  constexpr double spin = 200;
  constexpr int steps = 64 * kAnchorInterval;
  ring.frame.spin = 0.99 * spin;
  ring.set_dt(kTurn / spin / steps);
  double largest = 0;
  for (int step = 0; step < steps; ++step) {
    ring.impose_rotation(spin);
    if (step % 100 == 99) largest = std::max(largest, ring.largest_stress());
  }
  measured("stress after a turn of 2 pi", ring.largest_stress(), "Pa");
  measured("largest stress on the way", largest, "Pa");
  EXPECT_NEAR(ring.frame.spin / spin, 1, 1e-6);
  EXPECT_NEAR(ring.frame.angle, kTurn, 1e-6);
  EXPECT_LT(largest, 1.0);
}

/// A cosine rounded to 1 would make the velocity grow by 9e-3.
TEST(Spinning, TurnOfTheVelocityKeepsItsSizeInSinglePrecision) {
  StepLoads loads;
  loads.dt = 3.4e-7;
  loads.frame.spin = 194;
  auto step = step_constants<float>(Sweep::revolved, loads);
  step.spin2 = 0;
  const float weight[2] = {};
  const float force[3] = {};
  double u[3] = {};
  float v[3] = {0.1F, 0, 0.2F};
  for (int i = 0; i < 1000000; ++i) move_spinning(step, weight, 0.4F, 1.0F, force, u, v);
  const double growth = std::hypot(v[0], v[2]) / std::hypot(0.1, 0.2) - 1;
  measured("growth of a velocity in a million turns", growth);
  EXPECT_LT(std::abs(growth), 1e-4);
}

TEST(Spinning, FreeRingKeepsEnergyAndMomentum) {
  FreeRing ring(kSmallRing);
  // The ring starts unstretched and breathes under its own spin. The frame's spin is 1 % wrong.
  constexpr double spin = 600;
  ring.frame.spin = 0.99 * spin;
  ring.frame.velocity = {30, 0, 0};
  ring.push([&](const Vec3& x) { return cross({0, 0.01 * spin, 0}, x); });
  const auto steps = static_cast<int>(std::lround(2 * kTurn / spin / ring.dt()));
  const Vec3 angular = ring.angular_momentum();
  const Vec3 linear = ring.momentum();
  double low = 1e300, high = -1e300;
  for (int step = 0; step < steps; ++step) {
    if (step % 16 == 0) {
      low = std::min(low, ring.energy());
      high = std::max(high, ring.energy());
    }
    ring.step();
  }
  const double reference = 0.5 * (low + high);
  measured("steps in two turns", steps);
  measured("relative range of the energy, two turns", (high - low) / reference);
  const double turned = norm(ring.angular_momentum() - angular) / norm(angular);
  const double pushed = norm(ring.momentum() - linear) / norm(linear);
  measured("relative change of angular momentum", turned);
  measured("relative change of momentum", pushed);
  EXPECT_LT((high - low) / reference, 1e-4);
  EXPECT_LT(turned, 1e-6);
  EXPECT_LT(pushed, 1e-9);
}

TEST(Spinning, TranslationWithSpinHasNoDrift) {
  FreeRing ring(kSmallRing);
  constexpr double spin = 200;
  const Vec3 velocity{80, 0, -1};
  ring.frame.spin = spin;
  ring.frame.velocity = {80, 0, 0};
  ring.push([&](const Vec3&) { return velocity - Vec3{80, 0, 0}; });  // the frame knows only a part of it
  const auto steps = static_cast<int>(std::lround(2 * kTurn / spin / ring.dt()));
  // The frame takes over the mean velocity, up to a share of spin * dt at each anchoring, and keeps it
  // afterwards.
  for (int step = 0; step < 4 * kAnchorInterval; ++step) ring.step();
  const Vec3 start = ring.mass_centre();
  const Vec3 taken = ring.frame.velocity;
  EXPECT_LT(norm(taken - velocity), 1e-3);
  for (int step = 0; step < steps; ++step) ring.step();
  const Vec3 way = ring.mass_centre() - start;
  const Vec3 drift = way - steps * ring.dt() * taken;
  measured("drift over two turns", norm(drift), "m");
  measured("way", norm(way), "m");
  EXPECT_LT(norm(drift), 1e-9 * norm(way));
  EXPECT_LT(norm(ring.frame.velocity - taken), 1e-9 * norm(taken));
}

struct Wobble {
  double rate;            ///< rate of the figure axis about the angular momentum, along it, inertial [rad/s]
  double expected;        ///< I_a w / I_t [rad/s]
  double angular_change;  ///< relative change of the angular momentum
  double energy_change;   ///< change of the energy, relative to the energy of rotation
};

Wobble wobble(const RingShape& shape, double spin) {
  FreeRing disc(shape);
  disc.frame.spin = spin;
  // To first order, the stretch by the spin would only breathe: the test starts from the slow ring.
  constexpr double kick = 0.3;  // about z [rad/s]
  disc.push([&](const Vec3& x) { return cross({0, 0, kick}, x); });
  const Vec3 angular = disc.angular_momentum();
  const double energy = disc.energy();
  const auto steps = static_cast<int>(std::lround(2 * kTurn / spin / disc.dt()));
  // Tilt of the angular momentum in the same components as the figure axis.
  const std::complex<double> still{angular.z / angular.y, angular.x / angular.y};
  double phase = 0, last = 0, worst_energy = 0, worst_angular = 0;
  double st = 0, sp = 0, stt = 0, stp = 0;
  int count = 0;
  double spin_sum = 0;
  for (int step = 0; step < steps; ++step) {
    disc.step();
    if (step % 32 != 0) continue;
    const double now = std::arg(disc.figure_axis() - still);
    if (count > 0) phase += std::remainder(now - last, kTurn);
    last = now;
    const double t = step * disc.dt();
    st += t;
    sp += phase;
    stt += t * t;
    stp += t * phase;
    ++count;
    spin_sum += disc.frame.spin;
    worst_energy = std::max(worst_energy, std::abs(disc.energy() - energy) / energy);
    worst_angular = std::max(worst_angular, norm(disc.angular_momentum() - angular) / norm(angular));
  }
  const double slope = (count * stp - st * sp) / (count * stt - st * st);
  const SpinningBody& body = disc.body();
  return {slope, body.inertia() / body.transverse_inertia() * spin_sum / count, worst_angular, worst_energy};
}

TEST(Spinning, KickedDiscWobblesAsARigidBody) {
  for (const double spin : {200.0, 400.0}) {
    const Wobble w = wobble(kDisc, spin);
    measured(fmt::format("spin {:.0f} rad/s: wobble / (I_a w / I_t) - 1", spin), w.rate / w.expected - 1);
    measured(fmt::format("spin {:.0f} rad/s: change of angular momentum", spin), w.angular_change);
    measured(fmt::format("spin {:.0f} rad/s: change of energy", spin), w.energy_change);
    EXPECT_NEAR(w.rate / w.expected, 1, 5e-3);
    EXPECT_LT(w.angular_change, 1e-4);
    EXPECT_LT(w.energy_change, 1e-4);
  }
}

}  // namespace
}  // namespace tread
