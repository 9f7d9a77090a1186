#pragma once
// Small operations on text.

#include <string_view>

namespace tread {

/// Without the white space at either end.
std::string_view trimmed(std::string_view text);

}  // namespace tread
