#pragma once
// Files that are named after the steps a run has taken.

#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

namespace tread {

/// FOLDER/step-000000001200.h5 for `suffix` ".h5".
std::filesystem::path step_file(const std::filesystem::path& folder, std::int64_t steps,
                                std::string_view suffix);

/// The steps of all such files, rising; other names are passed over.
std::vector<std::int64_t> steps_in(const std::filesystem::path& folder, std::string_view suffix);

/// Removes what a process that was killed while it wrote has left. [output_file.hpp, replace_file]
void remove_parts(const std::filesystem::path& folder);

}  // namespace tread
