// The rail at the start of a wheel that has been rolling over the fastenings.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "drivers/engine/simulation.hpp"
#include "drivers/engine/start/preload.hpp"
#include "drivers/results/measured_rows.hpp"
#include "io/scene/scene_reader.hpp"
#include "tests/measured.hpp"

namespace tread {
namespace {

/// Range of a point's vertical velocity over the first 60 us, on the crown 1.1 m before the wheel [m/s].
double range_of_velocity(const std::string& start) {
  Model model(read_scene(
      std::string(TREAD_SOURCE_DIR) + "/scenes/smooth.toml",
      {"scene.element_size=11 mm", "motion.traction.mu=0", "motion.duration=1 ms",
       "probe.far.quantity=motion", "output.frames=0", "probe.far.x=-1.1 m", "motion.start=" + start}));
  const Preload preload = solve_preload(model, steady_motion(model), [](const std::string& /*text*/) {});
  Simulation simulation(model, preload, 3e-7);
  simulation.set_sampling_interval(1);
  const std::size_t column = MeasuredRows(simulation.measurements().channels()).column("far_velocity_z");
  std::vector<double> velocity;
  while (simulation.time() < 60e-6) {
    simulation.step();
    velocity.push_back(simulation.measurements().values()[column]);
  }
  const auto [least, most] = std::minmax_element(velocity.begin(), velocity.end());
  return *most - *least;
}

/// Sections that start without their Poisson contraction ring a hundred times as much.
TEST(RollingStart, LeavesTheRailFarFromTheWheelQuiet) {
  const double rolling = range_of_velocity("rolling");
  const double moving = range_of_velocity("moving");
  measured("range of the rail's velocity, rolling start [mm/s]", 1e3 * rolling);
  measured("moving start [mm/s]", 1e3 * moving);
  EXPECT_LT(rolling, 4 * moving);
}

}  // namespace
}  // namespace tread
