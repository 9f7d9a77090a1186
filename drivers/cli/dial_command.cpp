#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "drivers/cli/commands.hpp"
#include "drivers/cli/common_options.hpp"
#include "drivers/cli/program_name.hpp"
#include "drivers/studies/dial/dial_study.hpp"

namespace tread {

void add_dial(CLI::App& app, const std::string& command_line) {
  auto options = std::make_shared<DialOptions>();
  options->common.origin = {program_name(), command_line};
  CLI::App& command = *app.add_subcommand("dial", "cost and error of the settings of a passage");
  or_shipped(command.add_option("file", options->file, "scene, or study file that states the runs (TOML)"))
      ->required();
  command
      .add_option("--base", options->axes.base,
                  "key=value while another key is varied (default: scene.element_size=5 mm)")
      ->allow_extra_args(false);
  command
      .add_option("--axis", options->axes.axes,
                  "key=value,value,...: values in place of the usual ones; one run for each")
      ->allow_extra_args(false);
  command.add_option("--reference", options->reference,
                     "reference: a point, or the folder of a finished run (default: the finest point)");
  command.add_option("--against", options->against,
                     "point with which single settings are compared (default: the base)");
  add_cost_option(command, options->cost);
  add_study(
      command, options, +[](const DialOptions& stated) {
        require_scene_or_study(stated.file.string());
        return turn_dial(stated);
      });
}

}  // namespace tread
