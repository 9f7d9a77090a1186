// The flexible half wheelset: what its spin does to its bending. [theory.md, Finite rotation]

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "drivers/preload.hpp"
#include "drivers/simulation.hpp"
#include "drivers/static_system.hpp"
#include "io/scene_reader.hpp"
#include "tests/measured.hpp"

namespace tread {
namespace {

/// The paper's wheelset and vehicle on a rail with a fixed foot: nothing but the spin can change its tilt.
const char* const kScene = R"([scene]
based_on = "highspeed-slab-2014"
element_size = "6 mm"
[solution_zone]
start = "0 m"
length = "0.3 m"
[slab]
present = false
[fastenings]
present = false
[rail]
support = "rigid"
length = "1.2 m"
origin = "0.4 m"
[contact]
friction = 0
[motion]
speed = "500 km/h"
duration = "2 ms"
)";

/// Largest change of the tilt while the wheelset rolls, relative to the static one.
double change_of_tilt(bool finite_rotation) {
  const Scene scene = resolve_scene(SceneSource{"wheelset.toml", kScene, {}}, {}).scene;
  Model model(scene);
  const double speed = scene.motion->speed;
  const Preload preload =
      solve_preload(model, {speed / model.wheel_radius(), speed}, [](const std::string&) {});
  measured("static tilt at 500 km/h", preload.tilt, "rad");
  if (!finite_rotation)
    for (const int block : model.index.wheel()) model.internal->set_finite_rotation(block, false);
  Simulation simulation(model, preload, scene.motion->step_safety * step_limit(model).stable_step);
  double change = 0;
  while (simulation.time() < scene.motion->duration) {
    for (int i = 0; i < 50; ++i) simulation.step();
    const double tilt = wheel_tilt(model, simulation.displacement().data(), simulation.wheel().angle);
    change = std::max(change, std::abs(tilt / preload.tilt - 1));
  }
  return change;
}

TEST(Wheelset, BentSpinningAxleKeepsItsTilt) {
  const double change = change_of_tilt(true);
  measured("change of the tilt", change);
  EXPECT_LT(change, 0.01);
  // The linear law lacks the stiffness of the spin stress.
  const double linear = change_of_tilt(false);
  measured("change of the tilt by the linear law", linear);
  EXPECT_GT(linear, 0.05);
}

}  // namespace
}  // namespace tread
