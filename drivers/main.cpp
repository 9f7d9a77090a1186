#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <new>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "drivers/run_command.hpp"
#include "io/scene_reader.hpp"

namespace {

struct Common {
  std::string scene;
  std::string quality;
  std::vector<std::string> overrides;

  tread::ResolvedScene resolve() const {
    std::vector<std::string> all;
    if (!quality.empty()) all.push_back("scene.quality=" + quality);
    all.insert(all.end(), overrides.begin(), overrides.end());
    return tread::resolve_scene(std::filesystem::path(scene), all);
  }
};

void add_scene_options(CLI::App& command, Common& common) {
  command.add_option("scene", common.scene, "scene file (TOML)")->required();
  command.add_option("-q,--quality", common.quality, "draft, standard or paper; overrides scene.quality");
  command.add_option("--set", common.overrides, "key=value that overrides the scene, e.g. --set motion.speed=250km/h");
}

int run(int argc, char** argv) {
  CLI::App app{"tread: transient wheel-rail rolling contact"};
  app.require_subcommand(1);
  Common common;
  tread::RunOptions options;

  CLI::App& run_command = *app.add_subcommand("run", "preload, roll, write histories, summary and report");
  add_scene_options(run_command, common);
  run_command.add_option("-o,--output", options.output, "output directory")->required();
  run_command.add_option("-t,--threads", options.threads, "threads (default: all)")->check(CLI::PositiveNumber);
  run_command.add_flag("--json", options.json, "summary as JSON on stdout");
  run_command.add_flag("--quiet", options.quiet, "no progress on stderr");
  run_command.callback([&] { tread::run_scene(common.resolve(), options); });

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const int code = app.exit(error);
    return code == 0 ? 0 : static_cast<int>(tread::ExitCode::input);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const tread::Error& error) {
    fmt::print(stderr, "tread: {}\n", error.what());
    return static_cast<int>(error.code());
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "tread: not enough memory for this scene; a coarser quality needs less (see `tread check`)\n");
    return static_cast<int>(tread::ExitCode::resources);
  } catch (const std::exception& error) {
    fmt::print(stderr, "tread: unexpected failure: {}\n", error.what());
    return static_cast<int>(tread::ExitCode::resources);
  }
}
