#pragma once
// Options that several commands have, and how their problems reach the user.

#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "drivers/process/machine.hpp"
#include "drivers/studies/study/run_study.hpp"
#include "io/scene/scene_reader.hpp"

namespace tread {

/// The scene of a command as the user states it.
struct SceneArguments {
  std::string scene;  ///< file
  std::string quality;
  std::string precision;
  std::vector<std::string> overrides;  ///< "key=value"

  /// Throws ProblemsError, InputError.
  ResolvedScene resolve() const;
};

/// Options and scene of a command that works on a scene; lives as long as the command line.
template <class Options>
struct SceneCommand {
  SceneArguments arguments;
  Options options;
};

/// Calls `action`; with `json` the problems that the action throws go to stdout as a list, too.
void report_problems(bool json, const std::function<void()>& action);

/// Refuses texts that are no number, and numbers below `least`.
CLI::Validator at_least(int least);

void add_thread_options(CLI::App& command, ThreadOptions& options);
/// Where steps are taken.
void add_device_option(CLI::App& command, std::string& device);
void add_cache_option(CLI::App& command, std::string& place);
CLI::Option* add_cost_option(CLI::App& command, std::string& cost);
void add_study_options(CLI::App& command, StudyOptions& options);

/// Lets an option that names a scene or a study take the name of a shipped one, too. Files that are there
/// come first.
CLI::Option* or_shipped(CLI::Option* option);

/// InputError where the path that or_shipped() left leads to no file.
void require_scene_or_study(const std::string& stated);
/// InputError where it leads to no file, or to a study.
void require_scene_file(const std::string& stated);
/// InputError where it leads to no file, or to a scene.
void require_study_file(const std::string& stated);

/// Returns the option of the scene itself.
CLI::Option* add_scene_options(CLI::App& command, SceneArguments& arguments);

/// A subcommand that reads a scene: `act(resolved scene, options)`.
template <class Options>
CLI::App& add_scene_command(CLI::App& app, const char* name, const char* text,
                            void (*act)(const ResolvedScene&, const Options&),
                            std::shared_ptr<SceneCommand<Options>> state) {
  CLI::App& command = *app.add_subcommand(name, text);
  add_scene_options(command, state->arguments)->required();
  add_thread_options(command, state->options.threads);
  command.add_flag("--json", state->options.json, "JSON on stdout");
  command.callback([state, act] {
    report_problems(state->options.json, [&] { act(state->arguments.resolve(), state->options); });
  });
  return command;
}

/// The options of all studies, and the call of `run` with them.
template <class Options>
void add_study(CLI::App& command, const std::shared_ptr<Options>& options,
               std::optional<Error> (*run)(const Options&)) {
  add_study_options(command, options->common);
  command.callback([options, run] {
    std::optional<Error> shortfall;
    report_problems(options->common.json, [&] { shortfall = run(*options); });
    if (shortfall) throw Error(*shortfall);
  });
}

}  // namespace tread
