#include "io/text/text.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>

namespace tread {

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.front()))) text.remove_prefix(1);
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back()))) text.remove_suffix(1);
  return text;
}

std::string lower_case(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return result;
}

std::string upper_case(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; });
  return result;
}

std::size_t utf8_bytes(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U; };
  if (at >= text.size()) return 0;
  const unsigned first = byte(at), second = byte(at + 1);
  if (first < 0x80) return 1;
  if (first < 0xC2 || first > 0xF4) return 0;
  // Longer forms than necessary, surrogates and characters beyond U+10FFFF are none.
  if ((first == 0xE0 && second < 0xA0) || (first == 0xED && second > 0x9F)) return 0;
  if ((first == 0xF0 && second < 0x90) || (first == 0xF4 && second > 0x8F)) return 0;
  const std::size_t bytes = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  for (std::size_t i = 1; i < bytes; ++i)
    if ((byte(at + i) & 0xC0U) != 0x80) return 0;
  return bytes;
}

std::string one_line(std::string text) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t bytes = utf8_bytes(text, at);
    if (bytes == 0) text[at] = '?';
    if (static_cast<unsigned char>(text[at]) < 0x20 || text[at] == 0x7f) text[at] = ' ';
    at += std::max<std::size_t>(bytes, 1);
  }
  return text;
}

std::string in_utf8(std::string_view text) {
  std::string valid;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t bytes = utf8_bytes(text, at);
    valid += bytes > 0 ? text.substr(at, bytes) : "\xEF\xBF\xBD";
    at += std::max<std::size_t>(bytes, 1);
  }
  return valid;
}

std::string shell_word(const std::string& text) {
  const auto plain = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
           std::string_view("_-./:=,@%+").find(c) != std::string_view::npos;
  };
  if (!text.empty() && std::all_of(text.begin(), text.end(), plain)) return text;
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

std::string csv_cell(const std::string& text) {
  std::string quoted = text;
  std::replace(quoted.begin(), quoted.end(), '"', '\'');
  return text.find_first_of(",\"\n") == std::string::npos ? text : fmt::format("\"{}\"", quoted);
}

std::vector<std::string> csv_cells(const std::string& line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"')
      quoted = !quoted;
    else if (c == ',' && !quoted)
      cells.emplace_back();
    else
      cells.back() += c;
  }
  return cells;
}

std::string with_decimal_points(const std::string& line) {
  std::string text = line.substr(0, line.find('#'));
  bool inside = false;  // a number
  const auto digit = [&](std::size_t i) { return i < text.size() && text[i] >= '0' && text[i] <= '9'; };
  for (std::size_t i = 1; i < text.size(); ++i) {
    if (text[i] != ',' || !digit(i - 1) || !digit(i + 1)) continue;
    text[i] = '.';
    inside = true;
  }
  return inside ? text : "";
}

}  // namespace tread
