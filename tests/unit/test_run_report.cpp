#include <gtest/gtest.h>

#include <cstddef>
#include <filesystem>
#include <string>

#include "drivers/report/run_report.hpp"
#include "drivers/results/run_results.hpp"
#include "tests/program.hpp"
#include "tests/temporary_folder.hpp"
#include "tests/tyre_scene.hpp"

namespace tread {
namespace {

/// A tyre on three fastenings under a torque, rolling over 0.2 m.
TEST(RunReport, SaysWhenItsValuesAreNotSteady) {
  const Model model(samples::tyre_scene(
      {"scene.element_size=12 mm", "solution_zone.start=100 mm", "rail.support=fastenings",
       "rail.height=150 mm", "rail.length=1.5 m", "rail.origin=0.75 m", "fastenings.count=3",
       "fastenings.spacing=0.6 m", "fastenings.first=0.15 m", "fastenings.pad_width=40 mm",
       "motion.start=moving", "motion.traction.mu=0.21", "motion.traction.ramp=0 ms"}));
  RunResults results;
  results.dt = 1e-6;
  results.preload.displacement.resize(static_cast<std::size_t>(3 * model.mesh.slots));
  results.preload.traction = 0.21;
  for (int i = 0; i <= 200; ++i) {
    Sample sample;
    sample.wheel_x = 1e-3 * i;
    sample.time = sample.wheel_x / model.scene.motion->speed;
    sample.vertical_force = model.wheel_load();
    sample.longitudinal_force = 0.2 * sample.vertical_force;
    sample.patch_area = 1e-4;
    results.samples.push_back(sample);
  }
  const samples::TemporaryFolder temporary;
  const auto report = [&] {
    evaluate(model, results);
    const std::filesystem::path path = temporary.path / "report.html";
    write_run_report(path, model, {}, results, {});
    return samples::content_of(path);
  };
  const std::string steady = report();
  EXPECT_FALSE(samples::has(steady, "They are not steady"));
  EXPECT_TRUE(samples::has(steady, "0.2 (target 0.21)"));
  EXPECT_TRUE(samples::has(steady, "beam on the fastenings, foot held: "));
  for (std::size_t i = 75; i < results.samples.size(); ++i) results.samples[i].longitudinal_force *= 1.1;
  EXPECT_TRUE(samples::has(report(), "They are not steady: the chapter Warnings says why.")) << "F_L drifts";
}

}  // namespace
}  // namespace tread
