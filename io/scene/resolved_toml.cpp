#include <fmt/format.h>

#include <optional>
#include <string>

#include "io/scene/scene_reader.hpp"
#include "io/scene/schema.hpp"
#include "io/text/text.hpp"

namespace tread {

namespace {

std::string toml_string(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      quoted += {'\\', c};
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      quoted += fmt::format("\\u{:04X}", static_cast<unsigned char>(c));
    } else {
      quoted += c;
    }
  }
  return quoted + '"';
}

std::string toml_value(const Key& key, const Entry& entry) {
  std::string with_unit = entry.unit.empty() ? entry.value : toml_string(entry.value + " " + entry.unit);
  if (key.kind == Kind::text) return toml_string(entry.value);
  if (key.kind != Kind::damping) return with_unit;
  const char* kind = entry.unit.empty() ? "high_frequency_fraction" : "rayleigh_beta";
  return fmt::format("{{ kind = \"{}\", value = {} }}", kind, with_unit);
}

}  // namespace

std::string resolved_toml(const ResolvedScene& resolved) {
  std::string text = "# Every value of the scene in SI, each with its source.\n";
  std::string current;
  for (const Entry& entry : resolved.entries) {
    const std::optional<Key> key = find_key(entry.path);
    const std::optional<SceneTable> table = table_of(entry.path);
    if (table->name != current) text += fmt::format("\n[{}]\n", table->name);
    current = table->name;
    const std::string name = entry.path.substr(table->name.size() + 1);
    text += fmt::format("{} = {}  # {}\n", name, toml_value(*key, entry), one_line(entry.source));
  }
  return text;
}

}  // namespace tread
