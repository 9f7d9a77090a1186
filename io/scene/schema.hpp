#pragma once
// Every key that a scene can hold, declared once: reading, checking, the resolved scene and docs/scene.md
// come from this table. Defaults are those of the structs in core/scene.hpp.

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/scene.hpp"
#include "io/text/units.hpp"

namespace tread {

/// The two forms of a material's damping; a scene states one of them.
struct DampingField {
  double* high_frequency_fraction = nullptr;  ///< [-]
  double* rayleigh_beta = nullptr;            ///< [s]
};

/// Where a key lives in a Scene; monostate when the scene lacks the key's table.
using Field =
    std::variant<std::monostate, double*, std::optional<double>*, int*, bool*, std::string*, DampingField>;

enum class Kind {
  text,       ///< a string
  number,     ///< a pure number
  ratio,      ///< a pure number or "1:40"
  quantity,   ///< a string with a unit
  integer,    ///< a whole number
  boolean,    ///< true or false
  damping,    ///< { kind = "high_frequency_fraction" | "rayleigh_beta", value = ... }
  directive,  ///< says how to read the scene and is not part of it
};

/// Values from `low` to `high` in SI; an open end is itself excluded.
struct Bounds {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool open_low = false;
  bool open_high = false;

  bool contains(double value) const;
};

/// The key has an effect only where the table `key` is present (no `values`) or the text key `key` has one of
/// these values.
struct Condition {
  std::string key;
  std::vector<std::string> values;

  /// The values, "\"sine\" or \"random\"".
  std::string alternatives() const;
};

struct Key {
  std::string path;  ///< "rail.inclination"
  Kind kind = Kind::number;
  std::function<Field(Scene&)> locate;  ///< empty for directives
  std::string description;
  const Quantity* quantity = nullptr;  ///< what a Kind::quantity measures
  std::string unit = {};               ///< unit in which documentation and messages show it
  Bounds range = {};
  std::vector<std::string> allowed = {};  ///< of a text; empty: anything
  bool takes_file = false;  ///< a text that may also name a file, relative to the scene's folder
  bool required = false;    ///< must be given where the table is present
  Condition only_with = {};
  std::string excludes = {};    ///< a key that a later layer's value of this one replaces
  bool names_material = false;  ///< a text that names the material of the part that the key's table describes
};

/// A table of the scene; components can be absent.
struct SceneTable {
  std::string name;
  std::string description;
  std::function<void(Scene&)> create = {};  ///< with its defaults; empty: the table is always there
  std::function<void(Scene&)> remove = {};  ///< leaves the scene without it
  std::function<bool(const Scene&)> exists = {};

  bool removable() const { return static_cast<bool>(create); }
};

/// Begins the path of every material's table: "material.steel".
inline constexpr std::string_view kMaterialTables = "material.";

/// Names that the parts of a scene give their materials by default: "steel", "slab", "gap_filler", "mortar".
const std::vector<std::string>& usual_materials();

/// All keys of a scene with these materials, in the order of documentation, each table's keys together.
std::vector<Key> scene_keys(const std::vector<std::string>& materials);
/// The same for the materials of a scene.
std::vector<Key> scene_keys(const Scene& scene);
/// The same for the usual materials.
const std::vector<Key>& scene_keys();

/// All tables of a scene with these materials, in the order of documentation.
std::vector<SceneTable> scene_tables(const std::vector<std::string>& materials);
/// The same for the usual materials.
const std::vector<SceneTable>& scene_tables();

/// The key at the path, of a material of any name, too; nothing where there is none.
std::optional<Key> find_key(std::string_view path);

/// The table that the path names or lies in, of a material of any name, too; nothing where there is none.
std::optional<SceneTable> table_of(std::string_view path);

/// Returns true if keys lie below the path: "motion.traction".
bool is_table(std::string_view path);

/// The names of the materials that the scene's parts are of, each with the key that says so:
/// {"wheel.material", "steel"}.
struct MaterialUse {
  std::string key;
  std::string part;  ///< table of the part: "wheel"
  std::string name;  ///< of the material
};
std::vector<MaterialUse> material_uses(const Scene& scene);

/// The table of a part that is of this material by default, "wheel" of "steel"; "" where there is none.
std::string usual_user(std::string_view material);

/// Whether the key has an effect in the scene (Key::only_with).
bool applies(const Key& key, const Scene& scene);

/// The path of a known key or table that the user may have meant, or "".
std::string similar_path(std::string_view unknown);

/// The option that differs least from the text, or "" where none is near.
std::string similar_text(std::string_view text, const std::vector<std::string>& options);

/// The names below a table path, "length, origin, profile".
std::string names_in(std::string_view table);

/// The number that the field holds; nothing where it is not a number or not set.
std::optional<double> number_at(const Field& field);

/// "above 0 m and at most 1000 m"; "" where every number is allowed.
std::string describe_range(const Key& key);

/// docs/scene.md: the reference of every table, key and library entry, in Markdown.
std::string scene_reference();

}  // namespace tread
