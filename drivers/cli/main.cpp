#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <functional>
#include <memory>
#include <new>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/parallel/parallel.hpp"
#include "drivers/cli/command_table.hpp"
#include "drivers/cli/commands.hpp"
#include "drivers/cli/common_options.hpp"
#include "drivers/cli/exit_codes.hpp"
#include "drivers/cli/program_name.hpp"
#include "drivers/cli/wrong_word.hpp"
#include "drivers/process/host.hpp"
#include "drivers/process/launched_ranks.hpp"
#include "drivers/process/machine.hpp"
#include "drivers/process/progress.hpp"
#include "drivers/process/standard_files.hpp"
#include "drivers/process/version.hpp"
#include "drivers/run/followers.hpp"
#include "io/report/plain_text.hpp"
#include "io/scene/schema.hpp"
#include "io/text/text.hpp"

namespace {

/// "Exit codes: 0 done; 2 wrong input; ...".
std::string exit_codes() {
  std::string text = "Exit codes:";
  const char* between = " ";
  for (const auto& [code, meaning] : tread::kExitCodes)
    text += fmt::format("{}{} {}", std::exchange(between, "; "), static_cast<int>(code), meaning);
  return text + ".";
}

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

/// The command that the command line names, with the words before it.
tread::CommandEntry named_command(const CLI::App& app) {
  tread::CommandEntry entry = tread::command_table(app);
  for (const CLI::App* at = &app; !at->get_subcommands().empty();) {
    at = at->get_subcommands().front();
    const auto same = [&](const tread::CommandEntry& part) { return part.words.back() == at->get_name(); };
    tread::CommandEntry part = *std::find_if(entry.commands.begin(), entry.commands.end(), same);
    entry = std::move(part);
  }
  return entry;
}

/// Says program and machine on stderr.
void say_origin() {
  tread::print_error(fmt::format("[tread] {}; {}, {}, {} cores\n", tread::program_name(), tread::host_name(),
                                 tread::processor_name(), tread::machine_cores()));
}

/// Refuses a value that would count as not stated.
std::string refusal_of_nothing(const std::string& value) {
  return value.empty() ? "the value is empty; state one, or leave the option out" : "";
}

/// The words of the command line, "--name=" as the option "--name" and an empty value where the command has
/// such an option: the parser would take its value from the next word.
std::vector<std::string> with_empty_values(const CLI::App& app, int argc, char** argv) {
  const CLI::App* command = &app;
  std::vector<std::string> words = {argv[0]};
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    for (const CLI::App* part : command->get_subcommands({}))
      if (part->get_name() == word) command = part;
    const std::string name = word.substr(0, word.size() - (word.ends_with('=') ? 1 : 0));
    const CLI::Option* option = word.starts_with("--") ? command->get_option_no_throw(name) : nullptr;
    const bool empty = name != word && option && option->get_items_expected_max() > 0;
    words.push_back(empty ? name : word);
    if (empty) words.emplace_back();
  }
  return words;
}

/// Refuses names that no file can have.
std::string refusal_of_name(const std::string& name) {
  constexpr std::size_t kLongest = 255;  // [B] of most file systems
  for (const std::filesystem::path& part : std::filesystem::path(name))
    if (part.native().size() > kLongest)
      return fmt::format("a name of {} characters is too long; at most {} are possible", part.native().size(),
                         kLongest);
  return "";
}

/// Lets options refuse empty values, and those that name a file or folder names that none can have.
void check_values(CLI::App& command) {
  for (CLI::App* part : command.get_subcommands({})) check_values(*part);
  for (CLI::Option* option : command.get_options())
    if (!option->get_positional() && option->get_items_expected_max() > 0)
      option->check(CLI::Validator(refusal_of_nothing, ""));
  for (const char* named : {"--output", "--svg", "--slurm"})
    if (CLI::Option* option = command.get_option_no_throw(named))
      option->check(CLI::Validator(refusal_of_name, ""));
}

/// Gives `--version` to every command, and `--quiet` and `--verbose` to those that act. Commands without
/// progress are quiet anyway.
void add_common_flags(CLI::App& command, bool& verbose) {
  command.set_version_flag("--version", version_line, "print the version and exit");
  for (CLI::App* part : command.get_subcommands({})) add_common_flags(*part, verbose);
  if (!command.get_subcommands({}).empty()) return;
  if (!command.get_option_no_throw("--quiet"))
    command.add_flag("--quiet")->description("no progress on stderr");
  CLI::Option* option = command.get_option_no_throw("--verbose");
  if (!option)
    option = command.add_flag("--verbose")->description("program, machine, time and memory on stderr");
  option->each([&verbose](const std::string&) {
    if (!std::exchange(verbose, true)) say_origin();
  });
}

