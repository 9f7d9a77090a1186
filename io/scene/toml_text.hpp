#pragma once
// TOML texts into nodes. Everything that needs toml++ includes it from here.

#include <memory>
#include <string>

namespace tread {

/// Exception that toml++'s assertions throw.
struct TomlFault {};
[[noreturn]] void throw_toml_fault();

}  // namespace tread

// toml++ 3.3 states as assertions what some malformed texts break, and lets an optimised build assume them.
// Here they are exceptions in every build.
#pragma push_macro("NDEBUG")
#undef NDEBUG
#define TOML_ASSERT(condition) ((condition) ? void() : tread::throw_toml_fault())
#include <toml++/toml.h>
#pragma pop_macro("NDEBUG")

namespace tread {

/// Throws ProblemsError at the line where the text is not TOML, or has more than 2000 bytes outside of quotes
/// and comments; `file` is the name in messages.
toml::table parse_toml(const std::string& text, const std::string& file);

/// One value without its key, as after --set: the text itself where `takes_string` and it is not quoted, or
/// where it is no TOML.
std::unique_ptr<toml::node> parse_plain_value(const std::string& text, bool takes_string);

/// Sentence on a text after --set that is not UTF-8, or no key=value; "" for others.
std::string override_fault(const std::string& text);

std::unique_ptr<toml::node> clone(const toml::node& node);

}  // namespace tread
