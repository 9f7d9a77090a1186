#include "io/scene/toml_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <type_traits>
#include <vector>

#include "io/scene/problems.hpp"
#include "io/text/text.hpp"

namespace tread {

void throw_toml_fault() {
  throw TomlFault{};
}

namespace {

constexpr std::size_t kLongestLine = 2000;  // [bytes]

/// Where the quoted text or the comment that starts at `at` ends; `at` itself where none starts there.
std::size_t end_of_free_text(const std::string& text, std::size_t at) {
  const auto end_of_line = [&] { return std::min(text.find('\n', at), text.size()); };
  const char quote = text[at];
  if (quote == '#') return end_of_line();
  if (quote != '"' && quote != '\'') return at;
  const std::string three(3, quote);
  const bool long_text = text.compare(at, 3, three) == 0;
  const std::size_t last = long_text ? text.size() : end_of_line();
  for (std::size_t i = at + (long_text ? 3 : 1); i < last; ++i) {
    if (quote == '"' && text[i] == '\\') {
      ++i;
    } else if (!long_text && text[i] == quote) {
      return i + 1;
    } else if (long_text && text.compare(i, 3, three) == 0) {
      i += 3;
      while (i < last && text[i] == quote) ++i;  // up to two belong to the text
      return i;
    }
  }
  return last;
}

/// Keys of thousands of parts would exhaust the stack of the TOML parser. Only the marks of quoted texts and
/// comments count.
void refuse_long_lines(const std::string& text, const std::string& file) {
  int line = 1;
  std::size_t bytes = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = end_of_free_text(text, at);
    const std::size_t next = std::max(end, at + 1);
    const auto passed = std::string_view(text).substr(at, next - at);
    const auto ends = std::count(passed.begin(), passed.end(), '\n');
    bytes = ends > 0 ? 0 : bytes + (end == at ? 1U : 2U);
    line += static_cast<int>(ends);
    if (bytes > kLongestLine) {
      throw ProblemsError({{file, line, 0, "",
                            fmt::format("the line has more than {} bytes outside of quotes and comments; an "
                                        "array may go on in the next lines",
                                        kLongestLine)}});
    }
    at = next;
  }
}

/// First byte of a character outside of quotes and comments that is not ASCII: nothing in TOML, and where
/// toml++ 3.3 lets the compiler assume that it never comes. A byte order mark may start the text.
std::size_t foreign_character(const std::string& text) {
  for (std::size_t i = text.starts_with("\xEF\xBB\xBF") ? 3 : 0; i < text.size();) {
    const std::size_t end = end_of_free_text(text, i);
    if (end == i && static_cast<unsigned char>(text[i]) >= 0x80) return i;
    i = std::max(end, i + 1);
  }
  return std::string::npos;
}

void refuse_foreign_characters(const std::string& text, const std::string& file) {
  const std::size_t at = foreign_character(text);
  if (at == std::string::npos) return;
  const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
  throw ProblemsError({{file, static_cast<int>(line), 0, "",
                        "a character that is not ASCII stands outside of quotes and comments"}});
}

/// The text with an x in place of every character that is not ASCII, a byte order mark excepted: what is
/// TOML in this form has such characters only where `foreign_character` finds them or where they are free
/// text, and toml++ meets none of them in the middle of a malformed value.
std::string in_ascii(const std::string& text) {
  std::string ascii;
  for (std::size_t i = 0, bytes = 0; i < text.size(); i += bytes) {
    bytes = std::max<std::size_t>(utf8_bytes(text, i), 1);
    if (bytes == 1 || (i == 0 && text.starts_with("\xEF\xBB\xBF")))
      ascii.append(text, i, bytes);
    else
      ascii += 'x';
  }
  return ascii;
}

/// Number of the line at which the parser's assertion fails: the shortest run of lines that makes it fail
/// ends there.
int faulty_line(const std::string& text) {
  std::vector<std::size_t> ends;
  for (std::size_t at = 0; at < text.size(); at = ends.back())
    ends.push_back(std::min(text.find('\n', at), text.size() - 1) + 1);
  const auto faults = [&](std::size_t end) {
    try {
      (void)toml::parse(std::string_view(text).substr(0, end));
    } catch (const toml::parse_error&) {
    } catch (const TomlFault&) {
      return true;
    }
    return false;
  };
  const auto first =
      std::partition_point(ends.begin(), ends.end(), [&](std::size_t end) { return !faults(end); });
  return static_cast<int>(first - ends.begin()) + 1;
}

/// Parses a text of ASCII characters alone, or one whose ASCII form is valid TOML.
toml::table parse_harmless(const std::string& text, const std::string& file) {
  try {
    return toml::parse(text, file);
  } catch (const toml::parse_error& error) {
    const toml::source_position at = error.source().begin;
    throw ProblemsError({{file, static_cast<int>(at.line), static_cast<int>(at.column), "",
                          std::string(error.description())}});
  } catch (const TomlFault&) {
    throw ProblemsError({{file, faulty_line(text), 0, "", "the line is not valid TOML"}});
  }
}

}  // namespace

toml::table parse_toml(const std::string& text, const std::string& file) {
  refuse_long_lines(text, file);
  refuse_foreign_characters(text, file);
  const std::string ascii = in_ascii(text);
  toml::table table = parse_harmless(ascii, file);
  if (ascii != text) table = parse_harmless(text, file);
  return table;  // moved: a copy would know no lines
}

std::unique_ptr<toml::node> parse_plain_value(const std::string& text, bool takes_string) {
  refuse_long_lines(text, "--set");
  const bool quoted = text.size() > 1 && text.front() == '"';
  if ((!takes_string || quoted) && foreign_character(text) == std::string::npos) {
    try {
      (void)toml::parse("value = " + in_ascii(text));
      const toml::table table = toml::parse("value = " + text);
      if (table.size() == 1) return clone(*table.get("value"));
    } catch (const toml::parse_error&) {
    } catch (const TomlFault&) {
    }
  }
  return std::make_unique<toml::value<std::string>>(text);
}

std::string override_fault(const std::string& text) {
  for (std::size_t at = 0; at < text.size(); at += utf8_bytes(text, at))
    if (utf8_bytes(text, at) == 0)
      return fmt::format(
          "\"{}\" has bytes that are not UTF-8, here \"?\"; write it in UTF-8, and rename a file whose name "
          "is not",
          one_line(text));
  const std::size_t equals = text.find('=');
  if (equals != std::string::npos && !trimmed(std::string_view(text).substr(0, equals)).empty()) return "";
  return fmt::format("\"{}\" is not of the form key=value, such as motion.speed=\"250 km/h\"", text);
}

std::unique_ptr<toml::node> clone(const toml::node& node) {
  return node.visit([](const auto& typed) -> std::unique_ptr<toml::node> {
    return std::make_unique<std::decay_t<decltype(typed)>>(typed);
  });
}

}  // namespace tread
