#include "io/json_lines.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <string_view>

#include "core/error.hpp"
#include "io/text_file.hpp"

namespace tread {

namespace {

/// Reads one line; every function returns false, or nothing, where it meets something else.
class LineReader {
 public:
  explicit LineReader(std::string_view text) : rest_(text) {}

  std::optional<JsonRecord> record() {
    JsonRecord record;
    if (!take("{")) return {};
    if (take("}")) return at_end() ? std::optional(record) : std::nullopt;
    do {
      const auto name = text();
      if (!name || !take(":") || !value(record, *name)) return {};
    } while (take(","));
    if (!take("}") || !at_end()) return {};
    return record;
  }

 private:
  void skip_blanks() {
    while (!rest_.empty() && (rest_.front() == ' ' || rest_.front() == '\t' || rest_.front() == '\r'))
      rest_.remove_prefix(1);
  }
  bool at_end() {
    skip_blanks();
    return rest_.empty();
  }
  bool take(std::string_view token) {
    skip_blanks();
    if (rest_.substr(0, token.size()) != token) return false;
    rest_.remove_prefix(token.size());
    return true;
  }

  /// Of the escapes those that stand for one character.
  std::optional<std::string> text() {
    if (!take("\"")) return {};
    std::string read;
    while (!rest_.empty()) {
      char c = rest_.front();
      rest_.remove_prefix(1);
      if (c == '"') return read;
      if (c == '\\') {
        constexpr std::string_view kEscapes = "\"\\/nt";
        constexpr std::string_view kMeanings = "\"\\/\n\t";
        const auto which = rest_.empty() ? std::string_view::npos : kEscapes.find(rest_.front());
        if (which == std::string_view::npos) return {};
        c = kMeanings[which];
        rest_.remove_prefix(1);
      }
      read += c;
    }
    return {};
  }

  bool value(JsonRecord& record, const std::string& name) {
    skip_blanks();
    if (rest_.empty()) return false;
    if (rest_.front() == '"') {
      const auto read = text();
      if (read) record[name] = *read;
      return read.has_value();
    }
    if (take("null")) return true;
    if (take("true")) return record[name] = true, true;
    if (take("false")) return record[name] = false, true;
    double number = 0;
    const auto [end, fault] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), number);
    if (fault != std::errc{}) return false;
    rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
    record[name] = number;
    return true;
  }

  std::string_view rest_;
};

}  // namespace

std::vector<JsonRecord> read_json_lines(const std::filesystem::path& path) {
  constexpr std::size_t kLimit = 64 << 20;
  const std::string text = read_text_file(path, kLimit);
  std::vector<JsonRecord> records;
  std::string_view rest = text;
  for (int line = 1; !rest.empty(); ++line) {
    const std::string_view one = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(rest.size(), one.size() + 1));
    if (one.find_first_not_of(" \t\r") == std::string_view::npos) continue;
    auto record = LineReader(one).record();
    if (!record)
      throw InputError(
          fmt::format("{}:{}: expected one JSON object of numbers, texts and truths, without "
                      "objects or lists inside it",
                      path.string(), line));
    records.push_back(std::move(*record));
  }
  return records;
}

}  // namespace tread
