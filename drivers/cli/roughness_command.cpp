#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "drivers/cli/commands.hpp"
#include "drivers/cli/common_options.hpp"
#include "drivers/studies/roughness/roughness_analysis.hpp"

namespace tread {

void add_roughness(CLI::App& app, const std::string& command_line) {
  auto options = std::make_shared<RoughnessOptions>();
  options->command = command_line;
  CLI::App& command = *app.add_subcommand(
      "roughness", "one-third octave levels of a measured profile, beside the limit of ISO 3095");
  command.add_option("file", options->file, "two columns: along the rail, height upwards")->required();
  command.add_option("--units", options->units,
                     "units of both columns, e.g. m,um, if the file does not state them");
  command.add_option("--segment", options->segment, "length of the averaged segments (default: \"2 m\")");
  command.add_flag("--depth", options->depth, "the second column counts downwards");
  command.add_flag("--raw", options->raw, "leave spikes and pits as they are");
  command.add_option("-o,--output", options->output, "directory for CSV, SVG and report");
  add_thread_options(command, options->threads);
  command.add_flag("--json", options->json, "JSON on stdout");
  command.callback([options] { report_problems(options->json, [&] { roughness(*options); }); });
}

}  // namespace tread
