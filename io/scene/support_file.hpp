#pragma once
// Supports that differ from the others, from a table.

#include <filesystem>
#include <string>
#include <vector>

#include "core/scene.hpp"
#include "io/scene/problems.hpp"

namespace tread {

/// Reads a support a line, in ascending order of the fastenings. A line such as "# fastening [-]  shift [mm]
/// stiffness [-]" before the numbers names the columns: members of SupportSpec, `holds` as 1 or 0. Every bad
/// line is added to `problems` with its number; `path` is the file's name in them.
std::vector<SupportSpec> parse_supports(const std::string& content, const std::filesystem::path& path,
                                        std::vector<Problem>& problems);

}  // namespace tread
