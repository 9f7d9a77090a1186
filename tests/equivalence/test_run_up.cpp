// A run-up is the same passage as a scene whose places are all shifted by hand.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "drivers/engine/simulation.hpp"
#include "drivers/engine/start/preload.hpp"
#include "drivers/engine/start/step_limit.hpp"
#include "drivers/run/fork.hpp"
#include "io/scene/scene_reader.hpp"
#include "tests/field_differences.hpp"

namespace tread {
namespace {

constexpr double kRunUp = 0.15;            ///< [m]
constexpr double kZone = 0.24;             ///< start of the solution zone [m]
constexpr double kStart = kZone - kRunUp;  ///< x of the wheel at t = 0 [m]

/// A tyre that rolls over a bar on two fastenings.
constexpr const char* kBar = R"([wheel]
shape = "tyre"
profile = "arc"
lateral_offset = "0 mm"
[rail]
profile = "box"
inclination = 0
length = "1.4 m"
[fastenings]
count = 3
spacing = "0.6 m"
first = "0.1 m"
pad_length = "60 mm"
pad_width = "40 mm"
damping = "20 kN s/m"
columns = 2
rows = 2
[slab]
pitch = "0.6 m"
gap = "50 mm"
width = "0.4 m"
[load]
wheel_load = "60 kN"
[vehicle]
present = false
[motion]
speed = "360 km/h"
duration = "1.5 ms"
)";

/// The library's half wheelset on three fastenings.
constexpr const char* kWheelset = R"([rail]
length = "1.4 m"
[fastenings]
count = 2
first = "0.35 m"
[motion]
speed = "100 km/h"
duration = "0.1 ms"
)";

std::string at(const char* key, double x) {
  return fmt::format("{}={} m", key, x);
}

/// The passage with a run-up, or, `by` metres backwards, without it.
Scene scene_of(const std::string& bodies, std::vector<std::string> overrides, bool by_hand) {
  const double by = by_hand ? kStart : 0;
  const std::vector<std::string> places = {at("rail.origin", 0.6 + by),
                                           at("solution_zone.start", kZone - by),
                                           at("corrugation.start", kZone + 0.01 - by),
                                           at("contact.friction_start", kZone - by),
                                           at("probe.head.x", kStart + 0.02 - by),
                                           at("probe.tread.x", kStart + 0.01 - by),
                                           at("surface.flat.at", kStart + 0.03 - by),
                                           at("surface.dent.at", kStart - by),
                                           "surface.flat.kind=flat",
                                           "surface.flat.length=20 mm",
                                           "surface.dent.kind=dent",
                                           "surface.dent.depth=0.02 mm",
                                           "surface.dent.length=30 mm",
                                           "surface.dent.width=30 mm",
                                           "probe.head.quantity=all",
                                           "probe.head.y=9 mm",
                                           "probe.tread.y=9 mm",
                                           "probe.tread.body=wheel",
                                           "probe.tread.quantity=stress",
                                           "probe.tread.depth=3 mm",
                                           "solution_zone.length=0.12 m",
                                           "corrugation.wavelength=40 mm",
                                           "corrugation.length=0.1 m",
                                           "corrugation.centre=0 mm",
                                           "corrugation.apply=gap",
                                           "contact.friction_law=table",
                                           "contact.friction_file=friction.txt",
                                           "output.fastening_forces=true",
                                           "output.stress_depth=20 mm",
                                           "motion.traction.mu=0.1",
                                           "motion.traction.ramp=0.1 ms"};
  overrides.insert(overrides.end(), places.begin(), places.end());
  if (!by_hand) overrides.push_back(at("motion.run_up", kRunUp));
  SceneSource source{"run-up", "[scene]\nbased_on = \"highspeed-slab-2014\"\n" + bodies, "/nowhere"};
  source.files["/nowhere/friction.txt"] =
      std::make_shared<const std::string>("# x [mm]  f [-]\n-140 0.3\n100 0.4\n");
  return resolve_scene(source, overrides).scene;
}

