#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "drivers/cli/commands.hpp"
#include "drivers/cli/common_options.hpp"
#include "drivers/run/run_control.hpp"

namespace tread {

void add_ctl(CLI::App& app, const std::string& /*command_line*/) {
  auto options = std::make_shared<CtlOptions>();
  CLI::App& command =
      *app.add_subcommand("ctl", "show the state of a run, or ask for a checkpoint, a frame or a stop");
  command.add_option("folder", options->folder, "output directory of the run")->required();
  command.add_option("action", options->action, "status, checkpoint, frame or stop")
      ->required()
      ->check(CLI::IsMember({"status", "checkpoint", "frame", "stop"}));
  command.add_option("--wait", options->patience, "longest time to wait for an answer [s]")
      ->check(at_least(0));
  command.callback([options] { control_run(*options); });
}

}  // namespace tread
