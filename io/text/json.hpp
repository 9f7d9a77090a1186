#pragma once
// JSON in this program's layout, and flat records of JSON files.

#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace tread {

/// A value whose members keep their order. Sources that build one include <nlohmann/json.hpp>.
using Json = nlohmann::ordered_json;

/// The value as text, indented by two spaces, with a closing newline. Numbers have the shortest form that
/// reads back to the same bits; values that are not finite become null; bytes that are not UTF-8 become
/// U+FFFD.
std::string json_text(const Json& value);

/// The value as one line of text with a closing newline.
std::string json_line(const Json& value);

/// The number, or null where there is none.
Json number_or_null(const std::optional<double>& number);

/// Numbers, texts and truths by their path in an object, "vertical_force_N.max"; list items count from
/// "list.0". Null is left out.
using JsonRecord = std::map<std::string, std::variant<double, std::string, bool>>;

/// The record of a text that is one JSON object. Throws InputError, which calls the text `name`.
JsonRecord parse_json(std::string_view text, const std::string& name);

/// The record of a file that is one JSON object. Throws InputError.
JsonRecord read_json(const std::filesystem::path& path);

/// Records of a text with one JSON object a line and neither objects nor lists inside them; empty lines are
/// skipped. Throws InputError, which calls the text `name` and gives the line.
std::vector<JsonRecord> parse_json_lines(std::string_view text, const std::string& name);

/// Records of such a file. Throws InputError.
std::vector<JsonRecord> read_json_lines(const std::filesystem::path& path);

/// The number of that name; nothing where the record has none.
std::optional<double> number_in(const JsonRecord& record, const std::string& name);

/// The text of that name; empty where the record has none.
std::string text_in(const JsonRecord& record, const std::string& name);

/// Returns true if the record has that name and the value is true.
bool truth_in(const JsonRecord& record, const std::string& name);

}  // namespace tread
