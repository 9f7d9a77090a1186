#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <new>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "drivers/cli/commands.hpp"
#include "drivers/process/machine.hpp"
#include "drivers/process/version.hpp"
#include "io/scene/schema.hpp"

namespace {

constexpr const char* kExitCodes =
    "Exit codes: 0 done; 2 wrong input; 3 numerical stop or failed bound; 4 missing resource; "
    "75 stopped, `tread resume` continues.";

std::string version_line() {
  return std::string("tread ") + tread::program_version();
}

/// Throws InputError if the first word is no command.
void require_command(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return;
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  if (std::find(names.begin(), names.end(), argv[1]) != names.end()) return;
  const std::string near = tread::similar_text(argv[1], names);
  throw tread::InputError(fmt::format("there is no command '{}'; {}`tread --help` lists all", argv[1],
                                      near.empty() ? "" : fmt::format("did you mean '{}'? ", near)));
}

int run(int argc, char** argv) {
  CLI::App app{"tread: transient wheel-rail rolling contact"};
  app.require_subcommand(1);
  app.footer(kExitCodes);
  app.set_version_flag("--version", version_line);
  std::string command_line = "tread";
  for (int i = 1; i < argc; ++i) command_line.append(" ").append(argv[i]);
  for (tread::AddCommand* add : tread::kCommands) add(app, command_line);
  require_command(app, argc, argv);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help
    // A misspelt word may be why another one is missing.
    const std::vector<std::string> unknown = app.remaining(true);
    char** const end = argv + argc;
    char** const word = std::find_first_of(argv + 1, end, unknown.begin(), unknown.end());
    if (word == end)
      fmt::print(stderr, "tread: {}; --help shows how\n", error.what());
    else
      fmt::print(stderr, "tread: {} was not expected here; --help lists what is\n", *word);
    return static_cast<int>(tread::ExitCode::input);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    tread::give_back_large_arrays();
    return run(argc, argv);
  } catch (const tread::Error& error) {
    fmt::print(stderr, "tread: {}\n", error.what());
    return static_cast<int>(error.code());
  } catch (const std::bad_alloc&) {
    fmt::print(stderr,
               "tread: not enough memory for this scene; a coarser quality needs less (see `tread check`)\n");
    return static_cast<int>(tread::ExitCode::resources);
  } catch (const std::exception& error) {
    fmt::print(stderr, "tread: unexpected failure: {}\n", error.what());
    return static_cast<int>(tread::ExitCode::resources);
  }
}
