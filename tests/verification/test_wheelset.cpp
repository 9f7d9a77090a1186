// The flexible half wheelset on its rail: the effect of spin on its bending, and the rail's deflection
// against a beam. [theory.md, Finite rotation]

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "drivers/engine/beam/track_beam.hpp"
#include "drivers/engine/simulation.hpp"
#include "drivers/engine/start/poses.hpp"
#include "drivers/engine/start/preload.hpp"
#include "drivers/engine/start/rail_beam.hpp"
#include "drivers/engine/start/step_limit.hpp"
#include "io/scene/scene_reader.hpp"
#include "tests/measured.hpp"

namespace tread {
namespace {

/// The paper's wheelset, vehicle and rail on a coarse mesh without slab, and the tables in `more`.
Scene wheelset_scene(const std::string& more) {
  return resolve_scene(SceneSource{"wheelset.toml",
                                   R"([scene]
based_on = "highspeed-slab-2014"
element_size = "6 mm"
[solution_zone]
start = "0 m"
length = "0.3 m"
[slab]
present = false
)" + more,
                                   {}},
                       {})
      .scene;
}

/// Largest change of the tilt while the wheelset rolls, relative to the static one. The rail's foot is fixed:
/// only the spin can change the tilt.
double change_of_tilt(bool finite_rotation) {
  const Scene scene = wheelset_scene(R"([fastenings]
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
)");
  Model model(scene);
  const double speed = scene.motion->speed;
  const Preload preload =
      solve_preload(model, {speed / model.wheel_radius(), speed, false}, [](const std::string&) {});
  measured("static tilt at 500 km/h", preload.tilt, "rad");
  if (!finite_rotation)
    for (const int block : model.index.wheel()) model.internal->set_finite_rotation(block, false);
  Simulation simulation(model, preload, scene.motion->step_safety * step_limit(model).stable_step);
  double change = 0;
  while (simulation.time() < scene.motion->duration) {
    for (int i = 0; i < 50; ++i) simulation.step();
    const double tilt = wheel_tilt(model, simulation.displacement(), simulation.wheel().angle);
    change = std::max(change, std::abs(tilt / preload.tilt - 1));
  }
  return change;
}

TEST(Wheelset, BentSpinningAxleKeepsItsTilt) {
  const double change = change_of_tilt(true);
  measured("change of the tilt", change);
  EXPECT_LT(change, 0.01);
}

TEST(Wheelset, LinearLawLacksTheStiffnessOfTheSpinStress) {
  const double linear = change_of_tilt(false);
  measured("change of the tilt by the linear law", linear);
  EXPECT_GT(linear, 0.05);
}

TEST(Rail, DeflectsAsATimoshenkoBeamOnTheFastenings) {
  const Scene scene = wheelset_scene(R"([motion]
speed = "0 m/s"
duration = "0.1 ms"
)");
  Model model(scene);
  const Preload preload = solve_preload(model, {}, [](const std::string&) {});
  const BeamProperties properties = timoshenko(rail_beam_section(scene), scene.rail_material());
  const TrackBeam rail = rail_beam(scene, properties);
  const FasteningSpec& f = *scene.fastenings;
  const double weight = properties.mass * scene.gravity * f.spacing / f.stiffness;  // sinks the rail evenly
  const double beam = rail.deflection(rail.static_state(0, model.wheel_load()), 0) + weight;
  measured("rail's foot under the wheel", preload.rail_deflection, "m");
  measured("Timoshenko beam", beam, "m");
  EXPECT_NEAR(preload.rail_deflection / beam, 1, 0.005);
}

}  // namespace
}  // namespace tread
