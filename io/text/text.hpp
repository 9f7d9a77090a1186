#pragma once
// Small operations on text.

#include <string>
#include <string_view>

namespace tread {

/// Without the white space at either end.
std::string_view trimmed(std::string_view text);

/// Lower-case copy of ASCII text.
std::string lower_case(std::string_view text);

/// A cell of a CSV file, quoted if necessary.
std::string csv_cell(const std::string& text);

/// The text as one word of a shell, in quotes where the shell would change it.
std::string shell_word(const std::string& text);

}  // namespace tread
