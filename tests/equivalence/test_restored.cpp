// A state that is copied into a fresh simulation goes on unchanged, with the same bits.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "core/parallel/parallel.hpp"
#include "drivers/engine/simulation.hpp"
#include "drivers/engine/start/preload.hpp"
#include "drivers/engine/start/step_limit.hpp"
#include "drivers/results/run_results.hpp"
#include "tests/state_copies.hpp"
#include "tests/tyre_scene.hpp"

namespace tread {
namespace {

struct Run {
  Model model;
  std::unique_ptr<Simulation> simulation;

  explicit Run(const Scene& scene) : model(scene) {}
  void roll(std::int64_t steps) {
    while (simulation->steps() < steps) simulation->step();
  }
};

/// Rolls a run through. Beside it, rolls another run up to a step that is not sampled and goes on in a fresh
/// model with other threads.
void expect_same_bits(const Scene& scene, std::int64_t steps) {
  Run whole(scene);
  const Preload preload =
      solve_preload(whole.model, steady_motion(whole.model), [](const std::string& /*text*/) {});
  const auto corrugate = [&](Model& model) {
    if (scene.corrugation) model.apply_corrugation(preload.contact.pressure_peak.y);
  };
  corrugate(whole.model);
  const double dt = scene.motion->step_safety * step_limit(whole.model).stable_step;
  whole.simulation = std::make_unique<Simulation>(whole.model, preload, dt);
  whole.simulation->set_sampling_interval(50);
  const std::int64_t half = steps / 2;
  whole.roll(half);

  Run resumed(scene);
  corrugate(resumed.model);
  resumed.simulation = std::make_unique<Simulation>(resumed.model, preload.contact.centre.y, dt);
  resumed.simulation->set_sampling_interval(50);
  samples::copy(whole.simulation->state(), resumed.simulation->state());
  if (testing::Test::HasFatalFailure()) return;

  whole.roll(steps);
  set_threads(2);
  resumed.roll(steps);
  set_threads(1);
  EXPECT_EQ(samples::differences(whole.simulation->state(), resumed.simulation->state()), "");
  EXPECT_EQ(whole.simulation->state_hash(), resumed.simulation->state_hash());
  const std::vector<double> row = history_row(whole.model, whole.simulation->sample());
  EXPECT_EQ(row, history_row(resumed.model, resumed.simulation->sample()));
  for (const double value : row) EXPECT_TRUE(std::isfinite(value));
  EXPECT_EQ(whole.simulation->momentum_check().change.z, resumed.simulation->momentum_check().change.z);
}

TEST(Restored, TyreUnderTractionOverCorrugation) {
  expect_same_bits(
      samples::tyre_scene(
          {"scene.element_size=8 mm", "motion.duration=0.5 ms", "motion.traction.torque=13.8 kN m",
           "motion.traction.ramp=0.05 ms", "solution_zone.start=5 mm", "corrugation.kind=sine",
           "corrugation.wavelength=20 mm", "corrugation.depth=0.04 mm", "corrugation.width=30 mm",
           "corrugation.start=5 mm", "corrugation.length=40 mm", "corrugation.apply=gap"}),
      700);
}

TEST(Restored, MovedNodesAndFacets) {
  expect_same_bits(
      samples::tyre_scene({"scene.element_size=8 mm", "motion.duration=0.5 ms", "solution_zone.start=5 mm",
                           "contact.surface=facets", "corrugation.kind=sine", "corrugation.wavelength=20 mm",
                           "corrugation.depth=0.04 mm", "corrugation.width=30 mm", "corrugation.start=5 mm",
                           "corrugation.length=40 mm", "corrugation.apply=nodes"}),
      300);
}

TEST(Restored, MixedAndSinglePrecision) {
  for (const char* precision : {"scene.precision=mixed", "scene.precision=single"})
    expect_same_bits(samples::tyre_scene({"scene.element_size=8 mm", "motion.duration=0.5 ms", precision,
                                          "motion.traction.torque=13.8 kN m", "motion.traction.ramp=0.05 ms",
                                          "solution_zone.start=5 mm"}),
                     300);
}

TEST(Restored, MaxwellBranches) {
  for (const char* precision : {"scene.precision=double", "scene.precision=mixed"})
    expect_same_bits(
        samples::tyre_with_maxwell_branches({"scene.element_size=8 mm", "motion.duration=0.5 ms", precision}),
        300);
}

TEST(Restored, FallingFriction) {
  expect_same_bits(samples::tyre_scene({"scene.element_size=8 mm", "motion.duration=0.5 ms",
                                        "motion.creepage=0.05", "solution_zone.start=5 mm",
                                        "contact.friction_law=falling", "contact.friction_memory=0.2 mm"}),
                   600);
}

TEST(Restored, OnlyALawWithAStateListsOne) {
  const auto listed = [](const std::vector<std::string>& overrides) {
    Model model(samples::tyre_scene(overrides));
    StateList list;
    model.contact->list_state(list);
    return std::any_of(list.fields().begin(), list.fields().end(),
                       [](const StateList::Field& field) { return field.name == "friction"; });
  };
  EXPECT_FALSE(listed({"scene.element_size=8 mm"}));
  EXPECT_TRUE(
      listed({"scene.element_size=8 mm", "contact.friction_law=falling", "contact.friction_memory=0.2 mm"}));
}

TEST(Restored, GuidedBore) {
  expect_same_bits(
      samples::tyre_scene({"scene.element_size=8 mm", "motion.duration=0.5 ms", "wheel.bore=guided",
                           "motion.traction.torque=5 kN m", "motion.traction.ramp=0.05 ms"}),
      600);
}

TEST(Restored, HammerOnARailOnFastenings) {
  expect_same_bits(read_scene(std::string(TREAD_SOURCE_DIR) + "/scenes/hammer.toml"), 400);
}

TEST(Restored, WheelsetWithAVehicleOnFastenings) {
  expect_same_bits(
      read_scene(std::string(TREAD_SOURCE_DIR) + "/scenes/smooth.toml",
                 {"scene.element_size=8 mm", "motion.duration=0.1 ms", "motion.start=moving",
                  "slab.present=false", "rail.length=2.6 m", "rail.origin=1.3 m", "fastenings.count=4",
                  "fastenings.first=0.325 m", "solution_zone.start=20 mm", "solution_zone.length=50 mm"}),
      300);
}

}  // namespace
}  // namespace tread
