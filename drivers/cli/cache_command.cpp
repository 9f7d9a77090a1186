#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "drivers/cli/commands.hpp"
#include "drivers/cli/common_options.hpp"
#include "drivers/run/cache_control.hpp"

namespace tread {

void add_cache(CLI::App& app, const std::string& /*command_line*/) {
  auto options = std::make_shared<CacheOptions>();
  CLI::App& command = *app.add_subcommand("cache", "show or clear the preload cache");
  command.add_option("action", options->action, "show or clear")
      ->required()
      ->check(CLI::IsMember({"show", "clear"}));
  add_cache_option(command, options->place);
  command.add_flag("--json", options->json, "JSON on stdout");
  command.callback([options] { report_problems(options->json, [&] { tend_cache(*options); }); });
}

}  // namespace tread
