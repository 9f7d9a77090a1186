#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "drivers/cli/commands.hpp"
#include "drivers/cli/common_options.hpp"
#include "drivers/run/result_listing.hpp"

namespace tread {

void add_results(CLI::App& app, const std::string& /*command_line*/) {
  auto options = std::make_shared<ResultsOptions>();
  CLI::App& command = *app.add_subcommand(
      "results", "files of a run or a study, datasets with shapes and units, and its state");
  command.add_option("folder", options->folder, "output directory of the run or the study")->required();
  command.add_flag("--json", options->json, "JSON on stdout");
  command.callback([options] { report_problems(options->json, [&] { list_results(*options); }); });
}

}  // namespace tread
