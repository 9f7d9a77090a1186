// A tyre rolls on a block: scene in code, preload, steps, contact forces. Fails where F_N is not near the
// load.

#include <fmt/core.h>

#include <cmath>

#include "core/error.hpp"
#include "drivers/engine/model/model.hpp"
#include "drivers/engine/simulation.hpp"
#include "drivers/engine/start/preload.hpp"
#include "drivers/engine/start/step_limit.hpp"

namespace {

constexpr double kLoad = 87564;  // [N]

tread::Scene tyre_on_block() {
  tread::Scene scene;
  scene.title = "tyre on a block";
  scene.element_size = 8e-3;
  scene.zone_start = 0.02;
  scene.zone_length = 0.05;
  scene.gravity = 0;
  scene.materials["steel"] = {"steel", 205.9e9, 0.3, 7790};
  tread::WheelSpec& wheel = scene.wheel.emplace();
  wheel.shape = "tyre";
  wheel.profile = "arc";
  wheel.crown_radius = 0.3;
  wheel.lateral_offset = 0;
  tread::RailSpec& rail = scene.rail.emplace();
  rail.profile = "box";
  rail.support = "rigid";
  rail.inclination = 0;
  rail.length = 0.4;
  rail.origin = 0.1;
  rail.width = 0.08;
  scene.load.emplace().wheel_load = kLoad;
  scene.contact.emplace().friction = 0.5;
  tread::MotionSpec& motion = scene.motion.emplace();
  motion.duration = 0.2e-3;
  return scene;
}

}  // namespace

int main() try {
  const tread::Scene scene = tyre_on_block();
  tread::Model model(scene);
  const tread::Preload preload =
      tread::solve_preload(model, tread::steady_motion(model), [](const std::string&) {});
  fmt::print("static F_N {:.3f} kN\n", -1e-3 * preload.contact.force_on_rail.z);

  const double dt = scene.motion->step_safety * tread::step_limit(model).stable_step;
  tread::Simulation simulation(model, preload, dt);
  simulation.set_sampling_interval(20);
  double mean = 0;
  int samples = 0;
  while (simulation.time() < scene.motion->duration) {
    simulation.step();
    if (!simulation.sampled()) continue;
    const tread::Sample& sample = simulation.sample();
    fmt::print("x {:.2f} mm  F_N {:.3f} kN  F_L {:.3f} kN\n", 1e3 * sample.wheel_x,
               1e-3 * sample.vertical_force, 1e-3 * sample.longitudinal_force);
    mean += sample.vertical_force;
    ++samples;
  }
  mean /= samples;
  const bool right =
      std::abs(-preload.contact.force_on_rail.z / kLoad - 1) < 1e-3 && std::abs(mean / kLoad - 1) < 0.1;
  fmt::print("mean F_N {:.3f} kN, load {:.3f} kN: {}\n", 1e-3 * mean, 1e-3 * kLoad,
             right ? "right" : "wrong");
  return right ? 0 : 1;
} catch (const tread::Error& error) {
  fmt::print(stderr, "{}\n", error.what());
  return 2;
}
