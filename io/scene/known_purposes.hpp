#pragma once
// Words for things that a scene cannot have, and what the user can do instead.

#include <string_view>

namespace tread {

/// What exists in place of the thing that a key or table of this name would be; "" for a word without a known
/// purpose. [docs/can-and-cannot.md]
std::string_view instead_of(std::string_view word);

}  // namespace tread
