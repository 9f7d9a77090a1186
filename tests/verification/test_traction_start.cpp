// A wheel that has long been rolling under traction has its longitudinal force from the first step on.

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "drivers/engine/simulation.hpp"
#include "drivers/engine/start/preload.hpp"
#include "drivers/engine/start/step_limit.hpp"
#include "drivers/engine/start/traction.hpp"
#include "kernels/half_space/half_space_steady.hpp"
#include "tests/refusal.hpp"
#include "tests/tyre_scene.hpp"

namespace tread {
namespace {

Scene scene_of(double traction, std::vector<std::string> overrides = {}) {
  overrides.insert(overrides.end(), {"motion.traction.mu=" + std::to_string(traction),
                                     "motion.traction.ramp=0 ms", "solution_zone.start=0 mm"});
  return samples::tyre_scene(overrides);
}

std::vector<Sample> roll(const Scene& scene, Preload& preload) {
  Model model(scene);
  preload = solve_preload(model, steady_motion(model), [](const std::string&) {});
  Simulation simulation(model, preload, scene.motion->step_safety * step_limit(model).stable_step);
  simulation.set_sampling_interval(10);
  std::vector<Sample> samples;
  while (simulation.time() < scene.motion->duration) {
    simulation.step();
    if (simulation.sampled()) samples.push_back(simulation.sample());
  }
  return samples;
}

TEST(TractionStart, KeepsTheForce) {
  for (const double traction : {0.2, -0.2}) {
    SCOPED_TRACE(traction);
    Preload preload;
    const std::vector<Sample> samples = roll(scene_of(traction), preload);
    EXPECT_NEAR(preload.traction, traction, 1e-12);
    EXPECT_LT(std::abs(preload.held_force_x), 1e-3 * 87564);
    double force = 0;
    double load = 0;
    for (const Sample& sample : samples) {
      EXPECT_NEAR(sample.longitudinal_force / sample.vertical_force, traction, 0.2 * std::abs(traction))
          << sample.time;
      force += sample.longitudinal_force;
      load += sample.vertical_force;
    }
    // Elements of 5 mm want another creepage than half-spaces.
    EXPECT_NEAR(force / load, traction, 0.1 * std::abs(traction));
  }
}

/// Carter's creepage, of a slice and of a cylinder on a box.
TEST(TractionStart, KeepsTheForceOfALineContact) {
  for (const bool slice : {true, false}) {
    SCOPED_TRACE(slice);
    Scene cylinder = scene_of(
        -0.2, {"wheel.width=10 mm", "rail.width=10 mm", "motion.duration=0.3 ms", "scene.element_size=3 mm"});
    cylinder.wheel->profile = "cylinder";
    cylinder.plane_strain = slice;
    Preload preload;
    for (const Sample& sample : roll(cylinder, preload))
      EXPECT_NEAR(sample.longitudinal_force / sample.vertical_force, -0.2, 0.03) << sample.time;
  }
}

/// The largest f of a table counts for nothing where the wheel starts.
TEST(TractionStart, RefusesAPatchThatSlides) {
  const auto refused = [](Scene scene) {
    const Model model(scene);
    EXPECT_THROW(steady_traction(model), InputError);
  };
  refused(scene_of(0.5));
  refused(scene_of(-0.5));
  // Rounding of torque and load must not let a coefficient that is that of friction pass.
  for (const char* load : {"80 kN", "81 kN", "87.6 kN"})
    EXPECT_THROW(steady_traction(Model(scene_of(0.5, {std::string("load.wheel_load=") + load}))), InputError);
  Scene slippery = scene_of(0.2);
  slippery.contact->friction_law = "table";
  slippery.contact->friction_x = {0, 1};
  slippery.contact->friction_at_x = {0.1, 0.5};
  refused(slippery);
}

TEST(TractionStart, NeedsNoRampAPatchThatSticksAndNoRigidStart) {
  const auto traction = [](const std::vector<std::string>& overrides) {
    return steady_traction(Model(scene_of(0.2, overrides)));
  };
  EXPECT_NEAR(traction({}), 0.2, 1e-12);
  EXPECT_EQ(steady_traction(Model(samples::tyre_scene({"motion.traction.mu=0.2"}))), 0);
  EXPECT_EQ(traction({"motion.start=rigid"}), 0);
  EXPECT_EQ(traction({"wheel.bore=guided"}), 0);
}

TEST(TractionStart, StatesTheCreepage) {
  const Model model(scene_of(0.2));
  const double creepage = start_creepage(model, 0.2);
  EXPECT_GT(creepage, 1e-4);
  EXPECT_LT(creepage, 5e-3);
  EXPECT_EQ(start_creepage(model, -0.2), -creepage);
  const half_space::SteadyCreepage theory = half_space::steady_creepage(
      {model.scene.elastic_pair().alike(), model.wheel_radius(), model.hertz_radius_y, model.wheel_load(),
       model.contact->friction_at_rest(model.scene.start_x()), 0.2 * model.wheel_load()});
  EXPECT_DOUBLE_EQ(creepage, theory.mean);
  Scene slippery = scene_of(0.15);
  slippery.contact->friction_law = "table";
  slippery.contact->friction_x = {0, 1};
  slippery.contact->friction_at_x = {0.2, 0.5};
  EXPECT_GT(start_creepage(Model(slippery), 0.15), 1.1 * start_creepage(model, 0.15));
  EXPECT_EQ(start_creepage(Model(scene_of(0.2, {"motion.creepage=0.001"})), 0.2), 0.001);
}

TEST(TractionStart, NamesTheKeysWhereNoCreepageIsFound) {
  const std::string text = samples::refusal<InputError>([] { start_creepage(Model(scene_of(0.2)), 0.51); });
  samples::expect_part(text, "on contact.friction = 0.5 is not found");
  samples::expect_part(text, "state motion.creepage, a smaller motion.traction.mu");
}

/// A nearly flat gap has an ellipse of Hertz that is wider than the bodies, which bear the load as a line.
TEST(TractionStart, StatesCartersCreepageWhereTheBodiesEndWithinTheEllipse) {
  const Model model(scene_of(0.2, {"wheel.crown_radius=100 m"}));
  ASSERT_EQ(model.line_width, 0);
  ASSERT_GT(model.hertz_patch.semi_axis_y, 0.03);
  const double semi_axis = line_semi_axis(model.wheel_radius(), model.scene.elastic_pair().contact_modulus(),
                                          model.wheel_load() / 0.06);
  const double carter = 0.5 * semi_axis / model.wheel_radius() * (1 - std::sqrt(1 - 0.2 / 0.5));
  EXPECT_NEAR(start_creepage(model, 0.2), carter, 1e-6 * carter);
}

}  // namespace
}  // namespace tread
