// The rail's surface about the wheel: places of its samples, asymmetry, and the sample that is noted.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/mesh/structured.hpp"
#include "drivers/engine/simulation.hpp"
#include "drivers/engine/start/preload.hpp"
#include "drivers/results/deflection.hpp"
#include "tests/tyre_scene.hpp"

namespace tread {
namespace {

double hollow(double from_wheel) {
  return -1e-3 / (1 + 100 * from_wheel * from_wheel);
}

TEST(Deflection, IsReadAboutTheWheel) {
  Section section = rectangle(-0.03, 0.03, 2, -0.05, 0, 1);
  for (int node = 0; node < section.nodes(); ++node)
    if (section.q[static_cast<std::size_t>(node)] == 0) section.surface.push_back({0, {node, node}});
  ASSERT_EQ(section.surface.size(), 3U);
  const SweptBlock rail =
      make_swept_block("rail", Sweep::extruded, section, {Material{}}, -1, {{400, 5e-3, 0}});
  RailLine line(rail, 0.004);
  std::vector<double> u(static_cast<std::size_t>(3 * (rail.base + rail.slots())), 0.0);
  const auto press = [&](double wheel, double behind) {
    for (int node = 0; node < rail.section.nodes(); ++node)
      for (int station = 0; station < rail.station_count(); ++station) {
        const double from = rail.stations[static_cast<std::size_t>(station)] - wheel;
        const bool surface = rail.section.q[static_cast<std::size_t>(node)] == 0 &&
                             rail.section.p[static_cast<std::size_t>(node)] == 0;
        u[static_cast<std::size_t>(dof(rail.base + rail.slot(node, station), 2))] =
            surface ? hollow(from < 0 ? behind * from : from) : 1.0;
      }
  };
  press(0, 1);
  line.note_static(line.rise(u.data()));
  press(0.4, 0.7);
  line.note_rolling(u.data(), 0.4);

  const Deflection d = deflection(line, 0);
  ASSERT_EQ(d.x.size(), 401U);
  EXPECT_EQ(d.wheel_x, 0.4);
  for (std::size_t i = 0; i < d.x.size(); i += 50) {
    EXPECT_NEAR(d.at_rest[i], hollow(d.x[i]), 2e-6) << d.x[i];
    EXPECT_NEAR(d.rolling[i], hollow(d.x[i] < 0 ? 0.7 * d.x[i] : d.x[i]), 2e-6) << d.x[i];
  }
  EXPECT_LT(Deflection::asymmetry(d.at_rest), 1e-6);
  EXPECT_GT(Deflection::asymmetry(d.rolling), 0.1);
}

/// A start under traction has another static state.
TEST(Deflection, IsStaticWithoutTraction) {
  const auto at_rest = [](std::vector<std::string> overrides) {
    overrides.emplace_back("scene.element_size=12 mm");
    Model model(samples::tyre_scene(overrides));
    const Preload preload = solve_preload(model, steady_motion(model), [](const std::string& /*text*/) {});
    return Simulation(model, preload, 1e-7).rail_line()->at_rest();
  };
  const std::vector<double> free = at_rest({});
  EXPECT_LT(*std::min_element(free.begin(), free.end()), -1e-6);
  EXPECT_EQ(at_rest({"motion.traction.mu=0.3", "motion.traction.ramp=0 ms"}), free);
}

/// The zone's middle lies at x = -35 mm; the wheel starts at x = 0.
TEST(Deflection, IsNotedOnceWhereTheWheelStartsBeyondTheMiddleOfTheZone) {
  Model model(samples::tyre_scene({"scene.element_size=12 mm", "solution_zone.start=-60 mm"}));
  const Preload preload = solve_preload(model, steady_motion(model), [](const std::string& /*text*/) {});
  Simulation simulation(model, preload, 1e-7);
  simulation.set_sampling_interval(1);
  simulation.step();
  const RailLine& line = *simulation.rail_line();
  const double wheel_x = line.wheel_x();
  EXPECT_GT(wheel_x, 0);
  EXPECT_LT(*std::min_element(line.rolling().begin(), line.rolling().end()), -1e-6);
  simulation.step();
  EXPECT_EQ(line.wheel_x(), wheel_x);
}

}  // namespace
}  // namespace tread
