#pragma once
// Man pages of the program.

#include <map>
#include <string>

#include "drivers/cli/command_table.hpp"

namespace tread {

/// Text of the man pages by file name: "tread.1", "tread-bench-kernels.1". They hold no date, so that the
/// same program writes the same pages.
std::map<std::string, std::string> man_pages(const CommandEntry& program);

}  // namespace tread
