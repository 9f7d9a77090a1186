// Nodes that move with the elements of their tile, or all after them, give the same bits.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/parallel/parallel.hpp"
#include "drivers/engine/simulation.hpp"
#include "drivers/engine/start/preload.hpp"
#include "tests/tyre_scene.hpp"

namespace tread {
namespace {

constexpr int kSteps = 70;  // some steps are measured in either run

/// Bodies without strain, the wheel pressed into the rail by a place of its turn [rad].
Preload pressed(const Model& model, double place) {
  Preload preload;
  preload.displacement.assign(static_cast<std::size_t>(3 * model.mesh.slots), 0.0);
  if (model.contact) preload.wheel.origin.z = model.contact->touching_height() - 5e-5;
  preload.wheel.angle = -place;
  return preload;
}

struct Run {
  std::uint64_t hash;
  Vec3 contact_impulse;
  Sample last;
};

/// Runs the model. Measured steps move all nodes after the elements.
Run run(Model& model, int threads, bool measure_every_step, double place) {
  set_threads(threads);
  Simulation simulation(model, pressed(model, place), 5e-8);
  simulation.set_sampling_interval(measure_every_step ? 1 : kSteps - 1);
  while (simulation.steps() < kSteps) simulation.step();
  set_threads(1);
  return {simulation.state_hash(), simulation.momentum_check().contact_impulse, simulation.sample()};
}

void expect_same_bits(const Scene& scene, double place = 0) {
  const auto model = [&] {
    auto made = std::make_unique<Model>(scene);
    if (scene.corrugation) made->apply_corrugation(0);
    return made;
  };
  const Run all_after = run(*model(), 1, true, place);
  if (scene.contact) {
    EXPECT_GT(all_after.contact_impulse.z, 0);
  }
  for (const int threads : {1, 2, 3}) {
    const Run with_elements = run(*model(), threads, false, place);
    EXPECT_EQ(with_elements.hash, all_after.hash) << threads << " threads";
    EXPECT_EQ(with_elements.last.energy.strain, all_after.last.energy.strain);
    EXPECT_EQ(with_elements.last.energy.kinetic, all_after.last.energy.kinetic);
  }
}

Scene scene_of(const std::string& text, const std::vector<std::string>& overrides) {
  return resolve_scene(SceneSource{"small.toml", text, {}}, overrides).scene;
}

const std::vector<std::string> kShortTrack = {
    "scene.element_size=6 mm", "rail.length=2.7 m",         "rail.origin=1.3 m",         "fastenings.count=4",
    "fastenings.first=0.3 m",  "solution_zone.start=-5 mm", "solution_zone.length=40 mm"};

TEST(MovesWithElements, WheelsetOnSlabTrack) {
  const Scene scene = scene_of(R"([scene]
based_on = "highspeed-slab-2014"
[material.steel]
damping = { kind = "high_frequency_fraction", value = 0.01 }
[motion]
duration = "0.1 ms"
traction = { torque = "13.8 kN m", ramp = "2 us" }
[corrugation]
start = "-5 mm"
wavelength = "20 mm"
length = "40 mm"
)",
                               kShortTrack);
  const Model model(scene);
  ASSERT_TRUE(model.ties && model.fastenings && !model.journal.empty() && !model.torque.empty());
  ASSERT_GE(model.index.slab, 0);
  expect_same_bits(scene);
}

TEST(MovesWithElements, PatchAtTheEndOfATurn) {
  for (const char* precision : {"scene.precision=double", "scene.precision=mixed"}) {
    std::vector<std::string> overrides = kShortTrack;
    overrides.insert(overrides.end(), {"motion.duration=0.05 ms", precision});
    const Scene scene = scene_of("[scene]\nbased_on = \"highspeed-slab-2014\"\n", overrides);
    const Model model(scene);
    const SweptBlock& tread = model.mesh.blocks[static_cast<std::size_t>(model.index.tread)];
    ASSERT_TRUE(tread.closed);
    expect_same_bits(scene, tread.stations.front());
  }
}

TEST(MovesWithElements, MaxwellBranchOnATiedRail) {
  std::vector<std::string> overrides = kShortTrack;
  overrides.insert(overrides.end(),
                   {"slab.present=false", "motion.duration=0.05 ms",
                    "material.steel.damping={ kind = \"rayleigh_beta\", value = \"1e-5 s\" }",
                    "material.steel.damping_up_to=10 kHz"});
  const Scene scene = scene_of("[scene]\nbased_on = \"highspeed-slab-2014\"\n", overrides);
  ASSERT_TRUE(Model(scene).ties);
  expect_same_bits(scene);
}

TEST(MovesWithElements, GuidedBoreOverMovedNodes) {
  expect_same_bits(samples::tyre_scene(
      {"scene.element_size=6 mm", "scene.gravity=0 m/s2", "motion.duration=0.1 ms", "wheel.bore=guided",
       "wheel.overhang=60 mm", "motion.traction.torque=5 kN m", "motion.traction.ramp=2 us",
       "solution_zone.start=-5 mm", "corrugation.kind=sine", "corrugation.wavelength=20 mm",
       "corrugation.depth=0.04 mm", "corrugation.width=30 mm", "corrugation.start=-5 mm",
       "corrugation.length=40 mm", "corrugation.apply=nodes"}));
}

TEST(MovesWithElements, HammerOnAFastenedRail) {
  std::vector<std::string> overrides = kShortTrack;
  overrides.resize(5);
  expect_same_bits(scene_of(R"([scene]
based_on = "highspeed-slab-2014"
[wheel]
present = false
[vehicle]
present = false
[contact]
present = false
[slab]
present = false
[hammer]
force = "1 kN"
duration = "2 us"
[motion]
duration = "0.1 ms"
)",
                            overrides));
}

}  // namespace
}  // namespace tread
