#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "drivers/cli/commands.hpp"
#include "drivers/cli/common_options.hpp"
#include "drivers/cli/program_name.hpp"
#include "drivers/studies/export/export_study.hpp"

namespace tread {

void add_export(CLI::App& app, const std::string& /*command_line*/) {
  auto state = std::make_shared<SceneCommand<ExportOptions>>();
  ExportOptions& options = state->options;
  options.program = program_name();
  CLI::App& command = add_scene_command(app, "export", "write a scene's model as a file for another solver",
                                        export_scene, state);
  command
      .add_option("--format", options.format, "k: LS-DYNA keyword deck, which OpenRadioss reads (default)")
      ->check(CLI::IsMember({"k"}));
  command.add_option("--for", options.reader, "solver that reads the deck: openradioss (default) or ls-dyna")
      ->check(CLI::IsMember({"openradioss", "ls-dyna"}));
  command.add_option("--ramp", options.ramp,
                     "time over which gravity and static loads grow, e.g. \"0.5 ms\" (default: none)");
  command.add_flag(
      "--preload", options.preload,
      "start in the scene's static state: places, stresses and velocities (default: undeformed)");
  command.add_option(
      "--overlap", options.overlap,
      "place the wheelset deeper, until OpenRadioss's contact carries the load at t = 0, e.g. \"20 um\"");
  command.add_flag("--quiet", options.quiet, "no progress of the preload on stderr");
  command.add_option("-o,--output", options.output, "file")->required();
}

}  // namespace tread
