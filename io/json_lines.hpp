#pragma once
// Files of flat JSON objects, one per line, as the commands print them.

#include <filesystem>
#include <map>
#include <string>
#include <variant>
#include <vector>

namespace tread {

/// Numbers, texts and truths by name; null is left out.
using JsonRecord = std::map<std::string, std::variant<double, std::string, bool>>;

/// Throws InputError with the line that is not such an object; empty lines are skipped.
std::vector<JsonRecord> read_json_lines(const std::filesystem::path& path);

}  // namespace tread
