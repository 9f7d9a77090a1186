#include "drivers/run_command.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <thread>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "drivers/progress.hpp"
#include "drivers/run_results.hpp"
#include "drivers/spin_prestress.hpp"
#include "io/output_file.hpp"

namespace tread {

namespace {

void make_directory(const std::filesystem::path& directory) {
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  if (error || !std::filesystem::is_directory(directory))
    throw ResourceError(fmt::format("cannot create the output directory '{}': {}; choose another with -o",
                                    directory.string(), error ? error.message() : "a file of that name is there"));
}

std::string progress_line(const Simulation& simulation, const Sample& sample, const Model& model, double end,
                          double seconds) {
  const double done = simulation.time() / end;
  const double per_step = simulation.steps() > 0 ? seconds / static_cast<double>(simulation.steps()) : 0;
  std::string line = fmt::format("[roll] t {:.3f}/{:.3f} ms  {:4.1f} %  dt {:.3e} s", 1e3 * simulation.time(), 1e3 * end,
                                 100 * done, simulation.dt());
  if (model.contact)
    line += fmt::format("  x {:.3f} m  FN {:.2f} kN  FL/FN {:.3f}", sample.wheel_x, 1e-3 * sample.vertical_force,
                        sample.vertical_force > 0 ? sample.longitudinal_force / sample.vertical_force : 0.0);
  line += fmt::format("  energy residual {:.2e} J  {:.1f} ns/el  ETA {}", sample.energy.residual,
                      1e9 * per_step / static_cast<double>(model.elements()),
                      done > 0 ? duration_text(seconds / done * (1 - done)) : "?");
  return line;
}

void roll(Model& model, RunResults& results, const std::filesystem::path& directory, Progress& progress) {
  const MotionSpec& motion = *model.scene.motion;
  HistoryFile histories(directory, history_channels(model));
  Simulation simulation(model, results.preload, results.dt);
  simulation.set_sampling_interval(std::max<std::int64_t>(1, std::llround(model.scene.output.history_interval / results.dt)));
  const double started = progress.seconds();
  const auto steps = static_cast<std::int64_t>(std::ceil(motion.duration / results.dt));
  while (simulation.steps() < steps) {
    simulation.step();
    if (simulation.sampled()) {
      const Sample& sample = simulation.sample();
      results.samples.push_back(sample);
      histories.append(history_row(model, sample));
      if (!std::isfinite(sample.energy.kinetic + sample.energy.strain))
        throw NumericalError(fmt::format("the motion is no longer finite at t = {:.6e} s (step {}): the step {:.3e} s is too "
                                         "long; lower motion.step_safety",
                                         sample.time, simulation.steps(), results.dt));
    }
    if (simulation.steps() % 16 == 0 && progress.due(model.scene.output.progress_interval))
      progress.say(progress_line(simulation, simulation.sample(), model, motion.duration, progress.seconds() - started));
  }
  histories.close();
  results.seconds_rolling = progress.seconds() - started;
  results.steps = simulation.steps();
  results.state_hash = simulation.state_hash();
  results.momentum = simulation.momentum_check();
  for (int b = 0; b < static_cast<int>(model.mesh.blocks.size()); ++b)
    results.block_energy.push_back(model.internal->energy(b, simulation.displacement().data()));
}

}  // namespace

void run_scene(const ResolvedScene& resolved, const RunOptions& options) {
  set_threads(options.threads > 0 ? options.threads : static_cast<int>(std::thread::hardware_concurrency()));
  make_directory(options.output);
  write_text_file(options.output / "scene.resolved.toml", resolved_toml(resolved));
  Progress progress(options.quiet);
  RunResults results;

  const Scene& scene = resolved.scene;
  Model model(scene);
  const double spin = scene.motion && scene.wheel ? scene.motion->speed / model.wheel_radius() : 0;
  if (spin > 0 && model.index.disc >= 0) {
    const auto wheel = model.index.wheel();
    const SpinPrestress prestress = spin_prestress(model.mesh, wheel, model.tie_specs, spin);
    for (std::size_t i = 0; i < wheel.size(); ++i) model.internal->set_initial_stress(wheel[i], prestress.stress[i]);
    results.preload.spin_tread_growth = prestress.tread_growth;
  }
  results.seconds_mesh = progress.seconds();
  progress.say(fmt::format("[mesh] {} elements, {} nodes, {} blocks, {}", model.elements(), model.nodes(),
                           model.mesh.blocks.size(), duration_text(results.seconds_mesh)));

  const double growth = results.preload.spin_tread_growth;
  const bool with_spin = scene.motion && scene.motion->spin_in_preload;
  results.preload = solve_preload(model, with_spin ? spin : 0, [&](const std::string& text) { progress.say("[" + text + "]"); });
  results.preload.spin_tread_growth = growth;
  results.seconds_preload = progress.seconds() - results.seconds_mesh;
  if (scene.corrugation)
    model.apply_corrugation(scene.corrugation->centre.value_or(results.preload.contact.pressure_peak.y));

  if (scene.motion) {
    results.limit = step_limit(model);
    results.dt = scene.motion->step_safety * results.limit.stable_step;
    progress.say(fmt::format("[step] dt {:.3e} s, {} steps; {}", results.dt,
                             static_cast<std::int64_t>(std::ceil(scene.motion->duration / results.dt)),
                             results.limit.reason));
    roll(model, results, options.output, progress);
  }
  evaluate(model, results);
  const std::string summary = summary_json(model, resolved, results);
  write_text_file(options.output / "summary.json", summary);
  if (options.json) fmt::print("{}", summary);
  progress.say(fmt::format("[done] {} in {}", options.output.string(), duration_text(progress.seconds())));
}

}  // namespace tread
