#include "io/text/json.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/error.hpp"
#include "io/text/text_file.hpp"

namespace tread {

namespace {

constexpr int kDeepest = 32;                      // objects and lists inside one another
constexpr std::size_t kLargestObject = 16 << 20;  // [B]
constexpr std::size_t kLargestLines = 64 << 20;   // [B]

/// A value without members. The library writes a whole double as 1.0 and does not always find the shortest
/// form.
std::string scalar_text(const Json& value) {
  if (!value.is_number_float()) return value.dump(-1, ' ', false, Json::error_handler_t::replace);
  const auto number = value.get<double>();
  if (!std::isfinite(number)) return "null";
  std::array<char, 32> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr;
  return {digits.data(), end};
}

/// `margin`: line break and indentation of the value's own line; empty: everything in one line.
void append(std::string& text, const Json& value, const std::string& margin) {
  if (!value.is_structured() || value.empty()) {
    text += scalar_text(value);
    return;
  }
  const std::string inner = margin.empty() ? "" : margin + "  ";
  text += value.is_object() ? '{' : '[';
  const char* separator = "";
  for (const auto& [name, item] : value.items()) {
    text.append(separator).append(inner);
    if (value.is_object()) text.append(scalar_text(name)).append(": ");
    append(text, item, inner);
    separator = margin.empty() ? ", " : ",";
  }
  text.append(margin) += value.is_object() ? '}' : ']';
}

/// Adds the value to the record under its path.
void flatten(const nlohmann::json& value, const std::string& path, int depth, JsonRecord& record) {
  if (value.is_structured()) {
    if (depth > kDeepest) throw InputError(fmt::format("nested more than {} deep", kDeepest));
    for (const auto& [name, item] : value.items())
      flatten(item, depth == 0 ? name : fmt::format("{}.{}", path, name), depth + 1, record);
  } else if (value.is_boolean()) {
    record[path] = value.get<bool>();
  } else if (value.is_number()) {
    record[path] = value.get<double>();
  } else if (value.is_string()) {
    record[path] = value.get<std::string>();
  }
}

/// Sorted members, since ordered ones are found one after the other. Throws InputError with the reason where
/// the text is no JSON object.
nlohmann::json parse_object(std::string_view text) {
  try {
    nlohmann::json value = nlohmann::json::parse(text);
    if (!value.is_object()) throw InputError(fmt::format("it is a JSON {}", value.type_name()));
    return value;
  } catch (const nlohmann::json::exception& error) {
    // "[json.exception.parse_error.101] parse error at line 1, column 3: ...": the bracket is of no use.
    const std::string_view reason = error.what();
    throw InputError(std::string(reason.substr(std::min(reason.size(), reason.find("] ") + 2))));
  }
}

template <class T>
const T* find_in(const JsonRecord& record, const std::string& name) {
  const auto found = record.find(name);
  return found == record.end() ? nullptr : std::get_if<T>(&found->second);
}

}  // namespace

std::string json_text(const Json& value) {
  std::string text;
  append(text, value, "\n");
  return text + '\n';
}

std::string json_line(const Json& value) {
  std::string text;
  append(text, value, "");
  return text + '\n';
}

Json number_or_null(const std::optional<double>& number) {
  return number ? Json(*number) : Json();
}

JsonRecord parse_json(std::string_view text, const std::string& name) {
  try {
    JsonRecord record;
    flatten(parse_object(text), "", 0, record);
    return record;
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: no JSON object: {}", name, error.what()));
  }
}

JsonRecord read_json(const std::filesystem::path& path) {
  const std::string text = read_text_file(path, kLargestObject);
  try {
    return parse_json(text, path.string());
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}; `tread run` writes the file anew when the run ends", error.what()));
  }
}

std::vector<JsonRecord> parse_json_lines(std::string_view text, const std::string& name) {
  std::vector<JsonRecord> records;
  std::string_view rest = text;
  for (int line = 1; !rest.empty(); ++line) {
    const std::string_view one = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(rest.size(), one.size() + 1));
    if (one.find_first_not_of(" \t\r") == std::string_view::npos) continue;
    try {
      const nlohmann::json object = parse_object(one);
      if (std::any_of(object.begin(), object.end(),
                      [](const nlohmann::json& item) { return item.is_structured(); }))
        throw InputError("an object or a list stands inside it");
      flatten(object, "", 0, records.emplace_back());
    } catch (const InputError& error) {
      throw InputError(
          fmt::format("{}:{}: expected one JSON object of numbers, texts and truths, without "
                      "objects or lists inside it: {}",
                      name, line, error.what()));
    }
  }
  return records;
}

std::vector<JsonRecord> read_json_lines(const std::filesystem::path& path) {
  return parse_json_lines(read_text_file(path, kLargestLines), path.string());
}

std::optional<double> number_in(const JsonRecord& record, const std::string& name) {
  const auto* number = find_in<double>(record, name);
  return number ? std::optional(*number) : std::nullopt;
}

std::string text_in(const JsonRecord& record, const std::string& name) {
  const auto* text = find_in<std::string>(record, name);
  return text ? *text : "";
}

bool truth_in(const JsonRecord& record, const std::string& name) {
  const auto* truth = find_in<bool>(record, name);
  return truth && *truth;
}

}  // namespace tread
