// Damping by a Maxwell branch: a bar's modes against the oscillator with such a branch, the stable step, the
// energy balance, and a tyre that spins and rolls with it.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "drivers/engine/simulation.hpp"
#include "drivers/engine/start/preload.hpp"
#include "drivers/engine/start/step_limit.hpp"
#include "drivers/verify/small_models.hpp"
#include "tests/measured.hpp"
#include "tests/tyre_scene.hpp"

namespace tread {
namespace {

constexpr double kBeta = 5e-6;       ///< [s]
constexpr double kFrequency = 10e3;  ///< frequency up to which the damping holds [Hz]
constexpr double kElement = 5e-3;    ///< [m]

const auto kSilent = [](const std::string&) {};

Scene bar_scene() {
  Scene scene = BarScene{.element_size = kElement, .poissons_ratio = 0}.scene();
  scene.materials.at("steel").rayleigh_beta = kBeta;
  scene.materials.at("steel").damping_up_to = kFrequency;
  return scene;
}

/// Oscillator with u'' + w^2 (u + g q) = 0, q' = u' - q / tau.
struct Oscillator {
  double omega;  ///< [rad/s]
  MaxwellBranch branch;
  std::array<double, 3> state;  ///< u [m], u' [m/s], q [m]

  std::array<double, 3> rate(const std::array<double, 3>& s) const {
    return {s[1], -omega * omega * (s[0] + branch.strength * s[2]), s[1] - s[2] / branch.time};
  }
  /// Runge and Kutta's method of fourth order.
  void advance(double dt) {
    std::array<double, 3> sum{};
    std::array<double, 3> last{};
    const double weight[4] = {1, 2, 2, 1};
    const double way[4] = {0, 0.5, 0.5, 1};
    for (int stage = 0; stage < 4; ++stage) {
      std::array<double, 3> at = state;
      for (std::size_t i = 0; i < 3; ++i) at[i] += way[stage] * dt * last[i];
      last = rate(at);
      for (std::size_t i = 0; i < 3; ++i) sum[i] += weight[stage] * last[i];
    }
    for (std::size_t i = 0; i < 3; ++i) state[i] += dt / 6 * sum[i];
  }
};

/// A longitudinal mode of a free bar of linear elements with lumped masses.
class Mode {
 public:
  Mode(const Model& model, int waves) : model_(&model), block_(&model.mesh.blocks[0]), waves_(waves) {
    length_ = block_->stations.back() - block_->stations.front();
  }
  double omega() const {
    const Material& steel = model_->scene.rail_material();
    const double sound = std::sqrt(steel.youngs_modulus / steel.density);
    return 2 * sound / kElement * std::sin(0.5 * std::numbers::pi * waves_ * kElement / length_);
  }
  double amplitude(ConstNodeField field) const {
    double sum = 0;
    double mass = 0;
    for (int station = 0; station < block_->station_count(); ++station) {
      const double x = block_->stations[static_cast<std::size_t>(station)] - block_->stations.front();
      const double shape = std::cos(std::numbers::pi * waves_ * x / length_);
      for (int node = 0; node < block_->section.nodes(); ++node) {
        const std::int64_t slot = block_->base + block_->slot(node, station);
        const double weight = model_->mass[static_cast<std::size_t>(slot)] * shape;
        sum += weight * field[dof(slot, 0)];
        mass += weight * shape;
      }
    }
    return sum / mass;
  }

