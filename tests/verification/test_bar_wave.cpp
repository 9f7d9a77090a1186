// The scene of a wave in a bar: speed, energy, order.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "drivers/engine/simulation.hpp"
#include "drivers/engine/start/preload.hpp"
#include "drivers/engine/start/step_limit.hpp"
#include "io/scene/scene_reader.hpp"
#include "kernels/blocks/internal_force.hpp"
#include "kernels/blocks/time_update.hpp"
#include "tests/measured.hpp"
#include "tests/swept_samples.hpp"

namespace tread {
namespace {

std::size_t index(std::int64_t i) {
  return static_cast<std::size_t>(i);
}

Scene bar_scene() {
  return read_scene(std::filesystem::path(TREAD_SOURCE_DIR) / "scenes/bar-wave.toml");
}

/// Mean longitudinal velocity of a station's nodes.
double velocity(const SweptBlock& block, int station, ConstNodeField v) {
  double sum = 0;
  for (int node = 0; node < block.section.nodes(); ++node)
    sum += v[dof(block.base + block.slot(node, station), 0)];
  return sum / block.section.nodes();
}

TEST(BarWave, SceneRunsAtTheSpeedOfSoundAndKeepsItsEnergy) {
  const Scene scene = bar_scene();
  Model model(scene);
  EXPECT_TRUE(model.restrained.empty());
  EXPECT_FALSE(model.contact);
  EXPECT_FALSE(model.wheelset);
  const Preload preload = solve_preload(model, {}, [](const std::string&) {});
  for (const double u : preload.displacement) EXPECT_EQ(u, 0);
  const double dt = scene.motion->step_safety * step_limit(model).stable_step;
  Simulation simulation(model, preload, dt);
  simulation.set_sampling_interval(1);
  const SweptBlock& bar = model.mesh.blocks[0];
  const double sound = std::sqrt(scene.rail_material().youngs_modulus / scene.rail_material().density);
  // The step of velocity splits into two of half the size. A wave has arrived when two stations have a
  // quarter of the step.
  const auto station_at = [&](double x) {
    int s = 0;
    while (bar.stations[index(s)] < x - 1e-9) ++s;
    return s;
  };
  const int near = station_at(0.3);
  const int far = station_at(0.7);
  double arrived_near = 0, arrived_far = 0, momentum = 0;
  double low = 1e300, high = -1e300, scale = 0;
  while (simulation.time() < scene.motion->duration) {
    const double before_near = velocity(bar, near, simulation.velocity());
    const double before_far = velocity(bar, far, simulation.velocity());
    simulation.step();
    const double now_near = velocity(bar, near, simulation.velocity());
    const double now_far = velocity(bar, far, simulation.velocity());
    const double at = simulation.time() - 0.5 * dt;  // time of the velocities
    const double quarter = 0.25 * scene.pulse->velocity;
    const auto crossing = [&](double before, double now) {
      return at - dt * (now - quarter) / (now - before);
    };
    if (arrived_near == 0 && now_near > quarter) arrived_near = crossing(before_near, now_near);
    if (arrived_far == 0 && now_far > quarter) arrived_far = crossing(before_far, now_far);
    const EnergyLedger& energy = simulation.sample().energy;
    low = std::min(low, energy.residual);
    high = std::max(high, energy.residual);
    scale = std::max(scale, energy.kinetic);
  }
  ASSERT_GT(arrived_far, 0);
  const double speed = (bar.stations[index(far)] - bar.stations[index(near)]) / (arrived_far - arrived_near);
  measured("wave speed / sqrt(E / rho) - 1", speed / sound - 1);
  measured("range of the energy / energy", (high - low) / scale);
  EXPECT_NEAR(speed / sound, 1, 5e-3);
  EXPECT_LT((high - low) / scale, 1e-9);

  for (int station = 0; station < bar.station_count(); ++station)
    for (int node = 0; node < bar.section.nodes(); ++node) {
      const std::int64_t slot = bar.base + bar.slot(node, station);
      momentum += model.mass[index(slot)] * simulation.velocity()[dof(slot, 0)];
      // Without lateral contraction nothing moves sideways.
      EXPECT_NEAR(simulation.velocity()[dof(slot, 1)], 0, 1e-9);
    }
  // The first 20 of 200 elements move, the station at 0.1 m does not: 0.1 m less half an element of the bar's
  // cross-section.
  const double h = bar.stations[1] - bar.stations[0];
  const double mass = scene.rail_material().density * 0.01 * 0.01 * (0.1 - 0.5 * h);
  EXPECT_NEAR(momentum, mass * scene.pulse->velocity, 1e-9 * momentum);
}

/// The forces of a damped bar hold those of its damping, its energy does not.
TEST(BarWave, StrainEnergyOfADampedBarIsThatOfItsStrain) {
  Scene scene = bar_scene();
  scene.materials.at("steel").rayleigh_beta = 1e-7;
  Model model(scene);
  const Preload preload = solve_preload(model, {}, [](const std::string&) {});
  Simulation simulation(model, preload, scene.motion->step_safety * step_limit(model).stable_step);
  simulation.set_sampling_interval(1);
  AlignedVector<double> u(index(3 * model.mesh.slots));
  for (int step = 0; step < 30; ++step) {
    for (std::size_t i = 0; i < u.size(); ++i) u[i] = simulation.displacement()[static_cast<std::int64_t>(i)];
    simulation.step();
    const DeformationEnergy energy = model.energy(0, u.data());
    const double expected = energy.strain + energy.hourglass;
    EXPECT_NEAR(simulation.sample().energy.strain, expected, 1e-9 * expected) << step;
  }
  EXPECT_GT(simulation.sample().energy.strain, 0);
}

/// Largest error of the velocity of a smooth pulse that ran through the bar, relative to its height. The step
/// is a fixed share of the stable one.
double pulse_error(double element_size) {
  const Material material = bar_scene().rail_material();
  constexpr double length = 0.5;
  const int count = static_cast<int>(std::lround(length / element_size));
  Mesh mesh;
  mesh.add(make_swept_block("bar", Sweep::extruded, samples::grid_section({1, 1, 0, 0, 0.01, 0.01, 0}),
                            {material}, 0, {{count, length / count, 0}}));
  const InternalForce internal(mesh);
  AlignedVector<double> mass(index(mesh.slots), 0.0);
  internal.lumped_mass(mass.data());
  AlignedVector<double> inverse(mass.size(), 0.0);
  for (std::size_t i = 0; i < mass.size(); ++i)
    if (mass[i] > 0) inverse[i] = 1 / mass[i];
  const double sound = std::sqrt(material.youngs_modulus / material.density);
  const double dt = 0.5 * element_size / sound;
  // A bump of velocity that runs to the right: u = f(x - c t) with v = -c f'.
  const auto bump = [](double x) { return std::exp(-std::pow((x - 0.12) / 0.025, 2)); };
  const auto u_of = [&](double x, double t) {
    return 0.025 * std::sqrt(std::numbers::pi) / 2 * (1 - std::erf((x - sound * t - 0.12) / 0.025)) / sound;
  };
  auto u = samples::sample(mesh, [&](const Vec3& x) { return Vec3{u_of(x.x, 0), 0, 0}; });
  auto v = samples::sample(mesh, [&](const Vec3& x) { return Vec3{bump(x.x + 0.5 * sound * dt), 0, 0}; });
  AlignedVector<double> f(u.size(), 0.0);
  const int steps = static_cast<int>(std::lround(0.2 / sound / dt));
  const TimeUpdate update(mesh, inverse.data());
  for (int step = 0; step < steps; ++step) {
    internal.internal_force(u.data(), nullptr, f.data());
    update.move_all({dt, 0, {}}, {u.data(), v.data(), f.data()});
  }
  double worst = 0;
  const double passed = sound * (steps - 0.5) * dt;
  for (int station = 0; station < mesh.blocks[0].station_count(); ++station)
    worst = std::max(worst, std::abs(velocity(mesh.blocks[0], station, v.data()) -
                                     bump(mesh.blocks[0].stations[index(station)] - passed)));
  return worst;
}

TEST(BarWave, SmoothPulseConvergesToSecondOrder) {
  const double coarse = pulse_error(4e-3);
  const double middle = pulse_error(2e-3);
  const double fine = pulse_error(1e-3);
  measured("pulse of 25 mm, elements of 4 mm: largest error / height", coarse);
  measured("elements of 2 mm", middle);
  measured("elements of 1 mm", fine);
  measured("order", std::log2(middle / fine));
  EXPECT_NEAR(std::log2(middle / fine), 2, 0.15);
  EXPECT_LT(fine, 0.01);
}

}  // namespace
}  // namespace tread
