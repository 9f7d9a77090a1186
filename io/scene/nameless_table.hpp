#pragma once
// Tables such as [support], in which only tables with names may stand. Private to the reader of a scene.

#include <string>

#include "io/scene/toml_text.hpp"

namespace tread {

/// Returns true if the table, "support.", is one of those, and is empty or holds a key.
bool lacks_names(const toml::table& table, const std::string& prefix);

/// Returns true for a table with a header of its own in the file, which is not the value of a key.
bool has_header(const toml::node& node);

}  // namespace tread
