// One thread or several, OpenMP or TBB, give the same bits.

#include <gtest/gtest.h>

#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include "core/parallel/parallel.hpp"
#include "drivers/engine/simulation.hpp"
#include "drivers/engine/start/preload.hpp"
#include "drivers/engine/start/step_limit.hpp"
#include "tests/tyre_scene.hpp"

namespace tread {
namespace {

struct Run {
  std::uint64_t hash;
  double preload_residual;
  double dt;
  Sample sample;
};

/// Mesh, preload, corrugation, step and rolling of a small scene with all parts that a wheel can have.
Run run(const Scene& scene, int threads, std::string_view by) {
  set_backend(by);
  set_threads(threads);
  Model model(scene);
  const Preload preload = solve_preload(model, {}, [](const std::string&) {});
  if (scene.corrugation) model.apply_corrugation(preload.contact.pressure_peak.y);
  const double dt = scene.motion->step_safety * step_limit(model).stable_step;
  Simulation simulation(model, preload, dt);
  simulation.set_sampling_interval(50);
  const auto steps = static_cast<std::int64_t>(std::ceil(scene.motion->duration / dt));
  while (simulation.steps() < steps) simulation.step();
  set_threads(1);
  set_backend(backends().front());
  return {simulation.state_hash(), preload.residual, dt, simulation.sample()};
}

/// Compares the bits of a run with one thread and of runs by the given pairs of threads and backend.
void expect_same_bits(const Scene& scene, const std::vector<std::pair<int, std::string_view>>& teams) {
  const Run one = run(scene, 1, "openmp");
  EXPECT_GT(one.sample.vertical_force, 1e4);
  EXPECT_GT(one.sample.energy.frictional_work, 0);
  EXPECT_TRUE(std::isfinite(one.sample.energy.residual));
  for (const auto& [threads, by] : teams) {
    const Run more = run(scene, threads, by);
    EXPECT_EQ(more.hash, one.hash) << threads << " threads by " << by;
    EXPECT_EQ(more.preload_residual, one.preload_residual);
    EXPECT_EQ(more.dt, one.dt);
    EXPECT_EQ(more.sample.vertical_force, one.sample.vertical_force);
    EXPECT_EQ(more.sample.longitudinal_force, one.sample.longitudinal_force);
    EXPECT_EQ(more.sample.energy.residual, one.sample.energy.residual);
    EXPECT_EQ(more.sample.energy.frictional_work, one.sample.energy.frictional_work);
  }
}

TEST(Threads, RollingOverCorrugationGivesTheSameBits) {
  expect_same_bits(samples::tyre_scene(
                       {"scene.element_size=6 mm", "motion.duration=0.1 ms",
                        "motion.traction.torque=13.8 kN m", "motion.traction.ramp=0.05 ms",
                        "material.steel.damping={ kind = \"high_frequency_fraction\", value = 0.01 }",
                        "solution_zone.start=5 mm", "corrugation.kind=sine", "corrugation.wavelength=20 mm",
                        "corrugation.depth=0.04 mm", "corrugation.width=30 mm", "corrugation.start=5 mm",
                        "corrugation.length=40 mm", "corrugation.apply=gap"}),
                   {{2, "openmp"}, {3, "openmp"}, {1, "tbb"}, {2, "tbb"}, {3, "tbb"}});
}

TEST(Threads, MaxwellBranchesGiveTheSameBits) {
  for (const char* precision : {"scene.precision=double", "scene.precision=mixed"})
    expect_same_bits(samples::tyre_with_maxwell_branches(
                         {"scene.element_size=6 mm", "motion.duration=0.05 ms", precision}),
                     {{3, "openmp"}, {2, "tbb"}});
}

TEST(Threads, FlatAndDentGiveTheSameBits) {
  for (const char* surface : {"contact.surface=exact", "contact.surface=facets"})
    expect_same_bits(
        samples::tyre_scene({"scene.element_size=6 mm", "motion.duration=0.05 ms", "solution_zone.start=5 mm",
                             surface, "surface.flat.kind=flat", "surface.flat.at=10 mm",
                             "surface.flat.length=30 mm", "surface.dent.kind=dent", "surface.dent.at=-4 mm",
                             "surface.dent.depth=0.05 mm", "surface.dent.length=30 mm",
                             "surface.dent.width=20 mm"}),
        {{3, "openmp"}, {3, "tbb"}});
}

TEST(Threads, FacetsAndMovedNodesGiveTheSameBits) {
  expect_same_bits(
      samples::tyre_scene({"scene.element_size=6 mm", "motion.duration=0.05 ms", "solution_zone.start=5 mm",
                           "contact.surface=facets", "corrugation.kind=sine", "corrugation.wavelength=20 mm",
                           "corrugation.depth=0.04 mm", "corrugation.width=30 mm", "corrugation.start=5 mm",
                           "corrugation.length=40 mm", "corrugation.apply=nodes"}),
      {{3, "openmp"}, {3, "tbb"}});
}

}  // namespace
}  // namespace tread