/// Values of the samples of a run, those of the wheel's place first. `dt` [s]; 0: the scene's.
struct Passage {
  double dt = 0;
  Preload preload;
  std::vector<double> x;                  ///< of the wheel [m]
  std::vector<std::vector<double>> rows;  ///< by sample
};

Passage roll(const Scene& scene, double dt) {
  Model model(scene);
  Passage run;
  run.dt = dt > 0 ? dt : scene.motion->step_safety * step_limit(model).stable_step;
  run.preload = solve_preload(model, steady_motion(model), [](const std::string&) {});
  model.apply_corrugation(*scene.corrugation->centre);
  Simulation simulation(model, run.preload, run.dt);
  simulation.set_sampling_interval(20);
  while (simulation.time() < scene.motion->duration) {
    simulation.step();
    if (!simulation.sampled()) continue;
    const Sample& s = simulation.sample();
    run.x.push_back(s.wheel_x);
    std::vector<double> row = {s.wheel_z,    s.vertical_force, s.longitudinal_force,     s.creepage_mean,
                               s.patch_area, s.max_shear,      s.energy.frictional_work, s.corrugation_depth};
    const auto measured = simulation.measurements().values();
    row.insert(row.end(), measured.begin(), measured.end());
    run.rows.push_back(std::move(row));
  }
  return run;
}

std::vector<double> column(const Passage& run, std::size_t c) {
  std::vector<double> values;
  for (const std::vector<double>& row : run.rows) values.push_back(row[c]);
  return values;
}

void expect_same_passage(const std::string& bodies, const std::vector<std::string>& overrides) {
  constexpr double kRounding = 1e-6;  // of a column's largest value
  const Passage here = roll(scene_of(bodies, overrides, false), 0);
  const Passage there = roll(scene_of(bodies, overrides, true), here.dt);
  EXPECT_EQ(here.preload.wheel.origin.x, kStart);
  EXPECT_NEAR(here.preload.rail_deflection, there.preload.rail_deflection, 1e-9);
  EXPECT_NEAR(here.preload.slab_deflection, there.preload.slab_deflection, 1e-9);
  ASSERT_EQ(here.rows.size(), there.rows.size());
  for (std::size_t i = 0; i < here.x.size(); ++i) EXPECT_NEAR(here.x[i], there.x[i] + kStart, 1e-9) << i;
  for (std::size_t c = 0; c < here.rows.front().size(); ++c) {
    const std::vector<double> values = column(here, c);
    EXPECT_LE(samples::difference(column(there, c), values), kRounding * samples::largest(values))
        << "column " << c;
  }
  EXPECT_GT(here.rows.back()[1], 1e4);
}

TEST(RunUp, IsAShiftOfAllPlaces) {
  for (const char* start : {"rolling", "moving"}) {
    SCOPED_TRACE(start);
    expect_same_passage(kBar, {"scene.element_size=12 mm", std::string("motion.start=") + start});
  }
}

TEST(RunUp, IsAShiftForAPartOfARing) {
  expect_same_passage(kBar, {"scene.element_size=12 mm", "scene.gravity=0 m/s2", "wheel.bore=guided",
                             "wheel.overhang=0.1 m", "motion.start=moving"});
}

TEST(RunUp, IsAShiftForAWheelset) {
  expect_same_passage(kWheelset, {"scene.element_size=11 mm", "slab.present=false"});
}

TEST(RunUp, MovesTheStateForForks) {
  const auto time = [](bool by_hand) {
    const Scene scene = scene_of(kBar, {}, by_hand);
    return approach_of(scene, 0.03).time(*scene.motion, scene.corrugation->start);
  };
  EXPECT_GT(time(false), 0);
  EXPECT_NEAR(time(false), time(true), 1e-12);
}

}  // namespace
}  // namespace tread
