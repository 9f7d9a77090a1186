// Static contact against Hertz, and the motion of a wheel at rest. [theory.md, Preload]

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <numbers>
#include <string>

#include "core/aligned.hpp"
#include "core/error.hpp"
#include "core/mesh/node_field.hpp"
#include "drivers/engine/simulation.hpp"
#include "drivers/engine/start/poses.hpp"
#include "drivers/engine/start/preload.hpp"
#include "drivers/engine/start/step_limit.hpp"
#include "tests/measured.hpp"
#include "tests/refusal.hpp"
#include "tests/tyre_scene.hpp"

namespace tread {
namespace {

Scene sphere_on_block(const std::string& element_size) {
  return read_scene(std::filesystem::path(TREAD_SOURCE_DIR) / "scenes/sphere-on-block.toml",
                    {"scene.element_size=" + element_size});
}

struct StaticErrors {
  double force, residual, area, pressure, approach;  ///< the last three against Hertz, relative
};

StaticErrors press(const std::string& element_size) {
  const Scene scene = sphere_on_block(element_size);
  Model model(scene);
  const Preload preload = solve_preload(model, {}, [](const std::string&) {});
  const HertzPatch& hertz = model.hertz_patch;
  const double area = std::numbers::pi * hertz.semi_axis_x * hertz.semi_axis_y;
  // Pressure at the patch's middle from the load and area of the elements, not from the peak of one point.
  const double load = model.wheel_load();
  const StaticErrors errors = {-preload.contact.force_on_rail.z / load - 1, preload.residual,
                               preload.contact.area / area - 1,
                               model.contact->nodes().max_pressure() / hertz.max_pressure - 1,
                               preload.contact.max_penetration / hertz.approach};
  EXPECT_NEAR(hertz.semi_axis_x, 6.2964e-3, 3e-5);
  measured(element_size + ": F_N / load - 1", errors.force);
  measured(element_size + ": residual", errors.residual);
  measured(element_size + ": patch area / Hertz - 1", errors.area);
  measured(element_size + ": largest nodal pressure / Hertz - 1", errors.pressure);
  measured(element_size + ": penetration / Hertz approach", errors.approach);
  EXPECT_LT(std::abs(preload.contact.force_on_rail.y), 1e-3 * load);
  EXPECT_LT(std::abs(preload.held_force_x), 1e-3 * load);
  return errors;
}

TEST(Preload, SphereOnBlockNearsHertzUnderRefinement) {
  const StaticErrors coarse = press("4 mm");
  const StaticErrors fine = press("2 mm");
  for (const StaticErrors& e : {coarse, fine}) {
    EXPECT_LT(std::abs(e.force), 1e-3);
    EXPECT_LT(e.residual, 1e-6);
    EXPECT_LT(e.approach, 0.03);  // contact.penetration_ratio is 2 %
  }
  EXPECT_LT(std::abs(fine.area), 0.06);
  EXPECT_LT(std::abs(fine.pressure), 0.06);
  EXPECT_LT(std::abs(fine.pressure), std::abs(coarse.pressure));
}

TEST(Preload, SpinningWheelIsInBalance) {
  Model model(
      samples::tyre_scene({"motion.speed=500 km/h", "motion.duration=0.2 ms", "scene.element_size=5 mm"}));
  const Preload preload = solve_preload(model, steady_motion(model), [](const std::string&) {});
  const double error = -preload.contact.force_on_rail.z / model.wheel_load() - 1;
  measured("500 km/h: F_N / load - 1", error);
  EXPECT_LT(std::abs(error), 3e-5);  // inertia of the deflection that stands still, by differences
}

TEST(Preload, StandingWheelKeepsItsForce) {
  const Scene scene =
      samples::tyre_scene({"motion.speed=0 m/s", "motion.duration=0.2 ms", "scene.element_size=4 mm"});
  Model model(scene);
  const Preload preload = solve_preload(model, {}, [](const std::string&) {});
  const double dt = scene.motion->step_safety * step_limit(model).stable_step;
  Simulation simulation(model, preload, dt);
  simulation.set_sampling_interval(5);
  double low = 1e300, high = -1e300, residual = 0;
  while (simulation.time() < scene.motion->duration) {
    simulation.step();
    low = std::min(low, simulation.sample().vertical_force);
    high = std::max(high, simulation.sample().vertical_force);
    residual = std::max(residual, std::abs(simulation.sample().energy.residual));
  }
  const double load = model.wheel_load();
  measured("steps", static_cast<double>(simulation.steps()));
  measured("standing wheel: lowest F_N / load - 1", low / load - 1);
  measured("standing wheel: highest F_N / load - 1", high / load - 1);
  measured("standing wheel: largest energy residual", residual, "J");
  EXPECT_GT(low, 0.999 * load);
  EXPECT_LT(high, 1.001 * load);
}

TEST(StepLimit, RefusesAClassicalDampingThatWouldStopTheRun) {
  const Model usual(
      samples::tyre_scene({"material.steel.damping={ kind = \"rayleigh_beta\", value = \"1e-8 s\" }"}));
  EXPECT_GT(step_limit(usual).stable_step, 1e-8);
  const Model heavy(
      samples::tyre_scene({"material.steel.damping={ kind = \"rayleigh_beta\", value = \"1e-4 s\" }"}));
  const std::string text = samples::refusal<InputError>([&] { step_limit(heavy); });
  for (const char* part :
       {"s of material.steel needs", "state rayleigh_beta of at most", "damping_up_to = \"3 kHz\""})
    samples::expect_part(text, part);
  const Model banded(
      samples::tyre_scene({"material.steel.damping={ kind = \"rayleigh_beta\", value = \"1e-4 s\" }",
                           "material.steel.damping_up_to=3 kHz"}));
  EXPECT_GT(step_limit(banded).stable_step, 0.3 * step_limit(usual).stable_step);
}

TEST(Preload, ASliceOfWideBodiesHasOnePressureAcross) {
  Scene scene =
      samples::tyre_scene({"scene.element_size=3 mm", "scene.gravity=0 m/s2", "solution_zone.start=-20 mm",
                           "solution_zone.length=40 mm", "wheel.width=15 mm", "rail.width=15 mm",
                           "motion.present=false", "load.wheel_load=60 kN", "contact.friction=0"});
  scene.plane_strain = true;
  scene.wheel->profile = "cylinder";
  Model model(scene);
  solve_preload(model, {}, [](const std::string&) {});
  const PatchNodes& patch = model.contact->nodes();
  double largest = 0;
  double difference = 0;
  for (int i = patch.first(); i <= patch.last(); ++i)
    for (int row = 0; row < patch.grid().rows(); ++row) {
      const double pressure = patch.at(i, row).pressure;
      largest = std::max(largest, pressure);
      difference = std::max(difference, std::abs(pressure - patch.at(i, 0).pressure));
    }
  measured("difference of pressures across, over the largest", difference / largest);
  EXPECT_LT(difference, 1e-6 * largest);
}

/// The tread is divided finely near the patch alone: neither a shift nor an oval of the ring is a tilt.
TEST(Preload, TheTiltDoesNotDependOnWhereTheMeshIsFine) {
  constexpr double kTilt = 2e-3, kShift = 5e-4, kOval = 1e-3;
  const Model model(samples::tyre_scene());
  const SweptBlock& tread = model.mesh.blocks[static_cast<std::size_t>(model.index.tread)];
  AlignedVector<double> u(static_cast<std::size_t>(3 * model.mesh.slots), 0.0);
  for (int station = 0; station < tread.station_count(); ++station) {
    const double angle = tread.stations[static_cast<std::size_t>(station)];
    for (int node = 0; node < tread.section.nodes(); ++node) {
      const double down = tread.section.q[static_cast<std::size_t>(node)] * std::cos(angle);
      u[static_cast<std::size_t>(dof(tread.base + tread.slot(node, station), 1))] =
          kTilt * down + kShift + kOval * std::cos(2 * angle);
    }
  }
  EXPECT_NEAR(wheel_tilt(model, u.data(), 0), kTilt, 1e-3 * kTilt);
}

TEST(Preload, TiltsOfMirroredScenesAreOpposite) {
  const auto tilts = [](const char* offset) {
    Model model(
        samples::tyre_scene({std::string("wheel.lateral_offset=") + offset, "scene.element_size=8 mm"}));
    const Preload preload = solve_preload(model, {}, [](const std::string&) {});
    return std::array{preload.tilt, preload.rail_tilt};
  };
  const auto left = tilts("-8 mm"), middle = tilts("0 mm"), right = tilts("8 mm");
  EXPECT_GT(right[1], 1e-5);  // the wheel stands on the gauge side
  for (const std::size_t i : {0, 1}) {
    EXPECT_NEAR(left[i], -right[i], 1e-10);
    EXPECT_NEAR(middle[i], 0, 1e-10);
  }
}

}  // namespace
}  // namespace tread