int run(int argc, char** argv) {
  CLI::App app{"transient wheel-rail rolling contact"};
  app.set_help_flag("-h,--help", "print this help and exit");
  app.require_subcommand(1);
  app.footer(exit_codes());
  std::string command_line = "tread";
  for (int i = 1; i < argc; ++i) command_line.append(" ").append(tread::shell_word(argv[i]));
  for (tread::AddCommand* add : tread::kCommands) add(app, command_line);
  bool verbose = false;
  add_common_flags(app, verbose);
  check_values(app);
  require_command(app, argc, argv);
  const tread::Progress clock(false);
  try {
    std::vector<const char*> stated;
    const std::vector<std::string> all = with_empty_values(app, argc, argv);
    for (const std::string& word : all) stated.push_back(word.c_str());
    app.parse(static_cast<int>(stated.size()), stated.data());
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help
    // A misspelt word may be why another one is missing.
    const std::vector<std::string> unknown = app.remaining(true);
    const tread::CommandEntry command = named_command(app);
    const std::vector<std::string> words(argv + 1, argv + argc);
    const bool json = std::find(words.begin(), words.end(), "--json") != words.end();
    tread::report_problems(json, [&] {
      throw tread::InputError(unknown.empty()
                                  ? fmt::format("{}: {}; `{} --help` shows how", command.name(" "),
                                                error.what(), command.name(" "))
                                  : tread::wrong_word(command, words, unknown));
    });
  }
  if (verbose)
    clock.say(fmt::format("[tread] {}, {} of memory at the most", tread::duration_text(clock.seconds()),
                          tread::bytes_text(tread::peak_memory())));
  return 0;
}

std::string incomplete_output(const std::string& reason) {
  return fmt::format("standard output: {}; what it shows is not complete", reason);
}

std::string missing_thread(const std::string& reason) {
  return fmt::format(
      "cannot start a thread: {}; fewer threads (-t) need less, and a larger `ulimit -u` allows more",
      reason);
}

/// The message for what the system refused to functions of libraries.
std::string system_refusal(const std::system_error& error) {
  const std::string reason = error.code().message();
  if (std::ferror(stdout) != 0) return incomplete_output(reason);
  if (const auto* file = dynamic_cast<const std::filesystem::filesystem_error*>(&error))
    return fmt::format("cannot use {}: {}; change its permissions, or choose another place",
                       file->path1().string(), reason);
  if (error.code() == std::errc::resource_unavailable_try_again) return missing_thread(reason);
  return fmt::format("unexpected failure: {}", error.what());
}

/// Returns the exit code of `act`; its error goes to stderr behind `who`.
int reported(const std::string& who, const std::function<int()>& act) {
  try {
    return act();
  } catch (const tread::Error& error) {
    // An error of the command line names the command, "tread run: ...".
    const std::string_view what = error.what();
    const bool named = what.starts_with("tread ") || what.starts_with("tread: ");
    tread::print_error(fmt::format("{}{}{}\n", who, named ? "" : "tread: ", error.what()));
    return static_cast<int>(error.code());
  } catch (const std::bad_alloc&) {
    tread::print_error(
        who + "tread: not enough memory for this scene; a coarser quality needs less (see `tread check`)\n");
    return static_cast<int>(tread::ExitCode::resources);
  } catch (const std::system_error& error) {
    tread::print_error(fmt::format("{}tread: {}\n", who, system_refusal(error)));
    return static_cast<int>(tread::ExitCode::resources);
  } catch (const std::exception& error) {
    const std::string_view what = error.what();
    const bool thread = what.starts_with("pthread_create ");  // TBB throws no std::system_error
    tread::print_error(
        fmt::format("{}tread: {}\n", who,
                    thread ? missing_thread(error.what()) : fmt::format("unexpected failure: {}", what)));
    return static_cast<int>(tread::ExitCode::resources);
  }
}

/// Throws InputError for a command whose work ranks cannot share.
void require_shared_command(int argc, char** argv) {
  const std::string word = argc > 1 ? argv[1] : "";
  if (word.empty() || word.starts_with('-') || word == "run" || word == "resume" || word == "version") return;
  throw tread::InputError(fmt::format(
      "tread {}: ranks share the work of `run` and `resume` alone; start it without mpirun", word));
}

/// Rank 0 does the command, the others follow. An error of one rank ends all.
int run_on(tread::Ranks& ranks, int argc, char** argv) {
  const int rank = ranks.rank();
  const int code = reported(rank == 0 ? "" : fmt::format("rank {}: ", rank), [&] {
    if (rank != 0) {
      tread::follow(ranks);
      return 0;
    }
    require_shared_command(argc, argv);
    const int done = run(argc, argv);
    tread::dismiss(ranks);
    return done;
  });
  if (code != 0) ranks.end_all(code);
  return code;
}

/// ResourceError where standard output has not taken all that was printed.
void require_shown() {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return;
  throw tread::ResourceError(incomplete_output(std::strerror(errno)));
}

}  // namespace

int main(int argc, char** argv) {
  tread::open_standard_files();
  tread::ignore_file_size_signal();
  return reported("", [&] {
    tread::give_back_large_arrays();
    tread::leave_openmp_place();
    tread::state_commit();
    const std::shared_ptr<tread::Ranks> ranks = tread::launched_ranks();
    tread::choose_ranks(ranks);
    const int code = ranks ? run_on(*ranks, argc, argv) : run(argc, argv);
    tread::choose_ranks(nullptr);
    require_shown();
    return code;
  });
}
