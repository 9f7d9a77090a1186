// The ends of the range, on coarse models: the energy stop, the stable step, damping and element shapes.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "core/error.hpp"
#include "drivers/engine/energy_watch.hpp"
#include "drivers/engine/simulation.hpp"
#include "drivers/engine/static_system.hpp"
#include "drivers/verify/small_models.hpp"
#include "io/scene/scene_reader.hpp"
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

}  // namespace
}  // namespace tread
