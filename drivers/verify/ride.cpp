#include "drivers/verify/ride.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace tread {

RunResults ride(Model& model, int samples, const ProgressText& progress) {
  const Scene& scene = model.scene;
  RunResults results;
  results.preload = solve_preload(model, steady_motion(model), progress);
  if (scene.corrugation) model.apply_corrugation(deepest_line(scene, results.preload));
  results.limit = step_limit(model);
  results.dt = scene.motion->step_safety * results.limit.stable_step;
  const std::int64_t steps = step_count(scene, results.dt);
  progress(fmt::format("{} elements, {} steps of {:.3e} s", model.elements(), steps, results.dt));
  WholeRun run(model, results.preload, results.dt, steps, std::max<std::int64_t>(1, steps / samples));
  const Simulation& simulation = run.simulation;
  run.roll([&] {
    const Sample& sample = simulation.sample();
    results.samples.push_back(sample);
    if (results.samples.size() % 100 == 0)
      progress(fmt::format("t {:.3f} ms, x {:.1f} mm, F_N {:.2f} kN, F_L {:.2f} kN", 1e3 * sample.time,
                           1e3 * sample.wheel_x, 1e-3 * sample.vertical_force,
                           1e-3 * sample.longitudinal_force));
  });
  results.steps = simulation.steps();
  results.momentum = simulation.momentum_check();
  if (simulation.surface()) results.surface_fields = *simulation.surface();
  evaluate(model, results);
  return results;
}

WholeRun whole_run(Model& model, const Preload& preload, int samples, std::int64_t least) {
  const MotionSpec& motion = *model.scene.motion;
  const double longest = motion.step_safety * step_limit(model).stable_step;
  const std::int64_t steps = std::max(least, step_count(model.scene, longest));
  return {model, preload, motion.duration / static_cast<double>(steps), steps,
          std::max<std::int64_t>(1, steps / samples)};
}

double angular_momentum_error(const Model& model, const RunResults& results) {
  const std::vector<Sample>& s = results.samples;
  const double radius = model.wheel_radius();
  double impulse = 0;
  double size = 0;
  for (std::size_t i = 1; i < s.size(); ++i) {
    const double half = 0.5 * (s[i].time - s[i - 1].time);
    impulse += half * (s[i].torque + s[i - 1].torque -
                       radius * (s[i].longitudinal_force + s[i - 1].longitudinal_force));
    size += half * radius * (s[i].vertical_force + s[i - 1].vertical_force);
  }
  const double change = model.wheelset->inertia() * (s.back().wheel_spin - s.front().wheel_spin);
  return size > 0 ? std::abs(change - impulse) / size : 0.0;
}

int count_not_finite(const Model& model, const RunResults& results) {
  int count = 0;
  for (const Sample& sample : results.samples) {
    const std::vector<double> row = history_row(model, sample);
    if (!std::all_of(row.begin(), row.end(), [](double value) { return std::isfinite(value); })) ++count;
  }
  return count;
}

void judge_ride(const std::string& at, const Model& model, const RunResults& results,
                std::vector<Finding>& findings) {
  const double not_finite = count_not_finite(model, results);
  findings.push_back({at + "energy error, eq. (14)", "-", results.energy_error, 0, 0.01, true});
  findings.push_back({at + "momentum error", "-", results.momentum_error, 0, 1e-4, true});
  findings.push_back({at + "samples that are not finite", "-", not_finite, 0, 0, true});
}

}  // namespace tread
