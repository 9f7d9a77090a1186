#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "drivers/cli/commands.hpp"
#include "drivers/cli/common_options.hpp"
#include "drivers/cli/program_name.hpp"
#include "drivers/studies/develop/develop.hpp"

namespace tread {

void add_develop(CLI::App& app, const std::string& command_line) {
  auto state = std::make_shared<SceneCommand<DevelopOptions>>();
  DevelopOptions& options = state->options;
  options.origin = {program_name(), command_line};
  CLI::App& command = *app.add_subcommand(
      "develop",
      "corrugation growth: passages that wear the rail one after another; continues a stopped one");
  add_scene_options(command, state->arguments)->required();
  command
      .add_option("--passages", options.passages,
                  "number of simulated passages (default: 10); each stands for many real ones")
      ->check(CLI::Range(1, 9999));
  command.add_option("-o,--output", options.output, "output directory")->required();
  command.add_option("--from", options.from,
                     "start all passages from the state of a run over the smooth rail, DIR or DIR@TIME");
  command.add_option("-t,--threads", options.threads, "threads of a passage (default: all)")
      ->check(at_least(1));
  add_device_option(command, options.device);
  command.add_option("--launcher", options.launcher,
                     "words before each passage's command, e.g. \"srun -N1 -n1\"; there is no --slurm: a "
                     "passage follows another");
  command.add_flag("--json", options.json, "JSON on stdout");
  command.add_flag("--quiet", options.quiet, "no progress on stderr");
  command.callback([state] {
    report_problems(state->options.json, [&] { develop(state->arguments.resolve(), state->options); });
  });
}

}  // namespace tread
