#pragma once
// Small operations on text.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace tread {

/// Without the white space at either end.
std::string_view trimmed(std::string_view text);

/// Lower-case and upper-case copies of ASCII text.
std::string lower_case(std::string_view text);
std::string upper_case(std::string_view text);

/// Bytes of the UTF-8 character that begins at `at`; 0 where none does.
std::size_t utf8_bytes(std::string_view text, std::size_t at);

/// The text on one line: blanks in place of control characters, "?" in place of bytes that are not UTF-8.
std::string one_line(std::string text);

/// The text with U+FFFD in place of bytes that are not UTF-8.
std::string in_utf8(std::string_view text);

/// A cell of a CSV file, quoted if necessary.
std::string csv_cell(const std::string& text);

/// The cells of a line of such a file.
std::vector<std::string> csv_cells(const std::string& line);

/// The line, up to a '#', with points in place of commas between digits; empty where it has none.
std::string with_decimal_points(const std::string& line);

/// The text as one word of a shell, in quotes where the shell would change it.
std::string shell_word(const std::string& text);

}  // namespace tread
