// A wheel's motion along x: the masses that traction speeds up, the creepage at the patch.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "drivers/engine/preload.hpp"
#include "drivers/engine/simulation.hpp"
#include "drivers/engine/static_system.hpp"
#include "io/scene/scene_reader.hpp"
#include "tests/measured.hpp"

namespace tread {
namespace {

/// A tyre whose bore carries a vehicle, under traction on a rigid rail.
Scene driven_tyre(const std::string& longitudinal) {
  return resolve_scene(SceneSource{"tyre.toml",
                                   R"([scene]
title = "driven tyre"
element_size = "12 mm"
[solution_zone]
start = "0 mm"
length = "100 mm"
[material.steel]
youngs_modulus = "205.9 GPa"
poissons_ratio = 0.3
density = "7790 kg/m3"
[wheel]
shape = "tyre"
profile = "arc"
crown_radius = "0.3 m"
thickness = "0.1 m"
lateral_offset = "0 mm"
[rail]
profile = "box"
support = "rigid"
inclination = 0
length = "0.7 m"
origin = "0.2 m"
[vehicle]
sprung_mass = "3000 kg"
unsprung_mass = "200 kg"
longitudinal = ")" + longitudinal + R"("
[contact]
friction = 0.5
[motion]
speed = "20 m/s"
duration = "12 ms"
start = "moving"
traction = { mu = 0.3, ramp = "4 ms", shape = "smooth" }
)",
                                   {}})
      .scene;
}

struct Driven {
  double mass = 0;      ///< that the impulse of F_L has sped up [kg]
  double wanted = 0;    ///< that is to be sped up [kg]
  double traction = 0;  ///< mean F_L / F_N after the ramp [-]
};

Driven drive(const std::string& longitudinal) {
  const Scene scene = driven_tyre(longitudinal);
  Model model(scene);
  const double v = scene.motion->speed;
  const Preload preload =
      solve_preload(model, {v / model.wheel_radius(), v, false}, [](const std::string&) {});
  Simulation simulation(model, preload, scene.motion->step_safety * step_limit(model).stable_step);
  double impulse = 0;
  double time = 0;
  double forward = 0;
  double upward = 0;
  double speed = v;
  while (simulation.time() < scene.motion->duration) {
    simulation.step();
    if (!simulation.sampled()) continue;
    const Sample& sample = simulation.sample();
    impulse += sample.longitudinal_force * (sample.time - time);
    time = sample.time;
    speed = sample.wheel_speed;
    if (time < scene.motion->ramp) continue;
    forward += sample.longitudinal_force;
    upward += sample.vertical_force;
  }
  const MomentumCheck momentum = simulation.momentum_check();
  EXPECT_NEAR(momentum.change.x / momentum.impulse.x, 1, 5e-4);
  return {impulse / (speed - v), model.wheelset->mass() + scene.vehicle->mass_along(), forward / upward};
}

/// M_c takes part in what traction speeds up, and in the torque for a traction coefficient, unless it is
/// free.
TEST(Vehicle, TractionDrivesTheSprungMassUnlessItIsFree) {
  for (const char* longitudinal : {"carried", "free"}) {
    SCOPED_TRACE(longitudinal);
    const Driven driven = drive(longitudinal);
    measured("driven mass", driven.mass, "kg");
    measured("wanted", driven.wanted, "kg");
    measured("F_L / F_N", driven.traction);
    EXPECT_NEAR(driven.mass / driven.wanted, 1, 0.05);
    EXPECT_NEAR(driven.traction, 0.3, 0.01);
  }
}

/// Creepage of a tyre without friction in the first instants.
double creepage_of_elements(double size) {
  const Scene scene = resolve_scene(SceneSource{"tyre.toml",
                                                R"([scene]
title = "sliding tyre"
element_size = ")" + std::to_string(1e3 * size) +
                                                    R"( mm"
gravity = "0 m/s2"
[solution_zone]
start = "0 mm"
length = "100 mm"
[material.steel]
youngs_modulus = "205.9 GPa"
poissons_ratio = 0.3
density = "7790 kg/m3"
[wheel]
shape = "tyre"
profile = "arc"
crown_radius = "0.1 m"
lateral_offset = "0 mm"
[rail]
profile = "box"
support = "rigid"
inclination = 0
length = "0.7 m"
origin = "0.2 m"
[load]
wheel_load = "20 kN"
[contact]
friction = 0
[motion]
speed = "20 m/s"
duration = "0.2 ms"
creepage = 0.01
start = "moving"
)",
                                                {}})
                          .scene;
  Model model(scene);
  const double v = scene.motion->speed;
  const Preload preload =
      solve_preload(model, {v / model.wheel_radius(), v, false}, [](const std::string&) {});
  Simulation simulation(model, preload, scene.motion->step_safety * step_limit(model).stable_step);
  double sum = 0;
  int samples = 0;
  while (simulation.time() < scene.motion->duration) {
    simulation.step();
    if (!simulation.sampled()) continue;
    sum += simulation.sample().creepage_mean;
    ++samples;
  }
  return sum / samples;
}

/// The creepage is that of the circle through the patch's centre. The circle through the nearest node, half
/// an element aside, is smaller and would change it by 4e-4 here from elements of 12 mm.
TEST(Creepage, IsThatOfThePatchWhereverNodesLie) {
  const double fine = creepage_of_elements(5e-3);
  measured("creepage, 5 mm", fine);
  EXPECT_NEAR(fine, 0.01, 3e-4);
  for (const double size : {12e-3, 9e-3, 7e-3}) {
    const double creepage = creepage_of_elements(size);
    measured("change from 5 to " + std::to_string(std::lround(1e3 * size)) + " mm", creepage - fine);
    EXPECT_NEAR(creepage, fine, 1e-4);
  }
}

}  // namespace
}  // namespace tread
