#include "io/scene/nameless_table.hpp"

#include <algorithm>

#include "io/scene/unknown_key.hpp"

namespace tread {

bool lacks_names(const toml::table& table, const std::string& prefix) {
  if (needs_name(prefix).empty()) return false;
  const auto is_key = [](const auto& child) { return !child.second.is_table(); };
  return table.empty() || std::any_of(table.begin(), table.end(), is_key);
}

bool has_header(const toml::node& node) {
  return node.is_table() && !node.as_table()->is_inline();
}

}  // namespace tread
