// The ends of the range, on coarse models: the energy stop, the stable step, damping and element shapes.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "drivers/engine/energy_watch.hpp"
#include "drivers/engine/simulation.hpp"
#include "drivers/engine/start/step_limit.hpp"
#include "drivers/verify/small_models.hpp"
#include "io/scene/scene_reader.hpp"
#include "kernels/solver/stable_step.hpp"
#include "tests/measured.hpp"
#include "tests/refusal.hpp"
#include "tests/verified_case.hpp"

namespace tread {
namespace {

EnergyLedger stored(double kinetic, double strain) {
  EnergyLedger energy;
  energy.kinetic = kinetic;
  energy.strain = strain;
  return energy;
}

TEST(EnergyWatch, LetsEnergyChangeItsKind) {
  EnergyWatch watch;
  watch.start(stored(100, 10), 0, 0);
  EXPECT_TRUE(watch.balanced(stored(60, 50), 0));
  EXPECT_NEAR(watch.missed(), 0, 1e-12);
  EXPECT_NEAR(watch.supplied(), 50, 1e-3);  // 10 stored, 40 from the motion
  EnergyLedger rubbed = stored(30, 10);
  rubbed.frictional_work = 70;
  EXPECT_TRUE(watch.balanced(rubbed, 0));
}

TEST(EnergyWatch, StopsWhereMoreAppearsOrVanishesThanWasSupplied) {
  for (const double change : {-15.0, 15.0}) {
    EnergyWatch watch;
    watch.start(stored(100, 10), 0, 0);
    EXPECT_TRUE(watch.balanced(stored(100, 10 + change), 0));
    EXPECT_FALSE(watch.balanced(stored(100, 10 + change), 0));
    EXPECT_NEAR(watch.missed(), change, 1e-12);
    EXPECT_GT(watch.share(), 1);
  }
}

TEST(EnergyWatch, SeesOscillationsBeyondTheStepWhoseBalanceCloses) {
  EnergyWatch watch;
  watch.start(stored(0, 10), 0, 0);
  EXPECT_TRUE(watch.balanced(stored(-100, 110), 220));
  EXPECT_TRUE(watch.balanced(stored(-1000, 1010), 2020));
  EXPECT_FALSE(watch.balanced(stored(-1000, 1010), 2020));
}

TEST(EnergyWatch, StopsAtWhatIsNotFinite) {
  for (const double value : {std::numeric_limits<double>::infinity(), std::nan("")}) {
    EnergyWatch watch;
    watch.start(stored(1, 1), 0, 0);
    EXPECT_FALSE(watch.balanced(stored(1, value), 0));
    EnergyWatch other;
    other.start(stored(1, 1), 0, 0);
    EXPECT_FALSE(other.balanced(stored(1, 1), value));
  }
}

TEST(EnergyStop, NamesTheStepThatIsTooLong) {
  const Scene scene = BarScene{}.scene();
  Model model(scene);
  const Preload preload = solve_preload(model, {}, [](const std::string&) {});
  const double stable = step_limit(model).stable_step;
  EXPECT_FALSE(run_small(scene, preload, stable, 2000).stopped);
  const SmallRun beyond = run_small(scene, preload, 1.02 * stable, 1000);
  EXPECT_TRUE(beyond.stopped);
  EXPECT_NE(beyond.reason.find("exceeds the stable step"), std::string::npos) << beyond.reason;
  measured("steps until 1.02 of the stable step is stopped", static_cast<double>(beyond.steps));
}

/// A step far beyond the stable one overflows between two looks at the energies.
TEST(EnergyStop, SurvivesWhatIsNoLongerFinite) {
  TyreScene tyre;
  tyre.element_size = 12e-3;
  const Scene scene = tyre.scene();
  Model model(scene);
  const Preload preload = solve_preload(model, steady_motion(model), [](const std::string&) {});
  const double stable = step_limit(model).stable_step;
  for (const double factor : {1.5, 10.0, 100.0}) {
    const SmallRun beyond = run_small(scene, preload, factor * stable, 1000);
    EXPECT_TRUE(beyond.stopped) << factor;
    EXPECT_NE(beyond.reason.find("exceeds the stable step"), std::string::npos) << factor << beyond.reason;
  }
}

TEST(Extremes, StepOnACoarseMesh) {
  expect_bounds_hold("extremes_step", {{"steps", "1000"}, {"long_steps", "20000"}});
}

TEST(Extremes, Damping) {
  expect_bounds_hold("extremes_damping", {{"steps", "2000"}});
}

TEST(Extremes, Elements) {
  expect_bounds_hold("extremes_elements", {});
}

/// The contact's elements of any size determine the step: dampers act on single nodes of the rail's foot.
TEST(Extremes, FastenersTakeNothingOfTheStepOfFineElements) {
  const auto step = [](const std::string& size, const std::string& damping) {
    const SceneSource hammer = load_scene_source(std::string(TREAD_SOURCE_DIR) + "/scenes/hammer.toml");
    const Model model(resolve_scene(hammer, {"rail.length=1.3 m", "rail.origin=0.65 m", "fastenings.count=2",
                                             "hammer.position=0 m", "scene.element_size=" + size,
                                             "fastenings.damping=" + damping})
                          .scene);
    return stable_step_of(model);
  };
  for (const char* size : {"1.1 mm", "1.6 mm"})
    EXPECT_GT(step(size, "200 kN s/m"), 0.99 * step(size, "0 N s/m")) << size;
}

/// A rail head of steel, tied to a base a hundred times as soft, under a hammer. Damping in s.
Scene rail_on_soft_base(double beta_of_head, double beta_of_base, const std::string& fastening_damping) {
  const SceneSource hammer = load_scene_source(std::string(TREAD_SOURCE_DIR) + "/scenes/hammer.toml");
  Scene scene = resolve_scene(hammer, {"rail.length=1.3 m", "rail.origin=0.65 m", "fastenings.count=2",
                                       "hammer.position=0 m", "scene.element_size=10 mm",
                                       "scene.gravity=0 m/s2", "fastenings.damping=" + fastening_damping})
                    .scene;
  Material& head = scene.materials.at("steel");
  head.high_frequency_fraction = 0;
  head.rayleigh_beta = beta_of_head;
  Material base = head;
  base.name = "soft";
  base.youngs_modulus *= 0.01;
  base.rayleigh_beta = beta_of_base;
  scene.materials["soft"] = base;
  scene.rail->material = "soft";
  scene.rail->head_material = "steel";
  return scene;
}

constexpr const char* kNoDamper = "0 N s/m";

double step_on_soft_base(double beta_of_head, double beta_of_base, const std::string& damper = kNoDamper) {
  return stable_step_of(Model(rail_on_soft_base(beta_of_head, beta_of_base, damper)));
}

TEST(StepLimit, DampingOfASoftPartLeavesTheStepOfTheStiffOne) {
  const double free_step = step_on_soft_base(0, 0);
  // At the limit of the step the damping makes the base three times as stiff.
  for (const char* damper : {kNoDamper, "500 kN s/m"}) {
    const Scene scene = rail_on_soft_base(0, free_step, damper);
    Model model(scene);
    const double step = step_limit(model).stable_step;
    EXPECT_GT(step, 0.99 * step_on_soft_base(0, 0, damper)) << damper;
    EXPECT_LT(step, 1.001 * free_step) << damper;
    const Preload preload = solve_preload(model, {}, [](const std::string&) {});
    const SmallRun run = run_small(scene, preload, step, 500);
    EXPECT_FALSE(run.stopped) << damper << ": " << run.reason;
  }
}

TEST(StepLimit, HeavyDampingOfASoftPartDecides) {
  const Scene free = rail_on_soft_base(0, 0, kNoDamper);
  Model undamped(free);
  const double free_step = stable_step_of(undamped);
  const double omega = undamped.internal->max_frequency(undamped.index.rail_base).omega;
  // Alone, the stiffest element of the base keeps a fifth of the step.
  const double alone = 0.2 * free_step;
  const Scene scene = rail_on_soft_base(0, 2 / (omega * omega * alone) - 0.5 * alone, kNoDamper);
  const double step = stable_step_of(Model(scene));
  measured("step / undamped", step / free_step);
  EXPECT_GT(step, 0.99 * alone);
  EXPECT_LT(step, 0.9 * free_step);
  const Preload preload = solve_preload(undamped, {}, [](const std::string&) {});
  EXPECT_FALSE(run_small(scene, preload, step, 2000).stopped);
  EXPECT_TRUE(run_small(scene, preload, 1.02 * step, 2000).stopped);
}

/// All parts alike, or damping that takes less than the tolerance: the formula, to the last digits.
TEST(StepLimit, TakesTheFormulaWhereThePartsDoNotMatter) {
  const double free_step = step_on_soft_base(0, 0);
  for (const auto& [of_head, of_base] : {std::pair(0.1, 0.1), std::pair(1e-4, 0.0), std::pair(0.0, 1e-4)}) {
    const double expected = stable_step(2 / free_step, std::max(of_head, of_base) * free_step);
    EXPECT_NEAR(step_on_soft_base(of_head * free_step, of_base * free_step) / expected, 1, 1e-12) << of_base;
  }
}

TEST(StepLimit, RefusalNamesTheMaterialAndItsElement) {
  const Scene free = rail_on_soft_base(0, 0, kNoDamper);
  const double free_step = stable_step_of(Model(free));
  Model heavy(rail_on_soft_base(0, 1e4 * free_step, kNoDamper));
  const std::string text =
      samples::refusal<InputError>([&] { solve_preload(heavy, {}, [](const std::string&) {}); });
  samples::expect_part(text, "s of material.soft needs");
  samples::expect_part(text, "in the stiffest element of rail (");
}

}  // namespace
}  // namespace tread
