#pragma once
// Small questions about text.

#include <span>
#include <string_view>

namespace tread {

/// Without the white space at either end.
std::string_view trimmed(std::string_view text);

bool begins_with_any(std::string_view text, std::span<const std::string_view> beginnings);

}  // namespace tread