 private:
  const Model* model_;
  const SweptBlock* block_;
  int waves_;
  double length_;
};

/// Largest differences of the modes' displacements from theory, over the first largest displacement of the
/// undamped mode.
std::vector<double> errors_of_modes(const Scene& scene, const std::vector<int>& waves, double dt) {
  constexpr double kDuration = 0.2e-3;  // [s]
  Model model(scene);
  Simulation simulation(model, solve_preload(model, {}, kSilent), dt);
  std::vector<Mode> modes;
  std::vector<Oscillator> theory;
  std::vector<double> scale;
  for (const int w : waves) {
    modes.emplace_back(model, w);
    const double speed = modes.back().amplitude(simulation.velocity());
    theory.push_back({modes.back().omega(), *scene.rail_material().branch(), {0, speed, 0}});
    scale.push_back(std::abs(speed) / modes.back().omega());
  }
  std::vector<double> errors(waves.size());
  while (simulation.time() < kDuration) {
    simulation.step();
    for (std::size_t k = 0; k < modes.size(); ++k) {
      for (int part = 0; part < 8; ++part) theory[k].advance(dt / 8);
      const double difference = modes[k].amplitude(simulation.displacement()) - theory[k].state[0];
      errors[k] = std::max(errors[k], std::abs(difference) / scale[k]);
    }
  }
  return errors;
}

TEST(MaxwellBranch, LossIsNineTenthsOfBetaOmegaAtTheStatedFrequency) {
  const MaxwellBranch branch = *bar_scene().rail_material().branch();
  const auto modulus = [&](double omega) {
    const std::complex<double> lag(0, omega * branch.time);
    return 1.0 + branch.strength * lag / (1.0 + lag);
  };
  const double omega = 2 * std::numbers::pi * kFrequency;
  EXPECT_NEAR(modulus(omega).imag(), 0.9 * kBeta * omega, 1e-12);
  EXPECT_NEAR(modulus(omega).real(), 1 + 0.1 * branch.strength, 1e-12);
  EXPECT_NEAR(modulus(0.1 * omega).imag(), 0.1 * kBeta * omega, 2e-3 * 0.1 * kBeta * omega);
  EXPECT_NEAR(modulus(1e6 * omega).real(), 1 + branch.strength, 1e-9);
}

// w tau from 0.43 to 2.5: below, at and above the peak of the loss.
TEST(MaxwellBranch, ModesOfABarMoveAsInTheory) {
  const Scene scene = bar_scene();
  const double dt = 0.4 * step_limit(Model(scene)).stable_step;
  const std::vector<int> waves = {1, 2, 4, 6};
  const std::vector<double> coarse = errors_of_modes(scene, waves, dt);
  const std::vector<double> fine = errors_of_modes(scene, waves, 0.5 * dt);
  for (std::size_t k = 0; k < waves.size(); ++k) {
    const double tau = scene.rail_material().branch()->time;
    measured(fmt::format("mode {}: w tau", waves[k]), Mode(Model(scene), waves[k]).omega() * tau);
    measured(fmt::format("mode {}: largest error / amplitude", waves[k]), fine[k]);
    measured(fmt::format("mode {}: order in time", waves[k]), std::log2(coarse[k] / fine[k]));
    EXPECT_LT(fine[k], 0.01);
    EXPECT_NEAR(std::log2(coarse[k] / fine[k]), 2, 0.1);
  }
}

TEST(MaxwellBranch, StepIsThatOfTheStifferBodies) {
  const Scene scene = bar_scene();
  Scene free = scene;
  free.materials.at("steel").rayleigh_beta = 0;
  free.materials.at("steel").damping_up_to.reset();
  const double free_step = step_limit(Model(free)).stable_step;
  Model model(scene);
  const double step = step_limit(model).stable_step;
  const MaxwellBranch branch = *scene.rail_material().branch();
  EXPECT_NEAR(step / free_step, 1 / std::sqrt(1 + branch.strength), 1e-3);
  const Preload preload = solve_preload(model, {}, kSilent);
  EXPECT_FALSE(run_small(scene, preload, step, 3000).stopped);
  // At the limit q = u tanh(x) / x.
  const double x = 0.5 * step / branch.time;
  const double limit = free_step / std::sqrt(1 + branch.strength * std::tanh(x) / x);
  measured("computed step / limit", step / limit);
  EXPECT_FALSE(run_small(scene, preload, 0.999 * limit, 3000).stopped);
  EXPECT_TRUE(run_small(scene, preload, 1.01 * limit, 3000).stopped);
}

// The test looks in every step at waves of element length: the residual is of second order in the step.
TEST(MaxwellBranch, WhatItDissipatesClosesTheBalance) {
  const Scene scene = bar_scene();
  Model model(scene);
  const Preload preload = solve_preload(model, {}, kSilent);
  const double limit = step_limit(model).stable_step;
  const auto largest_residual = [&](double dt) {
    Simulation simulation(model, preload, dt);
    simulation.set_sampling_interval(1);
    simulation.step();
    const double start = simulation.sample().energy.total();
    double residual = 0;
    while (simulation.time() < 0.3e-3) {
      simulation.step();
      residual = std::max(residual, std::abs(simulation.sample().energy.residual));
    }
    EXPECT_GT(simulation.sample().energy.material_loss, 0.7 * start);
    return residual / start;
  };
  const double coarse = largest_residual(0.2 * limit);
  const double fine = largest_residual(0.1 * limit);
  measured("residual / energy", fine);
  measured("order in time", std::log2(coarse / fine));
  EXPECT_LT(fine, 1e-3);
  EXPECT_NEAR(std::log2(coarse / fine), 2, 0.2);
}

// The tyre's material passes under the load again and again. The balance includes that loss, in finite
// rotation too.
TEST(MaxwellBranch, RollingTyreClosesItsBalance) {
  const Scene scene =
      samples::tyre_with_maxwell_branches({"scene.element_size=8 mm", "motion.duration=0.5 ms"});
  Model model(scene);
  const Preload preload = solve_preload(model, steady_motion(model), kSilent);
  const double dt = scene.motion->step_safety * step_limit(model).stable_step;
  Simulation simulation(model, preload, dt);
  simulation.set_sampling_interval(20);
  while (simulation.time() < scene.motion->duration) simulation.step();
  const EnergyLedger& energy = simulation.sample().energy;
  measured("dissipated in the material", energy.material_loss, "J");
  measured("energy residual", energy.residual, "J");
  EXPECT_GT(energy.material_loss, 0);
  EXPECT_LT(std::abs(energy.residual), 0.01 * energy.material_loss);
}

}  // namespace
}  // namespace tread
