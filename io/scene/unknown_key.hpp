#pragma once
// Message about a key or table that scenes do not have.

#include <string>
#include <string_view>

namespace tread {

/// Sentence on what exists in place of a thing of this name, "gpu", "sleepers"; "" for a word without a known
/// purpose. [docs/can-and-cannot.md]
std::string instead_of(std::string_view word);

/// The reason why `path` is an error, and the way out: what exists in its place [docs/can-and-cannot.md], the
/// name that may be meant (looked for if `suggest`), or the names that there are.
std::string unknown_key(const std::string& path, bool is_a_table, bool suggest);

}  // namespace tread
