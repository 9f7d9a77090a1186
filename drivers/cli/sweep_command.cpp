#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "drivers/cli/commands.hpp"
#include "drivers/cli/common_options.hpp"
#include "drivers/cli/program_name.hpp"
#include "drivers/studies/study/sweep.hpp"

namespace tread {

void add_sweep(CLI::App& app, const std::string& command_line) {
  auto options = std::make_shared<SweepOptions>();
  options->common.origin = {program_name(), command_line};
  CLI::App& command = *app.add_subcommand(
      "sweep", "run a study: a scene with varied keys, one run a point; continues a stopped one");
  or_shipped(command.add_option("study", options->study, "study file (TOML), or the name of a shipped one"))
      ->required();
  add_study(
      command, options, +[](const SweepOptions& stated) {
        require_study_file(stated.study.string());
        return sweep(stated);
      });
}

}  // namespace tread
