#pragma once
// Exit codes of the program, for `--help` and the man pages.

#include <array>
#include <utility>

#include "core/error.hpp"

namespace tread {

inline constexpr std::array<std::pair<ExitCode, const char*>, 5> kExitCodes = {
    {{ExitCode::done, "done"},
     {ExitCode::input, "wrong input"},
     {ExitCode::numerical, "numerical stop or failed bound"},
     {ExitCode::resources, "missing resource"},
     {ExitCode::resumable, "stopped, `tread resume` continues"}}};

}  // namespace tread
