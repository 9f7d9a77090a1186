#pragma once
// Commands and options of the program as data, for man pages, shell completion and suggestions.

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace tread {

/// An option or a positional argument as `--help` shows it.
struct OptionEntry {
  std::vector<std::string> names;    ///< "-o", "--output"; of a positional its one name
  std::string text;                  ///< meaning
  std::string value;                 ///< kind of its value, "TEXT"; empty for a flag
  std::vector<std::string> choices;  ///< values that it takes; empty: any
  bool required = false;
  bool repeated = false;  ///< takes several values
};

/// A command, or the program itself.
struct CommandEntry {
  std::vector<std::string> words;  ///< "tread", "bench", "kernels"
  std::string text;                ///< meaning
  std::vector<OptionEntry> options;
  std::vector<OptionEntry> positionals;
  std::vector<CommandEntry> commands;

  /// Words joined: "tread bench kernels" for " ".
  std::string name(const std::string& between) const;
};

/// Table of the program and its commands, in the order of `--help`.
CommandEntry command_table(const CLI::App& program);

}  // namespace tread
