// A blow on a rail without a wheel: momentum, work, and the cases of the track.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "core/math/receptance.hpp"
#include "drivers/engine/simulation.hpp"
#include "drivers/engine/start/preload.hpp"
#include "drivers/engine/start/step_limit.hpp"
#include "drivers/verify/rail_blow.hpp"
#include "io/scene/scene_reader.hpp"
#include "tests/verified_case.hpp"

namespace tread {
namespace {

Scene free_bar() {
  return resolve_scene(SceneSource{"bar.toml",
                                   R"([scene]
element_size = "10 mm"
gravity = "0 m/s2"
[material.steel]
youngs_modulus = "205.9 GPa"
poissons_ratio = 0.3
density = "7790 kg/m3"
[rail]
profile = "box"
support = "free"
inclination = 0
length = "0.4 m"
origin = "0.2 m"
width = "40 mm"
height = "40 mm"
[hammer]
force = "10 kN"
duration = "0.1 ms"
[motion]
duration = "0.4 ms"
)",
                                   {}},
                       {})
      .scene;
}

TEST(Hammer, GivesAFreeBarItsImpulseAndItsWork) {
  const Scene scene = free_bar();
  Model model(scene);
  ASSERT_TRUE(model.hammer);
  const Preload preload = solve_preload(model, {}, [](const std::string&) {});
  Simulation simulation(model, preload, scene.motion->step_safety * step_limit(model).stable_step);
  simulation.set_sampling_interval(1);
  while (simulation.time() < scene.motion->duration) simulation.step();
  double momentum = 0;
  const SweptBlock& bar = model.mesh.blocks[0];
  for (int station = 0; station < bar.station_count(); ++station)
    for (int node = 0; node < bar.section.nodes(); ++node) {
      const std::int64_t slot = bar.base + bar.slot(node, station);
      momentum -= model.mass[static_cast<std::size_t>(slot)] * simulation.velocity()[dof(slot, 2)];
    }
  const double impulse = 2 / std::numbers::pi * scene.hammer->force * scene.hammer->duration;
  EXPECT_NEAR(momentum, impulse, 1e-4 * impulse);
  const EnergyLedger& energy = simulation.sample().energy;
  measured("work of the hammer", energy.hammer_work, "J");
  measured("energy residual", energy.residual, "J");
  EXPECT_GT(energy.hammer_work, 0.5 * impulse * impulse / (7790 * 0.4 * 0.04 * 0.04));
  EXPECT_LT(std::abs(energy.residual), 1e-3 * energy.hammer_work);
  EXPECT_GT(simulation.sample().hammer_displacement, 0);
  EXPECT_EQ(simulation.sample().hammer_force, 0);
}

/// m x'' + c x' + k x = F: a half sine, then decay. `later`: steps between the samples after 5 ms.
void expect_receptance_of_an_oscillator(int later) {
  const double m = 2, c = 400, k = 1e5;
  BlowRecord record;
  double x = 0, v = 0;
  constexpr double kStep = 1e-6;
  for (int i = 0; i < 200000; ++i) {
    const double t = i * kStep;
    const double force = t < 1e-3 ? std::sin(std::numbers::pi * t / 1e-3) : 0;
    if (i % (t < 5e-3 ? 20 : later) == 0) {
      record.time.push_back(t);
      record.force.push_back(force);
      record.response.push_back(x);
    }
    v += kStep * (force - c * v - k * x) / m;
    x += kStep * v;
  }
  for (const double f : {10.0, 40.0, 200.0}) {
    const double w = 2 * std::numbers::pi * f;
    const std::complex<double> theory = 1.0 / std::complex<double>(k - m * w * w, c * w);
    EXPECT_NEAR(std::abs(record.receptance(f) / theory - 1.0), 0, 2e-3) << f;
  }
}

/// Under a wheel the head is divided finer than the rail below it.
TEST(Hammer, SectionsOfARailAreAtOnePlaceInAllBlocks) {
  const Scene scene = resolve_scene(SceneSource{"rail.toml",
                                                R"([scene]
based_on = "highspeed-slab-2014"
element_size = "10 mm"
[slab]
present = false
[solution_zone]
start = "0 m"
length = "0.1 m"
)",
                                                {}},
                                    {})
                          .scene;
  const Model model(scene);
  const auto block = [&](int number) -> const SweptBlock& {
    return model.mesh.blocks[static_cast<std::size_t>(number)];
  };
  ASSERT_NE(block(model.index.rail_cap).stations, block(model.index.rail_base).stations);
  std::vector<double> u(static_cast<std::size_t>(3 * model.mesh.slots));
  for (const int b : model.index.rail())
    for (int station = 0; station < block(b).station_count(); ++station)
      for (int node = 0; node < block(b).section.nodes(); ++node)
        u[static_cast<std::size_t>(dof(block(b).base + block(b).slot(node, station), 2))] =
            -block(b).stations[static_cast<std::size_t>(station)];
  const RailAxis axis(model);
  for (const double x : {-5.9, -0.02, 0.0, 0.0137, 2.0, axis.stations().back()})
    EXPECT_NEAR(axis.deflection(x, u.data()), x, 1e-12) << x;
}

TEST(Hammer, ReceptanceOfAnOscillator) {
  expect_receptance_of_an_oscillator(20);
}

TEST(Hammer, ReceptanceOfARecordWhoseIntervalChanges) {
  expect_receptance_of_an_oscillator(40);
}

TEST(Hammer, FrequencyOfAHarmonicRecord) {
  std::vector<double> values(500);
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = std::sin(2 * std::numbers::pi * 61.7 * static_cast<double>(i) * 2e-5 + 0.4);
  EXPECT_NEAR(harmonic_frequency(values, 2e-5, 20, 8000), 61.7, 0.01);
}

TEST(Hammer, BendingWavesOfAShortRail) {
  expect_bounds_hold("rail_waves", {{"element_size", "5.5 mm"},
                                    {"length", "0.9 m"},
                                    {"duration", "6 ms"},
                                    {"highest_frequency", "2 kHz"}});
}

}  // namespace
}  // namespace tread
