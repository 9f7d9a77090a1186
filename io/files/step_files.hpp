#pragma once
// Files named after the number of steps of a run.

#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

namespace tread {

/// Path FOLDER/step-000000001200.h5 for `suffix` ".h5".
std::filesystem::path step_file(const std::filesystem::path& folder, std::int64_t steps,
                                std::string_view suffix);

/// Steps of all such files, ascending; other names are skipped.
std::vector<std::int64_t> steps_in(const std::filesystem::path& folder, std::string_view suffix);

/// Removes unfinished files of a process that was killed while it wrote. [output_file.hpp, replace_file]
void remove_parts(const std::filesystem::path& folder);

}  // namespace tread
