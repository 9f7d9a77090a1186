#include "drivers/verify/small_models.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "drivers/verify/ride.hpp"
#include "io/scene/scene_reader.hpp"

namespace tread {

namespace {

std::string damping_line(const std::string& damping) {
  return damping.empty() ? "" : "damping = " + damping + "\n";
}

}  // namespace

Scene BarScene::scene() const {
  return resolve_scene(
             SceneSource{"verify",
                         fmt::format(R"([scene]
element_size = "{h} m"
gravity = "0 m/s2"
[material.steel]
youngs_modulus = "205.9 GPa"
poissons_ratio = {nu}
density = "7790 kg/m3"
{damping}[rail]
profile = "box"
support = "free"
inclination = 0
length = "{length} m"
origin = "0 m"
width = "{side} m"
height = "{side} m"
[pulse]
velocity = "1 m/s"
length = "{pulse} m"
[motion]
duration = "{duration} s"
)",
                                     fmt::arg("h", element_size), fmt::arg("nu", poissons_ratio),
                                     fmt::arg("damping", damping_line(damping)), fmt::arg("length", length),
                                     fmt::arg("side", 2 * element_size), fmt::arg("pulse", 0.3 * length),
                                     fmt::arg("duration", duration)),
                         {}})
      .scene;
}

Scene TyreScene::scene() const {
  const double margin = 0.3;
  const std::string text = fmt::format(
      R"([scene]
element_size = "{h} m"
[solution_zone]
start = "-20 mm"
length = "{zone} m"
[material.steel]
youngs_modulus = "205.9 GPa"
poissons_ratio = 0.3
density = "7790 kg/m3"
{damping}[wheel]
shape = "tyre"
profile = "arc"
diameter = "0.86 m"
crown_radius = "0.3 m"
width = "60 mm"
thickness = "60 mm"
lateral_offset = "0 mm"
[rail]
profile = "{rail}"
support = "{support}"
inclination = 0
length = "{length} m"
origin = "{margin} m"
[load]
wheel_load = "87564 N"
[contact]
{contact}
[motion]
speed = "{speed} m/s"
duration = "{duration} s"
{motion}
{more})",
      fmt::arg("h", element_size), fmt::arg("zone", 0.04 + speed * duration),
      fmt::arg("damping", damping_line(damping)), fmt::arg("rail", rail), fmt::arg("support", support),
      fmt::arg("length", 2 * margin + speed * duration), fmt::arg("margin", margin),
      fmt::arg("contact", contact), fmt::arg("speed", speed), fmt::arg("duration", duration),
      fmt::arg("motion", motion), fmt::arg("more", more));
  return resolve_scene(SceneSource{"verify", text, {}}).scene;
}

SmallRun run_small(const Scene& scene, const Preload& preload, double dt, std::int64_t steps,
                   const std::function<void(const Simulation&)>& see) {
  Model model(scene);  // contact carries histories: each run needs its own model
  WholeRun whole(model, preload, dt, steps, 16);
  const Simulation& simulation = whole.simulation;
  SmallRun run;
  try {
    whole.roll([&] {
      run.largest_share = std::max(run.largest_share, simulation.energy_watch().share());
      if (see) see(simulation);
    });
  } catch (const NumericalError& error) {
    run.stopped = true;
    run.reason = error.what();
  }
  run.steps = simulation.steps();
  return run;
}

}  // namespace tread
