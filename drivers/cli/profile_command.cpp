#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "drivers/cli/commands.hpp"
#include "drivers/cli/common_options.hpp"
#include "drivers/studies/profile/profile_study.hpp"

namespace tread {

void add_profile(CLI::App& app, const std::string& /*command_line*/) {
  auto options = std::make_shared<ProfileOptions>();
  CLI::App& command = *app.add_subcommand(
      "profile", "what a wheel's or rail's profile holds, as picture and columns; where two of them touch");
  command
      .add_option("file", options->file,
                  "a file (two columns, SIMPACK, MiniProf, columns under a header), "
                  "or a built-in profile")
      ->required();
  command.add_flag("--wheel", options->wheel, "the file holds a wheel");
  command.add_flag("--rail", options->rail, "the file holds a rail");
  command.add_option("--against", options->against, "profile of the other body: places of contact");
  command.add_option("--inclination", options->inclination, "of the rail, for the contact (default: 1:40)");
  command.add_option("--section", options->section, "rail whose head the file replaces (default: CN60)");
  command.add_option("--smoothing", options->smoothing,
                     "largest deviation of a spline from the points, "
                     "e.g. \"0.05 mm\"");
  command.add_option("--shift", options->shift, "added to y, e.g. \"7.1 mm\"");
  command.add_flag("--mirrored", options->mirrored, "the y of a rail counts to the gauge side");
  command.add_option("-o,--output", options->output, "file for clean two columns");
  command.add_option("--svg", options->svg, "file for the picture; with --against also NAME-touching.svg");
  command.add_flag("--json", options->json, "JSON on stdout");
  command.callback([options] { report_problems(options->json, [&] { profile(*options); }); });
}

}  // namespace tread
