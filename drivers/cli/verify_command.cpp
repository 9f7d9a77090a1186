#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "core/error.hpp"
#include "drivers/cli/commands.hpp"
#include "drivers/cli/common_options.hpp"
#include "drivers/verify/verification.hpp"

namespace tread {

void add_verify(CLI::App& app, const std::string& /*command_line*/) {
  auto options = std::make_shared<VerifyOptions>();
  CLI::App& command =
      *app.add_subcommand("verify", "compare the program with theory; exit code 3 if a bound fails");
  command.add_option("cases", options->names, "names of cases or groups (default: standard)");
  command
      .add_option("--set", options->overrides,
                  "input=value for every chosen case with this input, e.g. --set \"radius=0.5 m\"")
      ->allow_extra_args(false);
  command.add_option("-o,--output", options->output, "directory for a page and figures of each case");
  add_thread_options(command, options->threads);
  add_device_option(command, options->device);
  command.add_flag("--list", options->list, "the cases and their inputs; with names only these");
  command.add_flag("--json", options->json, "on stdout, one JSON object a line; with --list one JSON list");
  command.add_flag("--quiet", options->quiet, "no progress on stderr");
  command.callback([options] {
    bool passed = false;
    report_problems(options->json, [&] { passed = verify(*options); });
    if (!passed) throw NumericalError("verify: at least one bound fails");
  });
}

}  // namespace tread
