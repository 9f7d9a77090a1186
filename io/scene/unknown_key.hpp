#pragma once
// Message about a key or table that scenes do not have.

#include <string>
#include <string_view>

namespace tread {

/// Sentence on what exists in place of a thing of this name, "gpu", "sleepers", in letters of any case; ""
/// for a word without a known purpose. [docs/can-and-cannot.md]
std::string instead_of(std::string_view word);

/// The reason why `path` is an error, and the way out: what exists in its place [docs/can-and-cannot.md], the
/// name that may be meant (looked for if `suggest`), or the names that there are.
std::string unknown_key(const std::string& path, bool is_a_table, bool suggest);

/// The reason why a known table cannot be `got`, "the number 3", and the way out.
std::string not_a_table(const std::string& path, const std::string& got);

/// The reason why keys cannot stand in the table "support." itself, whose tables have names, and the way out;
/// "" for other tables. `tables` ends with a dot.
std::string needs_name(std::string_view tables);

}  // namespace tread
