#pragma once
// Files of flat JSON objects, one per line, as the commands print them.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "io/text/json_reader.hpp"

namespace tread {

/// Throws InputError with the line that is not such an object; empty lines are skipped.
std::vector<JsonRecord> read_json_lines(const std::filesystem::path& path);

/// The same of a text; messages call it `name`.
std::vector<JsonRecord> parse_json_lines(std::string_view text, const std::string& name);

}  // namespace tread
