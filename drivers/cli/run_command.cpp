#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "drivers/cli/commands.hpp"
#include "drivers/cli/common_options.hpp"
#include "drivers/cli/program_name.hpp"
#include "drivers/run/run_scene.hpp"

namespace tread {

void add_run(CLI::App& app, const std::string& command_line) {
  auto state = std::make_shared<SceneCommand<RunOptions>>();
  state->options.program = program_name();
  state->options.command = command_line;
  CLI::App& command = add_scene_command(
      app, "run", "run a scene: preload, rolling, histories, summary, report", run_scene, state);
  command.add_option("-o,--output", state->options.output,
                     "output directory (default: the scene's name and the time, in the working directory)");
  add_device_option(command, state->options.device);
  command.add_flag("--quiet", state->options.quiet, "no progress on stderr");
  command.add_flag("--overwrite", state->options.overwrite, "remove the run in the output directory first");
  command.add_option("--from", state->options.from,
                     "start from the state of a run over another corrugation, DIR or DIR@TIME: out@10ms");
  add_cache_option(command, state->options.cache);
}

void add_resume(CLI::App& app, const std::string& /*command_line*/) {
  auto options = std::make_shared<RunOptions>();
  options->program = program_name();
  CLI::App& command = *app.add_subcommand("resume", "continue a stopped or killed run");
  command.add_option("folder", options->output, "output directory of the run")->required();
  command
      .add_option("--set", options->overrides,
                  "key=value for motion.duration, output.* and stop.*, e.g. --set \"stop.wall_time=2 h\"")
      ->allow_extra_args(false);
  add_thread_options(command, options->threads);
  add_device_option(command, options->device);
  command.add_flag("--json", options->json, "summary on stdout");
  command.add_flag("--quiet", options->quiet, "no progress on stderr");
  add_cache_option(command, options->cache);
  command.callback([options] { report_problems(options->json, [&] { resume_run(*options); }); });
}

}  // namespace tread
