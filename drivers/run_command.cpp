#include "drivers/run_command.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/error.hpp"
#include "drivers/machine.hpp"
#include "drivers/progress.hpp"
#include "drivers/run_report.hpp"
#include "drivers/run_results.hpp"
#include "io/output_file.hpp"

namespace tread {

namespace {

constexpr const char* kPatchFile = "patch.h5";
constexpr int kInstants = 10;  ///< [paper, Fig. 16]

std::string progress_line(const Simulation& simulation, const Sample& sample, const Model& model, double end,
                          double seconds) {
  const double done = simulation.time() / end;
  const double per_step = simulation.steps() > 0 ? seconds / static_cast<double>(simulation.steps()) : 0;
  std::string line = fmt::format("[roll] t {:.3f}/{:.3f} ms  {:4.1f} %  dt {:.3e} s", 1e3 * simulation.time(),
                                 1e3 * end, 100 * done, simulation.dt());
  if (model.contact)
    line +=
        fmt::format("  x {:.3f} m  FN {:.2f} kN  FL/FN {:.3f}", sample.wheel_x, 1e-3 * sample.vertical_force,
                    sample.vertical_force > 0 ? sample.longitudinal_force / sample.vertical_force : 0.0);
  line += fmt::format("  energy residual {:.2e} J  {:.1f} ns/el  ETA {}", sample.energy.residual,
                      1e9 * per_step / static_cast<double>(model.elements()),
                      done > 0 ? duration_text(seconds / done * (1 - done)) : "?");
  return line;
}

/// A value that is not finite ends a run before it reaches a file.
const std::vector<double>& checked(const std::vector<double>& row, const std::vector<Channel>& channels) {
  for (std::size_t i = 0; i < row.size(); ++i)
    if (!std::isfinite(row[i]))
      throw NumericalError(
          fmt::format("'{}' is not a finite number at t = {:.6e} s", channels[i].name, row[0]));
  return row;
}

/// The files that grow while a run lasts.
struct GrowingFiles {
  std::vector<Channel> channels;
  HistoryFile histories;
  std::optional<PatchFile> patch;

  GrowingFiles(const Model& model, const std::filesystem::path& directory)
      : channels(history_channels(model)), histories(directory, channels) {
    if (model.contact) patch.emplace(directory / kPatchFile, model.contact->nodes());
  }
  void append(const Model& model, const Sample& sample) {
    histories.append(checked(history_row(model, sample), channels));
    if (patch) patch->append(sample.time, sample.wheel_x, model.contact->nodes());
  }
  void close() {
    histories.close();
    if (patch) patch->close();
  }
};

void step_to_the_end(Simulation& simulation, GrowingFiles& files, const Model& model, RunResults& results,
                     Progress& progress) {
  const double started = progress.seconds();
  const auto steps = step_count(model.scene, results.dt);
  while (simulation.steps() < steps) {
    simulation.step();
    if (simulation.sampled()) {
      results.samples.push_back(simulation.sample());
      files.append(model, simulation.sample());
    }
    if (simulation.steps() % 16 == 0 && progress.due(model.scene.output.progress_interval))
      progress.say(progress_line(simulation, simulation.sample(), model, model.scene.motion->duration,
                                 progress.seconds() - started));
  }
}

void roll(Model& model, RunResults& results, const std::filesystem::path& directory, Progress& progress) {
  GrowingFiles files(model, directory);
  Simulation simulation(model, results.preload, results.dt);
  simulation.set_sampling_interval(sampling_interval(model.scene, results.dt));
  const double started = progress.seconds();
  try {
    step_to_the_end(simulation, files, model, results, progress);
  } catch (const NumericalError& error) {
    files.close();
    throw NumericalError(fmt::format("{}; {} samples before it are kept in {}", error.what(),
                                     results.samples.size(), directory.string()));
  }
  files.close();
  results.seconds_rolling = progress.seconds() - started;
  results.steps = simulation.steps();
  results.state_hash = simulation.state_hash();
  results.momentum = simulation.momentum_check();
  results.surface_fields = simulation.surface();
  for (int b = 0; b < static_cast<int>(model.mesh.blocks.size()); ++b)
    results.block_energy.push_back(model.internal->energy(b, simulation.displacement().data()));
}

/// The fields of the rail's surface, and the instants of the patch that the report shows: of the last wave of
/// a corrugation, of the last patch lengths on a smooth rail.
void leave_surface(const Model& model, RunResults& results, const std::filesystem::path& directory) {
  if (!results.surface_fields) return;
  write_surface(directory / "surface.h5", *results.surface_fields);
  write_axis(directory / "surface_axis.csv", results.surface);
  const Scene& scene = model.scene;
  const bool waves = !model.contact->corrugation().smooth() && scene.corrugation->kind == "sine";
  const double stretch = waves ? scene.corrugation->wavelength : 4 * model.contact->reach();
  const double last = results.evaluated_last;
  results.instants =
      read_patch(directory / kPatchFile, std::max(last - stretch, results.evaluated_first), last, kInstants);
}

}  // namespace

void run_scene(const ResolvedScene& resolved, const RunOptions& options) {
  use_threads(options.threads);
  make_directory(options.output);
  write_text_file(options.output / "scene.resolved.toml", resolved_toml(resolved));
  Progress progress(options.quiet);
  RunResults results;

  const Scene& scene = resolved.scene;
  Model model(scene);
  results.seconds_mesh = progress.seconds();
  progress.say(fmt::format("[mesh] {} elements, {} nodes, {} blocks, {}", model.elements(), model.nodes(),
                           model.mesh.blocks.size(), duration_text(results.seconds_mesh)));

  results.preload = solve_preload(model, steady_motion(model),
                                  [&](const std::string& text) { progress.say("[" + text + "]"); });
  results.seconds_preload = progress.seconds() - results.seconds_mesh;
  if (scene.corrugation)
    model.apply_corrugation(scene.corrugation->centre.value_or(results.preload.contact.pressure_peak.y));

  if (scene.motion) {
    results.limit = step_limit(model);
    results.dt = scene.motion->step_safety * results.limit.stable_step;
    progress.say(fmt::format("[step] dt {:.3e} s, {} steps; {}", results.dt, step_count(scene, results.dt),
                             results.limit.reason));
    roll(model, results, options.output, progress);
  }
  evaluate(model, results);
  leave_surface(model, results, options.output);
  const std::string summary = summary_json(model, resolved, results);
  write_text_file(options.output / "summary.json", summary);
  write_run_report(options.output / "report.html", model, resolved, results, options.command);
  if (options.json) fmt::print("{}", summary);
  progress.say(fmt::format("[done] {} in {}", options.output.string(), duration_text(progress.seconds())));
}

}  // namespace tread
