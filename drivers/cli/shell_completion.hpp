#pragma once
// Completion of commands, options and their values in shells.

#include <string>

#include "drivers/cli/command_table.hpp"

namespace tread {

/// Script for bash: completes commands, options and listed values, and files elsewhere.
std::string bash_completion(const CommandEntry& program);

/// The same for zsh, with the texts of `--help`. An autoload function: the file's name is `_tread`.
std::string zsh_completion(const CommandEntry& program);

/// The same for fish.
std::string fish_completion(const CommandEntry& program);

}  // namespace tread
