#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "drivers/cli/commands.hpp"
#include "drivers/cli/program_name.hpp"
#include "drivers/engine/model/model.hpp"
#include "drivers/process/launched_ranks.hpp"
#include "drivers/process/version.hpp"
#include "io/scene/schema.hpp"
#include "io/text/json.hpp"
#include "kernels/device/device.hpp"

namespace tread {

namespace {

/// Version, commit, compiler, instruction sets and packages on stdout.
void print_version(bool json) {
  const std::vector<const char*> sets = InternalForce::instruction_sets();
  const std::vector<std::string> cards = gpus();
  const std::string library = rank_library();
  const ProgramBuild build = program_build();
  if (!json) {
    fmt::print(
        "{}\ncompiler          {}, {}\ninstruction sets  {}\npackages          {}\ndevices           cpu, "
        "emulated, {}\nranks             {}\n",
        program_name(), build.compiler, build.type, fmt::join(sets, ", "), build.packages,
        cards.empty() ? "no gpu: " + why_no_gpu() : fmt::format("{}", fmt::join(cards, ", ")),
        library.empty() ? "one alone: built without MPI" : "mpirun, " + library);
    return;
  }
  Json packages = Json::object();
  std::string_view rest = build.packages;
  while (!rest.empty()) {
    const std::string_view package = rest.substr(0, rest.find(", "));
    rest.remove_prefix(std::min(rest.size(), package.size() + 2));
    const auto blank = package.find(' ');
    packages[std::string(package.substr(0, blank))] = package.substr(blank + 1);
  }
  fmt::print("{}", json_text({{"version", program_version()},
                              {"commit", program_commit()},
                              {"compiler", build.compiler},
                              {"build", build.type},
                              {"instruction_sets", sets},
                              {"packages", packages},
                              {"gpus", cards},
                              {"mpi", library}}));
}

/// docs/reference/scene.md on stdout, as JSON one member `markdown`.
void print_scene_reference(bool json) {
  if (!json) {
    fmt::print("{}", scene_reference());
    return;
  }
  fmt::print("{}", json_text({{"markdown", scene_reference()}}));
}

void add_plain(CLI::App& app, const char* name, const char* text, void (*act)(bool)) {
  auto json = std::make_shared<bool>(false);
  CLI::App& command = *app.add_subcommand(name, text);
  command.add_flag("--json", *json, "JSON on stdout");
  command.callback([json, act] { act(*json); });
}

}  // namespace

void add_version(CLI::App& app, const std::string& /*command_line*/) {
  add_plain(app, "version", "print version, commit, compiler, instruction sets and packages", print_version);
}

void add_scene_reference(CLI::App& app, const std::string& /*command_line*/) {
  add_plain(app, "scene-reference", "print the scene reference as Markdown", print_scene_reference);
}

}  // namespace tread
