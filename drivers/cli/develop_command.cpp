#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "drivers/cli/commands.hpp"
#include "drivers/cli/common_options.hpp"
#include "drivers/studies/develop/develop.hpp"

namespace tread {

void add_develop(CLI::App& app, const std::string& command_line) {
  auto state = std::make_shared<SceneCommand<DevelopOptions>>();
  DevelopOptions& options = state->options;
  options.command = command_line;
  CLI::App& command = *app.add_subcommand(
      "develop", "passages that wear the rail, each for the next; goes on where it was stopped");
  add_scene_options(command, state->arguments)->required();
  command.add_option("--passages", options.passages, "simulated ones (default: 10), each standing for many")
      ->check(CLI::Range(1, 9999));
  command.add_option("-o,--output", options.output, "directory")->required();
  command.add_option("--from", options.from,
                     "begin all passages with the state of a run over the smooth rail, DIR or DIR@TIME");
  command.add_option("-t,--threads", options.threads, "threads of a passage (default: all)")
      ->check(at_least(1));
  command.add_flag("--json", options.json, "JSON on stdout");
  command.add_flag("--quiet", options.quiet, "no progress on stderr");
  command.callback([state] {
    report_problems(state->options.json, [&] { develop(state->arguments.resolve(), state->options); });
  });
}

}  // namespace tread
