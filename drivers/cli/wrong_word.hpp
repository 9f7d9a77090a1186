#pragma once
// Answers to words of the command line that no command knows.

#include <string>
#include <vector>

#include "drivers/cli/command_table.hpp"

namespace tread {

/// Sentence on the first word of `typed` that `command` does not know: the option that may be meant, or what
/// exists in place of a feature that the program lacks. `unknown` holds the words that were left over.
std::string wrong_word(const CommandEntry& command, const std::vector<std::string>& typed,
                       const std::vector<std::string>& unknown);

}  // namespace tread
