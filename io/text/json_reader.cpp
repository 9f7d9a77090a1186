#include "io/text/json_reader.hpp"

#include <fmt/core.h>

#include <charconv>

#include "core/error.hpp"
#include "io/text/text_file.hpp"

namespace tread {

namespace {

constexpr int kDeepest = 32;
constexpr std::size_t kLargest = 16 << 20;  // [B]

/// Every function returns false, or nothing, where it meets something else.
class Reader {
 public:
  Reader(std::string_view text, JsonShape shape) : rest_(text), shape_(shape) {}

  std::optional<JsonRecord> record() {
    if (!object("", 0)) return {};
    skip_blanks();
    return rest_.empty() ? std::optional(std::move(record_)) : std::nullopt;
  }

 private:
  void skip_blanks() {
    const auto first = rest_.find_first_not_of(" \t\r\n");
    rest_.remove_prefix(first == rest_.npos ? rest_.size() : first);
  }
  bool take(std::string_view token) {
    skip_blanks();
    if (rest_.substr(0, token.size()) != token) return false;
    rest_.remove_prefix(token.size());
    return true;
  }

  std::optional<std::string> text() {
    if (!take("\"")) return {};
    std::string read;
    while (!rest_.empty()) {
      char c = rest_.front();
      rest_.remove_prefix(1);
      if (c == '"') return read;
      if (c == '\\') {
        if (take_now("u")) {
          if (!code_point(read)) return {};
          continue;
        }
        constexpr std::string_view kEscapes = "\"\\/nrtbf";
        constexpr std::string_view kMeanings = "\"\\/\n\r\t\b\f";
        const auto which = rest_.empty() ? std::string_view::npos : kEscapes.find(rest_.front());
        if (which == std::string_view::npos) return {};
        c = kMeanings[which];
        rest_.remove_prefix(1);
      }
      read += c;
    }
    return {};
  }

  bool take_now(std::string_view token) {
    if (!rest_.starts_with(token)) return false;
    rest_.remove_prefix(token.size());
    return true;
  }

  /// Of four hexadecimal digits, as UTF-8; halves of a pair stand for no character.
  bool code_point(std::string& read) {
    unsigned code = 0;
    constexpr std::size_t kDigits = 4;
    if (rest_.size() < kDigits) return false;
    const auto [end, fault] = std::from_chars(rest_.data(), rest_.data() + kDigits, code, 16);
    if (fault != std::errc{} || end != rest_.data() + kDigits || (code >= 0xD800 && code < 0xE000))
      return false;
    rest_.remove_prefix(kDigits);
    if (code < 0x80) {
      read += static_cast<char>(code);
    } else if (code < 0x800) {
      read += static_cast<char>(0xC0 | (code >> 6));
      read += static_cast<char>(0x80 | (code & 0x3F));
    } else {
      read += static_cast<char>(0xE0 | (code >> 12));
      read += static_cast<char>(0x80 | ((code >> 6) & 0x3F));
      read += static_cast<char>(0x80 | (code & 0x3F));
    }
    return true;
  }

  bool object(const std::string& prefix, int depth) {
    if (!take("{")) return false;
    if (take("}")) return true;
    do {
      const auto name = text();
      if (!name || !take(":") || !value(prefix + *name, depth)) return false;
    } while (take(","));
    return take("}");
  }

  bool list(const std::string& prefix, int depth) {
    if (!take("[")) return false;
    if (take("]")) return true;
    int index = 0;
    do {
      if (!value(prefix + std::to_string(index++), depth)) return false;
    } while (take(","));
    return take("]");
  }

  bool value(const std::string& name, int depth) {
    skip_blanks();
    if (rest_.empty()) return false;
    const bool deeper = rest_.front() == '{' || rest_.front() == '[';
    if (deeper && (shape_ == JsonShape::flat || depth == kDeepest)) return false;
    if (deeper) return rest_.front() == '{' ? object(name + ".", depth + 1) : list(name + ".", depth + 1);
    if (rest_.front() == '"') {
      const auto read = text();
      if (read) record_[name] = *read;
      return read.has_value();
    }
    if (take("null")) return true;
    if (take("true")) return record_[name] = true, true;
    if (take("false")) return record_[name] = false, true;
    double number = 0;
    const auto [end, fault] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), number);
    if (fault != std::errc{}) return false;
    rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
    record_[name] = number;
    return true;
  }

  std::string_view rest_;
  JsonShape shape_;
  JsonRecord record_;
};

}  // namespace

std::optional<JsonRecord> parse_json(std::string_view text, JsonShape shape) {
  return Reader(text, shape).record();
}

JsonRecord read_json(const std::filesystem::path& path) {
  std::optional<JsonRecord> record = parse_json(read_text_file(path, kLargest), JsonShape::nested);
  if (!record)
    throw InputError(
        fmt::format("{}: it is no JSON object; `tread run` writes it anew when it ends", path.string()));
  return std::move(*record);
}

namespace {

template <class T>
const T* find_in(const JsonRecord& record, const std::string& name) {
  const auto found = record.find(name);
  return found == record.end() ? nullptr : std::get_if<T>(&found->second);
}

}  // namespace

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
