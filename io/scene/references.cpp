#include "io/scene/references.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.hpp"
#include "io/scene/schema.hpp"
#include "io/scene/toml_text.hpp"
#include "io/scene/toml_value.hpp"
#include "io/text/text_file.hpp"

namespace tread {

namespace {

constexpr std::size_t kLargestFile = 1 << 20;  // [B]
constexpr double kSame = 1e-6;                 // relative difference of values that count as equal

bool same(const Field& a, const Field& b) {
  if (const auto* text = std::get_if<std::string*>(&a)) return **text == *std::get<std::string*>(b);
  if (const auto* truth = std::get_if<bool*>(&a)) return **truth == *std::get<bool*>(b);
  const std::optional<double> x = number_at(a);
  const std::optional<double> y = number_at(b);
  return x && y && std::abs(*x - *y) <= kSame * std::abs(*y);
}

/// Returns true if the scene has a table of a kind, [surface.NAME] for "surface".
bool has_named(const std::string& kind, const Scene& scene) {
  const std::vector<Key> keys = scene_keys(scene);
  return std::any_of(keys.begin(), keys.end(),
                     [&](const Key& key) { return key.path.starts_with(kind + "."); });
}

/// Returns true if the scene has the value that the node states for the key, one of its values for a list, or
/// for the name or kind of a table its presence.
bool holds(const std::string& path, const toml::node& node, Scene& scene) {
  if (const toml::array* values = node.as_array())
    return std::any_of(values->begin(), values->end(),
                       [&](const toml::node& value) { return holds(path, value, scene); });
  if (std::find(kNamedTables.begin(), kNamedTables.end(), path + ".") != kNamedTables.end())
    return has_named(path, scene) == to_boolean(node);
  const std::optional<SceneTable> table = table_of(path);
  if (table && table->name == path && table->removable()) return table->exists(scene) == to_boolean(node);
  const std::optional<Key> key = find_key(path);
  if (!key || !key->locate) throw InputError("no such key in a scene");
  const Field here = key->locate(scene);
  if (std::holds_alternative<std::monostate>(here)) return false;
  Scene stated = scene;
  const Field there = key->locate(stated);
  read_value(*key, node, {}, there);
  return same(here, there);
}

bool all_hold(const toml::table& conditions, Scene& scene) {
  return std::all_of(conditions.begin(), conditions.end(), [&](const auto& condition) {
    const std::string path(condition.first.str());
    try {
      return holds(path, condition.second, scene);
    } catch (const InputError& error) {
      throw InputError(fmt::format("{}: {}", path, error.what()));
    }
  });
}

template <class T>
T required(const toml::table& table, const char* name) {
  const std::optional<T> value = table[name].value<T>();
  if (!value) throw InputError(fmt::format("a reference lacks `{}`, or the value is of another kind", name));
  return *value;
}

Reference::After after(const std::string& text) {
  if (text.empty()) return Reference::After::start;
  if (text == "ramp") return Reference::After::ramp;
  if (text == "corrugation") return Reference::After::corrugation;
  throw InputError(fmt::format("after = \"{}\": expected \"ramp\" or \"corrugation\"", text));
}

Reference reference_of(const toml::table& table) {
  Reference reference;
  reference.label = required<std::string>(table, "label");
  reference.unit = required<std::string>(table, "unit");
  reference.value = required<double>(table, "value");
  reference.result = required<std::string>(table, "result");
  reference.scale = table["scale"].value_or(1.0);
  reference.over = table["over"].value_or(std::string());
  reference.after = after(table["after"].value_or(std::string()));
  reference.remark = table["remark"].value_or(std::string());
  reference.theory = table["theory"].value_or(false);
  reference.level = table["level"].value_or(std::string());
  if (const toml::table* ranges = table["ranges"].as_table())
    for (const auto& [name, bounds] : *ranges) {
      const toml::array* list = bounds.as_array();
      if (!list || list->size() != 2)
        throw InputError(fmt::format("ranges.{}: expected [low, high]", name.str()));
      reference.ranges[std::string(name.str())] = {list->get(0)->value_or(0.0), list->get(1)->value_or(0.0)};
    }
  return reference;
}

/// Returns true if the scene of that name holds, one of them for a list.
bool named_holds(const toml::node& name, const toml::table& file, Scene& scene) {
  if (const toml::array* names = name.as_array())
    return std::any_of(names->begin(), names->end(),
                       [&](const toml::node& one) { return named_holds(one, file, scene); });
  const toml::table* conditions = file["scenes"][name.value_or(std::string_view())].as_table();
  if (!conditions) throw InputError(fmt::format("there is no table [scenes] of {}", describe_node(name)));
  return all_hold(*conditions, scene);
}

/// Returns true if all scenes that the reference names hold.
bool applies(const toml::table& reference, const toml::table& file, Scene& scene) {
  const toml::array* names = reference["scenes"].as_array();
  if (!names) throw InputError("a reference lacks `scenes`");
  return std::all_of(names->begin(), names->end(),
                     [&](const toml::node& name) { return named_holds(name, file, scene); });
}

References references_in(const toml::table& file, Scene scene) {
  References references{file["title"].value_or(std::string()), file["column"].value_or(std::string()), {}};
  const toml::array* rows = file["reference"].as_array();
  if (!rows) throw InputError("there is no [[reference]]");
  for (const toml::node& node : *rows) {
    const toml::table* row = node.as_table();
    if (!row) throw InputError("a reference is not a table");
    Reference reference = reference_of(*row);
    if (applies(*row, file, scene)) references.rows.push_back(std::move(reference));
  }
  return references;
}

}  // namespace

References read_references(const std::filesystem::path& path, const Scene& scene) {
  const toml::table file = parse_toml(read_text_file(path, kLargestFile), path.string());
  try {
    return references_in(file, scene);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", path.string(), error.what()));
  }
}

}  // namespace tread
