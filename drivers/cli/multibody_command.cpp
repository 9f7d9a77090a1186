#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "drivers/cli/commands.hpp"
#include "drivers/cli/common_options.hpp"
#include "drivers/cli/program_name.hpp"
#include "drivers/studies/multibody/multibody_study.hpp"

namespace tread {

void add_multibody(CLI::App& app, const std::string& command_line) {
  auto state = std::make_shared<SceneCommand<MultibodyOptions>>();
  MultibodyOptions& options = state->options;
  options.origin = {program_name(), command_line};
  CLI::App& command =
      add_scene_command(app, "multibody", "run the scene by the multi-body approach, in about a second",
                        run_multibody_study, state);
  command.add_option("-o,--output", options.output, "directory for CSV, summary and report");
  command
      .add_option("--beam", options.beam,
                  "model of the rail: euler (default), timoshenko, spread: timoshenko with forces spread "
                  "by the head, or solid: waves of the section by finite elements")
      ->check(CLI::IsMember({"euler", "timoshenko", "spread", "solid"}));
  command
      .add_option("--wheel", options.wheel,
                  "rigid (default), or modal: the wheelset's modes by finite elements")
      ->check(CLI::IsMember({"rigid", "modal"}));
  command
      .add_option("--contact", options.contact,
                  "hertz (default): a spring, or half-space: a patch pressed on the sine")
      ->check(CLI::IsMember({"hertz", "half-space"}));
  command
      .add_option(
          "--modes", options.modes,
          "bending modes of the rail (default: all below 20 kHz, with a foot that is held along x 30 kHz)")
      ->check(CLI::Range(2, 3000));
  command.add_option("--step", options.step,
                     "time step, e.g. \"5 us\" (default: half the stable one, at most a fortieth of the "
                     "shortest wave's passing)");
  command.add_flag("--filter", options.filter, "reduce the depth of a sine by the contact filter");
  command.add_option("--calibrate", options.calibrate,
                     "directory of a transient run; the contact spring is fitted to its F_N");
  command
      .add_option("--map", options.map,
                  "response over speed and wavelength: speed=100:500:10km/h wavelength=40:150:2mm")
      ->expected(2);
  command.add_option("--dots", options.dots, "directories of transient runs to show on the map");
  command.add_flag("--quiet", options.quiet, "no progress on stderr");
}

}  // namespace tread
