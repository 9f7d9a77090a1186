#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "drivers/cli/commands.hpp"
#include "drivers/cli/common_options.hpp"
#include "drivers/cli/program_name.hpp"
#include "drivers/studies/compare/compare_study.hpp"

namespace tread {

void add_compare(CLI::App& app, const std::string& command_line) {
  auto options = std::make_shared<CompareOptions>();
  options->origin = {program_name(), command_line};
  CLI::App& command = *app.add_subcommand(
      "compare", "set a contact force that was measured, or another solver's, beside a run");
  command.add_option("run", options->run, "output directory of the run")->required();
  command
      .add_option("file", options->file,
                  "two columns, way or time and force, under a line such as \"# x [m]  F_N [kN]\"")
      ->required();
  command.add_option("--force", options->force, "force of the run: F_N (default) or F_L")
      ->check(CLI::IsMember({"F_N", "F_L"}));
  command.add_option("--mean", options->mean, "way over which both curves are averaged, e.g. \"7 mm\"");
  command.add_option("--offset", options->offset, "added to the file's first column, e.g. \"0.1 m\"");
  command.add_option("--from", options->first, "first place of the wheel, e.g. \"2.4 m\"");
  command.add_option("--to", options->last, "last place of the wheel");
  command.add_option("-o,--output", options->output, "directory for report and figure (default: the run's)");
  command.add_flag("--json", options->json, "JSON on stdout");
  command.callback([options] { report_problems(options->json, [&] { compare_curves(*options); }); });
}

}  // namespace tread
