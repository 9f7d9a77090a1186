// Bars at the ends of their ranges.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "drivers/engine/start/start.hpp"
#include "drivers/engine/start/step_limit.hpp"
#include "io/scene/scene_reader.hpp"
#include "tests/bar_scene.hpp"
#include "tests/refusal.hpp"

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
  scene.materials.at("steel").youngs_modulus = 1e308;  // products exceed what a number holds
  const Model model(scene);
  const std::string text = samples::refusal<NumericalError>([&] { step_limit(model); });
  EXPECT_TRUE(text.starts_with("time step: the highest frequency of the assembled bodies is ")) << text;
}

/// Velocities at the start of a scene that has a pulse.
AlignedVector<double> pulse_velocities(const Model& model) {
  AlignedVector<double> u(static_cast<std::size_t>(3 * model.mesh.slots), 0.0), v(u.size(), 0.0);
  BodyFrame wheel;
  start_velocities(model, {}, {u, v, wheel});
  return v;
}

TEST(BarLimits, APulseFreesTheEndsOfARigidlySupportedBarAlone) {
  const Model model(bar({"rail.support=rigid"}));
  const SweptBlock& block = model.mesh.blocks.front();
  const std::vector<int>& foot = block.section.paths.at("foot");
  EXPECT_EQ(model.restrained.size(), 3 * foot.size() * static_cast<std::size_t>(block.station_count()));
  EXPECT_TRUE(Model(bar()).restrained.empty());
  const AlignedVector<double> v = pulse_velocities(model);
  for (const int station : {0, 5, 20})
    for (int node = 0; node < block.section.nodes(); ++node) {
      const bool held = std::count(foot.begin(), foot.end(), node) > 0;
      EXPECT_EQ(v[static_cast<std::size_t>(dof(block.base + block.slot(node, station), 0))],
                station < 10 && !held ? 1 : 0)
          << station << ", " << node;
    }
}

TEST(BarLimits, APulseLeavesTheSleepersAtRest) {
  const Model model(bar({"rail.support=fastenings", "rail.width=80 mm", "rail.height=150 mm",
                         "scene.element_size=20 mm", "fastenings.count=1", "fastenings.first=0.15 m",
                         "fastenings.pad_width=40 mm", "pulse.length=0.5 m",
                         "material.concrete.youngs_modulus=35 GPa", "material.concrete.poissons_ratio=0.2",
                         "material.concrete.density=2400 kg/m3", "sleepers.stiffness=40 MN/m"}));
  const AlignedVector<double> v = pulse_velocities(model);
  ASSERT_EQ(model.index.sleepers.size(), 1U);
  for (int b = 0; b < 2; ++b) {
    const SweptBlock& block = model.mesh.blocks[static_cast<std::size_t>(b)];
    double largest = 0;
    for (std::int64_t i = 3 * block.base; i < 3 * (block.base + block.slots()); ++i)
      largest = std::max(largest, v[static_cast<std::size_t>(i)]);
    EXPECT_EQ(largest, b == model.index.rail_cap ? 1 : 0) << block.name;
  }
}

}  // namespace
}  // namespace tread
