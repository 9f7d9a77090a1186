// Masses on springs and dampers, integrated with the pieces of the time step, against theory.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/mesh/structured.hpp"
#include "kernels/blocks/time_update.hpp"
#include "kernels/connectors/connectors.hpp"
#include "tests/measured.hpp"
#include "tests/swept_samples.hpp"

namespace tread {
namespace {

std::size_t index(std::int64_t i) {
  return static_cast<std::size_t>(i);
}

/// One free node on a spring-damper to the ground.
struct Oscillator {
  double mass = 2;           ///< [kg]
  double stiffness = 8e6;    ///< [N/m]
  double damping_ratio = 0;  ///< fraction of critical [-]

  double omega() const { return std::sqrt(stiffness / mass); }
  double damped() const { return omega() * std::sqrt(1 - damping_ratio * damping_ratio); }
  /// Position after a release at 1 mm without speed [m].
  double position(double t) const {
    const double decay = damping_ratio * omega();
    return 1e-3 * std::exp(-decay * t) * (std::cos(damped() * t) + decay / damped() * std::sin(damped() * t));
  }
  double speed(double t) const {
    return -1e-3 * omega() * omega() / damped() * std::exp(-damping_ratio * omega() * t) *
           std::sin(damped() * t);
  }
};

struct Result {
  double error;         ///< largest error over three periods, relative to the amplitude
  double energy_error;  ///< stored + dissipated energy less that at the start, relative
};

Result integrate(const Oscillator& o, int steps_per_period) {
  Mesh mesh;
  mesh.add(make_swept_block("block", Sweep::extruded, rectangle(0, 0.1, 1, 0, 0.1, 1), {samples::steel()}, 0,
                            {{1, 0.1, 0}}));
  const auto n = index(3 * mesh.slots);
  AlignedVector<double> u(n, 0.0), v(n, 0.0), f(n, 0.0), inverse(index(mesh.slots), 0.0);
  const SweptBlock& block = mesh.blocks[0];
  const std::int64_t slot = block.slot(2, 1);
  inverse[index(slot)] = 1 / o.mass;
  SpringDampers::Element element{{}, {}, o.stiffness, 2 * o.damping_ratio * std::sqrt(o.stiffness * o.mass)};
  element.upper.slot[0] = slot;
  element.upper.weight[0] = 1;
  SpringDampers spring({element});
  const TimeUpdate update(mesh, inverse.data());

  const double period = 2 * std::numbers::pi / o.omega();
  const double dt = period / steps_per_period;
  const std::size_t z = index(dof(slot, 2));
  u[z] = o.position(0);
  v[z] = o.speed(-0.5 * dt);
  Result result{0, 0};
  const double start = 0.5 * o.stiffness * 1e-6;
  for (int step = 0; step < 3 * steps_per_period; ++step) {
    std::fill(f.begin(), f.end(), 0.0);
    const double before = 0.5 * o.mass * v[z] * v[z];
    const double stored = spring.energy(u.data());
    const double lost = spring.dissipated();
    spring.apply(u.data(), v.data(), dt, f.data());
    update.move_all({dt, 0, {}}, {u.data(), v.data(), f.data()});
    const double energy =
        stored + 0.5 * (before + 0.5 * o.mass * v[z] * v[z]) + 0.5 * (lost + spring.dissipated());
    result.energy_error = std::max(result.energy_error, std::abs(energy - start) / start);
    result.error = std::max(result.error, std::abs(u[z] - o.position((step + 1) * dt)) / 1e-3);
  }
  return result;
}

TEST(Oscillator, FollowsTheoryToSecondOrder) {
  const Oscillator o;
  const Result coarse = integrate(o, 50);
  const Result fine = integrate(o, 100);
  measured("undamped, 50 steps a period: largest error of three periods", coarse.error);
  measured("order", std::log2(coarse.error / fine.error));
  EXPECT_NEAR(std::log2(coarse.error / fine.error), 2, 0.1);
  EXPECT_LT(fine.error, 0.01);
  EXPECT_LT(fine.energy_error, 2e-3);
  EXPECT_NEAR(std::log2(coarse.energy_error / fine.energy_error), 2, 0.1);
}

// The damper sees the velocity of half a step ago: its force is late by the share zeta omega dt.
TEST(Oscillator, LaggedDampersAreOfFirstOrderInTheirSmallShare) {
  Oscillator o;
  o.damping_ratio = 0.05;
  const Result coarse = integrate(o, 400);
  const Result fine = integrate(o, 800);
  measured("5 % of critical, 400 steps a period: largest error of three periods", coarse.error);
  measured("order", std::log2(coarse.error / fine.error));
  measured("energy balance, 400 steps a period", coarse.energy_error);
  EXPECT_GT(std::log2(coarse.error / fine.error), 0.9);
  EXPECT_LT(coarse.error, 0.1 * o.damping_ratio);
  EXPECT_LT(coarse.energy_error, 0.1 * o.damping_ratio);
}

TEST(Oscillator, FallsFreelyUnderGravity) {
  Mesh mesh;
  mesh.add(make_swept_block("block", Sweep::extruded, rectangle(0, 0.1, 1, 0, 0.1, 1), {samples::steel()}, 0,
                            {{1, 0.1, 0}}));
  const auto n = index(3 * mesh.slots);
  AlignedVector<double> u(n, 0.0), v(n, 0.0), f(n, 0.0), inverse(index(mesh.slots), 0.0);
  samples::for_each_node(
      mesh, [&](const SweptBlock&, int node, int, std::int64_t slot) { inverse[index(slot)] = 1 + node; });
  constexpr double dt = 1e-3;
  for (double& value : v) value = 0;
  samples::for_each_node(mesh, [&](const SweptBlock&, int, int, std::int64_t slot) {
    v[index(dof(slot, 2))] = 0.5 * dt * 9.81;  // half a step before
  });
  const TimeUpdate update(mesh, inverse.data());
  for (int step = 0; step < 100; ++step) update.move_all({dt, 9.81, {}}, {u.data(), v.data(), f.data()});
  samples::for_each_node(mesh, [&](const SweptBlock&, int, int, std::int64_t slot) {
    EXPECT_NEAR(u[index(dof(slot, 2))], -0.5 * 9.81 * 0.01, 1e-15);
    EXPECT_EQ(u[index(dof(slot, 0))], 0);
  });
  // Lanes without a node stay at rest.
  double sum = 0;
  for (const double value : u) sum += value;
  EXPECT_NEAR(sum, -8 * 0.5 * 9.81 * 0.01, 1e-13);
}

}  // namespace
}  // namespace tread
