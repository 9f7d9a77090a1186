#pragma once
// Files of flat JSON objects, one per line, as the commands print them.

#include <filesystem>
#include <vector>

#include "io/json_reader.hpp"

namespace tread {

/// Throws InputError with the line that is not such an object; empty lines are skipped.
std::vector<JsonRecord> read_json_lines(const std::filesystem::path& path);

}  // namespace tread
