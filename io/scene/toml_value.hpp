#pragma once
// One TOML value into one field of the scene.

#include <filesystem>
#include <string>

#include "io/scene/schema.hpp"
#include "io/scene/toml_text.hpp"

namespace tread {

/// Notation of a value: TOML, or plain text after --set, which is a string where it is not TOML.
enum class Notation { toml, plain };

/// Sets the field. Files that it names are relative to the folder and become absolute. Throws InputError when
/// the value does not suit the key; its range is checked later.
void read_value(const Key& key, const toml::node& node, const std::filesystem::path& folder,
                const Field& field, Notation notation = Notation::toml);

/// Returns true if a number's value may be stated though it has no effect: the key's idle_value, or what the
/// scene has already.
bool is_idle_value(const Key& key, const toml::node& node, Scene scene);

/// Throws InputError.
bool to_boolean(const toml::node& node, Notation notation = Notation::toml);

/// Returns the text. Throws InputError where it has more than kLongestText characters, or control characters
/// other than tabs and line breaks; a name of a file may have all but U+0000.
const std::string& require_text(const std::string& text, bool names_file);

/// "the string "3 m"", for messages.
std::string describe_node(const toml::node& node);

}  // namespace tread
