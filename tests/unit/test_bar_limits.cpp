// Bars at the ends of their ranges.

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "drivers/engine/static_system.hpp"
#include "io/scene/scene_reader.hpp"
#include "tests/bar_scene.hpp"

namespace tread {
namespace {

Scene bar(const std::vector<std::string>& overrides = {}) {
  return resolve_scene(SceneSource{"bar.toml", samples::kBar, {}}, overrides).scene;
}

TEST(BarLimits, ABarShorterThanAnElementHasOne) {
  const Model model(bar({"rail.length=1 mm", "pulse.length=0.5 mm"}));
  const SweptBlock& block = model.mesh.blocks.front();
  ASSERT_EQ(block.station_count(), 2);
  EXPECT_NEAR(block.stations[1] - block.stations[0], 1e-3, 1e-15);
  EXPECT_GT(stable_step_of(model), 0);
}

TEST(BarLimits, AStiffnessThatIsNotFiniteIsNamed) {
  Scene scene = bar();
  scene.materials.at("steel").youngs_modulus = std::numeric_limits<double>::infinity();
  const Model model(scene);
  try {
    step_limit(model);
    FAIL() << "accepted";
  } catch (const NumericalError& error) {
    EXPECT_EQ(std::string(error.what()).find("time step: the highest frequency of the assembled bodies is "),
              0U)
        << error.what();
  }
}

}  // namespace
}  // namespace tread
