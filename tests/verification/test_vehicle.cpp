// A wheel's motion along x: the masses that traction speeds up, the creepage at the patch.

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "drivers/engine/simulation.hpp"
#include "drivers/engine/start/preload.hpp"
#include "drivers/engine/start/step_limit.hpp"
#include "tests/measured.hpp"
#include "tests/tyre_scene.hpp"

namespace tread {
namespace {

/// The tyre, rolling from the start, with overrides as on the command line.
Scene rolling_tyre(std::vector<std::string> overrides) {
  overrides.insert(overrides.end(),
                   {"solution_zone.start=0 mm", "solution_zone.length=100 mm", "rail.length=0.7 m",
                    "rail.origin=0.2 m", "motion.speed=20 m/s", "motion.start=moving"});
  return samples::tyre_scene(overrides);
}

/// A tyre whose bore carries a vehicle, under traction.
Scene driven_tyre(const std::string& longitudinal) {
  return rolling_tyre({"scene.element_size=12 mm", "wheel.thickness=0.1 m", "load.present=false",
                       "vehicle.sprung_mass=3000 kg", "vehicle.unsprung_mass=200 kg",
                       "vehicle.longitudinal=" + longitudinal, "motion.duration=12 ms",
                       "motion.traction.mu=0.3", "motion.traction.ramp=4 ms",
                       "motion.traction.shape=smooth"});
}

/// Rolls the scene from its preload to its end. `see` receives the simulation after every sampled step.
template <class See>
void roll(const Scene& scene, Model& model, const See& see) {
  const double v = scene.motion->speed;
  const Preload preload =
      solve_preload(model, {v / model.wheel_radius(), v, false}, [](const std::string&) {});
  Simulation simulation(model, preload, scene.motion->step_safety * step_limit(model).stable_step);
  while (simulation.time() < scene.motion->duration) {
    simulation.step();
    if (simulation.sampled()) see(simulation);
  }
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
  double impulse = 0;
  double time = 0;
  double forward = 0;
  double upward = 0;
  double speed = v;
  MomentumCheck momentum;
  roll(scene, model, [&](const Simulation& simulation) {
    const Sample& sample = simulation.sample();
    impulse += sample.longitudinal_force * (sample.time - time);
    time = sample.time;
    speed = sample.wheel_speed;
    momentum = simulation.momentum_check();
    if (time < scene.motion->ramp) return;
    forward += sample.longitudinal_force;
    upward += sample.vertical_force;
  });
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

/// The stations of a tyre are unequal, and its bore's weights in the journal's mean are not the nodes'
/// masses: the unsprung mass has the acceleration of that mean. By the sum of the forces 0.16 J and 0.11 N s
/// appear.
TEST(Vehicle, UnsprungMassOnAFastRingKeepsEnergyAndMomentum) {
  const Scene scene = rolling_tyre({"scene.element_size=8 mm", "load.present=false", "motion.speed=300 km/h",
                                    "vehicle.sprung_mass=5000 kg", "vehicle.unsprung_mass=3000 kg",
                                    "motion.traction.mu=0", "motion.duration=1 ms"});
  Model model(scene);
  double residual = 0;
  MomentumCheck momentum;
  roll(scene, model, [&](const Simulation& simulation) {
    residual = simulation.sample().energy.residual;
    momentum = simulation.momentum_check();
  });
  measured("residual of the energy", residual, "J");
  measured("impulse", norm(momentum.impulse), "N s");
  measured("missing momentum", norm(momentum.change - momentum.impulse), "N s");
  EXPECT_LT(std::abs(residual), 0.01);
  EXPECT_LT(norm(momentum.change - momentum.impulse), 1e-3);
}

/// Creepage of a tyre without friction in the first instants.
double creepage_of_elements(double size) {
  const Scene scene =
      rolling_tyre({"scene.element_size=" + std::to_string(1e3 * size) + " mm", "scene.gravity=0 m/s2",
                    "wheel.crown_radius=0.1 m", "load.wheel_load=20 kN", "contact.friction=0",
                    "motion.duration=0.2 ms", "motion.creepage=0.01"});
  Model model(scene);
  double sum = 0;
  int samples = 0;
  roll(scene, model, [&](const Simulation& simulation) {
    sum += simulation.sample().creepage_mean;
    ++samples;
  });
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
