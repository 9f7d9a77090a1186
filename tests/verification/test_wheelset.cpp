// The flexible half wheelset on its rail: what spin does to its bending, and the rail's deflection against a
// beam. [theory.md, Finite rotation]

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/mesh/structured.hpp"
#include "drivers/preload.hpp"
#include "drivers/simulation.hpp"
#include "drivers/static_system.hpp"
#include "io/scene_reader.hpp"
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
/// nothing but the spin can change the tilt.
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
}

TEST(Wheelset, LinearLawLacksTheStiffnessOfTheSpinStress) {
  const double linear = change_of_tilt(false);
  measured("change of the tilt by the linear law", linear);
  EXPECT_GT(linear, 0.05);
}

/// Deflection under a force at `origin` of a Timoshenko beam on the springs of the scene's fastenings. [m]
double beam_deflection(const Scene& scene, const AreaMoments& section, double force) {
  constexpr double kShearShare = 0.4;  // of a rail's area that carries shear
  constexpr int kElements = 760;
  const double length = scene.rail->length / kElements;
  const double bending = scene.steel.youngs_modulus * section.yy;
  const double phi =
      12 * bending / (kShearShare * section.area * scene.steel.shear_modulus() * length * length);
  Eigen::Matrix4d element;
  element << 12, 6 * length, -12, 6 * length,                                             //
      6 * length, (4 + phi) * length * length, -6 * length, (2 - phi) * length * length,  //
      -12, -6 * length, 12, -6 * length,                                                  //
      6 * length, (2 - phi) * length * length, -6 * length, (4 + phi) * length * length;
  element *= bending / (length * length * length * (1 + phi));
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(2 * kElements + 2, 2 * kElements + 2);
  for (int e = 0; e < kElements; ++e) stiffness.block<4, 4>(2 * e, 2 * e) += element;
  // Springs and force act on the nearest beam nodes by linear weights.
  const auto weights = [&](double x) {
    Eigen::VectorXd row = Eigen::VectorXd::Zero(2 * kElements + 2);
    const int e = std::min(static_cast<int>(x / length), kElements - 1);
    row[2 * e] = 1 - (x / length - e);
    row[2 * e + 2] = x / length - e;
    return row;
  };
  const FasteningSpec& fastenings = *scene.fastenings;
  for (int i = 0; i < fastenings.count; ++i)
    for (int column = 0; column < fastenings.columns; ++column) {
      const double x = fastenings.first + i * fastenings.spacing +
                       fastenings.pad_length * ((column + 0.5) / fastenings.columns - 0.5);
      const Eigen::VectorXd row = weights(x);
      const int at = 2 * std::min(static_cast<int>(x / length), kElements - 1);
      stiffness.block<4, 4>(at, at) +=
          fastenings.stiffness / fastenings.columns * row.segment<4>(at) * row.segment<4>(at).transpose();
    }
  const Eigen::VectorXd load = weights(scene.rail->origin);
  return force * load.dot(stiffness.ldlt().solve(load));
}

TEST(Rail, DeflectsAsATimoshenkoBeamOnTheFastenings) {
  const Scene scene = wheelset_scene(R"([motion]
speed = "0 m/s"
duration = "0.1 ms"
)");
  Model model(scene);
  const Preload preload = solve_preload(model, {}, [](const std::string&) {});
  std::vector<AreaMoments> parts;
  for (const int block : model.index.rail())
    parts.push_back(area_moments(model.mesh.blocks[static_cast<std::size_t>(block)].section));
  const double beam = beam_deflection(scene, sum(parts), model.wheel_load());
  measured("rail's foot under the wheel", preload.rail_deflection, "m");
  measured("Timoshenko beam", beam, "m");
  EXPECT_NEAR(preload.rail_deflection / beam, 1, 0.015);
}

}  // namespace
}  // namespace tread
