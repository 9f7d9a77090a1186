#pragma once
// Message about a key or table that scenes do not have.

#include <string>

namespace tread {

/// The reason why `path` is an error, and the way out: what exists in its place [docs/can-and-cannot.md], the
/// name that may be meant (looked for if `suggest`), or the names that there are.
std::string unknown_key(const std::string& path, bool is_a_table, bool suggest);

}  // namespace tread
