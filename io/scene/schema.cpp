#include "io/scene/schema.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "io/scene/key_table.hpp"

namespace tread {

namespace {

bool starts_with_table(std::string_view path, std::string_view table) {
  return path == table || (path.starts_with(table) && path[table.size()] == '.');
}

}  // namespace

const std::vector<std::string>& usual_materials() {
  static const std::vector<std::string> names = {"steel", "slab", "gap_filler", "mortar", "concrete"};
  return names;
}

namespace {

TableNames usual_names() {
  TableNames names;
  names.materials = usual_materials();
  return names;
}

}  // namespace

std::vector<Key> scene_keys(const TableNames& names) {
  return keys::make_keys(names);
}

std::vector<Key> scene_keys(const Scene& scene) {
  TableNames names;
  for (const auto& [name, material] : scene.materials) names.materials.push_back(name);
  for (const auto& [name, zone] : scene.zones) names.zones.push_back(name);
  for (const auto& [name, support] : scene.supports) names.supports.push_back(name);
  for (const auto& [name, surface] : scene.surfaces) names.surfaces.push_back(name);
  for (const auto& [name, body] : scene.bodies) names.bodies.push_back(name);
  for (const auto& [name, probe] : scene.probes) names.probes.push_back(name);
  return keys::make_keys(names);
}

const std::vector<Key>& scene_keys() {
  static const std::vector<Key> keys = keys::make_keys(usual_names());
  return keys;
}

std::vector<SceneTable> scene_tables(const TableNames& names) {
  return keys::make_tables(names);
}

const std::vector<SceneTable>& scene_tables() {
  static const std::vector<SceneTable> tables = keys::make_tables(usual_names());
  return tables;
}

std::optional<Key> find_key(std::string_view path) {
  const std::string_view named = keys::named_table_of(path);
  const std::vector<Key> own = keys::named_keys(named);
  const std::vector<Key>& all = named.empty() ? scene_keys() : own;
  const auto found = std::find_if(all.begin(), all.end(), [&](const Key& key) { return key.path == path; });
  return found == all.end() ? std::nullopt : std::optional(*found);
}

std::optional<SceneTable> table_of(std::string_view path) {
  const std::string_view named = keys::named_table_of(path);
  if (!named.empty()) return keys::named_table(named);
  const auto holds = [&](const SceneTable& table) { return starts_with_table(path, table.name); };
  const auto found = std::find_if(scene_tables().begin(), scene_tables().end(), holds);
  return found == scene_tables().end() ? std::nullopt : std::optional(*found);
}

bool is_table(std::string_view path) {
  const std::string_view named = keys::named_table_of(path);
  if (!named.empty()) return path == named;
  for (const std::string_view kind : kNamedTables)
    if (kind == std::string(path) + ".") return true;
  const auto below = [&](const Key& key) { return key.path != path && starts_with_table(key.path, path); };
  return std::any_of(scene_keys().begin(), scene_keys().end(), below);
}

std::vector<MaterialUse> material_uses(const Scene& scene) {
  Scene copy = scene;
  std::vector<MaterialUse> uses;
  for (const Key& key : scene_keys(scene)) {
    if (!key.names_material) continue;
    const Field field = key.locate(copy);
    const auto* name = std::get_if<std::string*>(&field);
    if (name && !(*name)->empty())
      uses.push_back({key.path, key.path.substr(0, key.path.rfind('.')), **name});
  }
  return uses;
}

std::string usual_user(std::string_view material) {
  Scene everything;
  for (const SceneTable& table : scene_tables())
    if (table.removable()) table.create(everything);
  for (const MaterialUse& use : material_uses(everything))
    if (use.name == material) return use.part;
  return "";
}

bool applies(const Key& key, const Scene& scene) {
  if (key.only_with.key.empty()) return true;
  if (!table_of(key.only_with.key)->exists(scene)) return false;
  if (key.only_with.needs_table()) return true;
  const std::optional<Key> other = find_key(key.only_with.key);
  // The place is read alone; a copy of the scene for each key would cost time that grows as the square.
  const std::string& value = *std::get<std::string*>(other->locate(const_cast<Scene&>(scene)));
  const std::vector<std::string>& values = key.only_with.names_file ? other->allowed : key.only_with.values;
  const bool listed = std::find(values.begin(), values.end(), value) != values.end();
  return listed != (key.only_with.names_file || key.only_with.negated);
}

std::string names_in(std::string_view table) {
  std::vector<std::string> names;
  const std::string_view named = keys::named_table_of(table);
  const std::vector<Key> own = keys::named_keys(named);
  for (const Key& key : named.empty() ? scene_keys() : own) {
    if (!table.empty() && (key.path == table || !starts_with_table(key.path, table))) continue;
    const std::size_t start = table.empty() ? 0 : table.size() + 1;
    const std::string name = key.path.substr(start, key.path.find('.', start) - start);
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  if (table.empty())
    for (const std::string_view kind : kNamedTables) names.push_back(std::string(kind) + "NAME");
  return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace tread
