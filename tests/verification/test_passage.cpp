// Accumulated fields on the rail under a rolling tyre against the run's histories and energy balance.
// [theory.md, Fields of the surface]

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "drivers/engine/simulation.hpp"
#include "drivers/engine/start/preload.hpp"
#include "drivers/engine/start/step_limit.hpp"
#include "tests/measured.hpp"
#include "tests/tyre_scene.hpp"

namespace tread {
namespace {

TEST(Passage, FieldsSumToTheFrictionalWorkAndHoldTheLargestOfTheHistories) {
  const Scene scene = samples::tyre_scene({"scene.element_size=6 mm", "motion.duration=1.5 ms",
                                           "motion.traction.torque=13.8 kN m", "motion.traction.ramp=0.3 ms",
                                           "solution_zone.start=5 mm"});
  Model model(scene);
  const Preload preload = solve_preload(model, {}, [](const std::string&) {});
  const double dt = scene.motion->step_safety * step_limit(model).stable_step;
  Simulation simulation(model, preload, dt);
  simulation.set_sampling_interval(1);
  double pressure = 0;
  double shear = 0;
  while (simulation.time() < scene.motion->duration) {
    simulation.step();
    pressure = std::max(pressure, simulation.sample().max_pressure);
    shear = std::max(shear, simulation.sample().max_shear);
  }
  ASSERT_TRUE(simulation.surface());
  const SurfaceFields& fields = *simulation.surface();
  const double ledger = simulation.sample().energy.frictional_work;
  const double work = fields.sum(fields.frictional_work());
  const double sampled = fields.sum(fields.sampled_frictional_work());
  measured("sum over the surface / frictional work of the balance - 1", work / ledger - 1);
  measured("shear stress times slip speed, every step / frictional work - 1", sampled / ledger - 1);
  EXPECT_GT(ledger, 0.5);
  EXPECT_NEAR(work, ledger, 1e-10 * ledger);
  // The two differ by the energy stored in the elastic stick, and by points that leave contact.
  EXPECT_NEAR(sampled, ledger, 0.02 * ledger);
  EXPECT_EQ(*std::max_element(fields.max_pressure().begin(), fields.max_pressure().end()), pressure);
  EXPECT_EQ(*std::max_element(fields.max_shear().begin(), fields.max_shear().end()), shear);

  // Von Mises stress at the surface of a Hertz contact: (1 - 2 nu) p0 for a circle without friction. In full
  // slip it is larger by up to sqrt(3) f p0.
  const double stress = *std::max_element(fields.max_von_mises().begin(), fields.max_von_mises().end());
  measured("largest Von Mises stress of the surface elements / largest pressure", stress / pressure);
  EXPECT_GT(stress, 0.4 * pressure);
  EXPECT_LT(stress, (0.4 + std::sqrt(3.0) * scene.contact->friction) * pressure);
}

}  // namespace
}  // namespace tread
