#pragma once
// JSON objects as the program writes them, read back.

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

namespace tread {

/// Numbers, texts and truths by name; null is left out.
using JsonRecord = std::map<std::string, std::variant<double, std::string, bool>>;

enum class JsonShape {
  flat,   ///< nothing inside the object but numbers, texts and truths
  nested  ///< what lies deeper is named by its path, "vertical_force_N.max", list items from "list.0" on
};

/// The object that the text is; nothing where it is anything else.
std::optional<JsonRecord> parse_json(std::string_view text, JsonShape shape);

/// A file that is one object, nested. Throws InputError.
JsonRecord read_json(const std::filesystem::path& path);

/// The number of that name; nothing where the record has none.
std::optional<double> number_in(const JsonRecord& record, const std::string& name);

/// The text of that name; empty where the record has none.
std::string text_in(const JsonRecord& record, const std::string& name);

/// Whether the record has that name and it is true.
bool truth_in(const JsonRecord& record, const std::string& name);

}  // namespace tread
