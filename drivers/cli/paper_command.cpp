#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "drivers/cli/commands.hpp"
#include "drivers/cli/common_options.hpp"
#include "drivers/cli/program_name.hpp"
#include "drivers/studies/paper/paper_study.hpp"

namespace tread {

void add_paper(CLI::App& app, const std::string& command_line) {
  auto options = std::make_shared<PaperOptions>();
  options->common.origin = {program_name(), command_line};
  CLI::App& command =
      *app.add_subcommand("paper", "compute the figures of the paper and compare them with the printed ones");
  command.add_option("--fig", options->figures, "numbers of figures (default: all; --list names them)");
  add_study(command, options, reproduce_paper);
}

}  // namespace tread
