#include "drivers/studies/multibody/multibody_study.hpp"

#include <fmt/core.h>

#include <filesystem>
#include <optional>
#include <system_error>

#include "core/error.hpp"
#include "drivers/process/machine.hpp"
#include "drivers/process/progress.hpp"
#include "drivers/run/run_folder.hpp"
#include "drivers/run/scene_content.hpp"
#include "drivers/studies/multibody/local_parts.hpp"
#include "drivers/studies/multibody/multibody_report.hpp"
#include "io/files/output_file.hpp"
#include "io/report/figure_files.hpp"
#include "io/report/plain_text.hpp"
#include "io/text/units.hpp"

namespace tread {

namespace {

constexpr double kShortestStep = 1e-9;  ///< [s]

MultibodyStep step_of(const MultibodyOptions& options) {
  MultibodyStep step;
  step.modes = options.modes;
  if (options.step.empty()) return step;
  step.step = parse_option("--step", options.step, kTime);
  if (*step.step < kShortestStep)
    throw InputError(fmt::format("--step {}: it must be 1 ns at least", options.step));
  return step;
}

BeamTheory theory_of(const std::string& beam) {
  if (beam == "spread") return BeamTheory::spread;
  if (beam == "solid") return BeamTheory::solid;
  return beam == "euler" ? BeamTheory::euler : BeamTheory::timoshenko;
}

void check(const MultibodyOptions& options) {
  if (options.map.empty() && !options.dots.empty())
    throw InputError("--dots: they belong on a map; add --map speed=... wavelength=...");
  if (options.beam == "solid" && options.modes)
    throw InputError("--modes: the solid rail has all modes that it needs; leave --modes out");
  if (options.contact == "half-space" && options.filter)
    throw InputError(
        "--filter: the pressed half-spaces of --contact half-space filter the sine; leave one out");
  if (!options.output.empty()) require_folder_of(options.output, "multibody");
}

/// Removes files of an earlier call that this one may not write.
void remove_earlier_files(const std::filesystem::path& directory) {
  std::error_code ignored;
  for (const char* name : {"calibration.csv", "map.csv"}) std::filesystem::remove(directory / name, ignored);
  remove_figures(directory / kFigureFolder);
}

void write_files(const MultibodyOutcome& outcome, const ResolvedScene& resolved,
                 const MultibodyOptions& options) {
  const std::filesystem::path& directory = options.output;
  if (require_folder_of(directory, "multibody")) remove_earlier_files(directory);
  keep_scene(directory, resolved);
  write_text_file(directory / "multibody.csv", passage_csv(outcome.model, outcome.result));
  write_text_file(directory / "summary.json", multibody_json(outcome));
  if (outcome.calibration)
    write_text_file(directory / "calibration.csv", calibration_csv(*outcome.calibration));
  if (outcome.map) write_text_file(directory / "map.csv", map_csv(*outcome.map));
  write_report(directory / "report.html", multibody_report(outcome, resolved.name, options.origin));
}

}  // namespace

void run_multibody_study(const ResolvedScene& resolved, const MultibodyOptions& options) {
  check(options);
  use_threads(options.threads);
  const Progress progress(options.quiet);
  const MultibodyStep step = step_of(options);
  MultibodyOutcome outcome;
  outcome.model = multibody_model(resolved.scene, theory_of(options.beam));
  std::optional<MapAxes> axes;
  if (!options.map.empty()) {
    axes = parse_map_axes(options.map);
    require_whole_waves(outcome.model, *axes);
    for (const std::filesystem::path& run : options.dots)
      outcome.dots.push_back(map_dot(outcome.model, read_transient_run(run)));
  }
  if (options.beam == "solid") use_solid_rail(outcome.model);
  if (options.wheel == "modal") use_modal_wheel(outcome.model);
  if (options.contact == "half-space") use_half_space_contact(outcome.model);
  const MultibodyModel unfiltered = outcome.model;
  if (options.filter) {
    outcome.filter_gain = apply_contact_filter(outcome.model);
  }
  outcome.result = run_multibody(outcome.model, step);
  progress.say(fmt::format("[multibody] {} steps of {:.3e} s, {} modes, {}", outcome.result.steps,
                           outcome.result.dt, outcome.result.modes, duration_text(progress.seconds())));
  if (!options.calibrate.empty()) {
    outcome.calibration = calibrate(outcome.model, read_transient_run(options.calibrate), step);
    progress.say(fmt::format("[calibrate] {} springs tried, {}", outcome.calibration->factors.size(),
                             duration_text(progress.seconds())));
  }
  if (axes) {
    outcome.map = response_map(unfiltered, *axes, step, options.filter);
    progress.say(
        fmt::format("[map] {} passages, {}", outcome.map->points.size(), duration_text(progress.seconds())));
  }
  outcome.seconds = progress.seconds();
  if (!options.output.empty()) {
    make_directory(options.output);
    write_files(outcome, resolved, options);
  }
  if (options.json) {
    fmt::print("{}", multibody_json(outcome));
    return;
  }
  fmt::print("{}", plain_text(multibody_table(outcome)));
  if (outcome.calibration)
    fmt::print("\n{}", plain_text(calibration_table(*outcome.calibration, outcome.model)));
  for (const std::string& warning : warnings_of(outcome)) fmt::print("\n[warning] {}\n", warning);
}

}  // namespace tread
