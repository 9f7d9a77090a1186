#pragma once
// Every key that a scene can hold, declared once: reading, checking, the resolved scene and
// docs/reference/scene.md come from this table. Defaults are those of the structs in core/scene.hpp.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/scene.hpp"
#include "io/scene/key.hpp"

namespace tread {

/// Names that the parts of a scene give their materials by default: "steel", "slab", "gap_filler", "mortar",
/// "concrete".
const std::vector<std::string>& usual_materials();

/// All keys of a scene with tables of these names, in the order of documentation, each table's keys
/// together.
std::vector<Key> scene_keys(const TableNames& names);
/// The same for the names of a scene.
std::vector<Key> scene_keys(const Scene& scene);
/// The same for the usual materials, without other names.
const std::vector<Key>& scene_keys();

/// All tables of a scene with tables of these names, in the order of documentation.
std::vector<SceneTable> scene_tables(const TableNames& names);
/// The same for the usual materials, without other names.
const std::vector<SceneTable>& scene_tables();

/// The key at the path, one of any name included; nothing where there is none.
std::optional<Key> find_key(std::string_view path);

/// The table that the path names or lies in, one of any name included; nothing where there is
/// none.
std::optional<SceneTable> table_of(std::string_view path);

/// Returns true if keys lie below the path: "motion.traction".
bool is_table(std::string_view path);

/// The names of the materials that the scene's parts are of, each with the key that says so:
/// {"wheel.material", "steel"}.
struct MaterialUse {
  std::string key;
  std::string part;  ///< table of the part: "wheel", "body.web"
  std::string name;  ///< of the material
};
std::vector<MaterialUse> material_uses(const Scene& scene);

/// The table of a part that is of this material by default, "wheel" of "steel"; "" where there is none.
std::string usual_user(std::string_view material);

/// Returns true if the key has an effect in the scene (Key::only_with).
bool applies(const Key& key, const Scene& scene);

/// The path of the table in which the path lies, known or not; "" for a path of one word.
std::string_view table_above(std::string_view path);

/// The path of a known key or table that the user may have meant, or "".
std::string similar_path(std::string_view unknown);

/// The option that differs least from the text, or "" where none is near.
std::string similar_text(std::string_view text, const std::vector<std::string>& options);

/// The names below a table path, "length, origin, profile".
std::string names_in(std::string_view table);

/// docs/reference/scene.md: the reference of every table, key and library entry, in Markdown.
std::string scene_reference();

}  // namespace tread
