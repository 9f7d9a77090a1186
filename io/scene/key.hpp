#pragma once
// A key of a scene and a table of keys.

#include <array>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/scene.hpp"
#include "io/scene/effects.hpp"
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

/// The longest text that names no file [characters].
inline constexpr std::size_t kLongestText = 1000;

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

/// The key has an effect only where the table `key` is present (no `values`), the text key `key` has one of
/// these values, or none with `negated`, or, with `names_file`, that text key names a file.
struct Condition {
  std::string key;
  std::vector<std::string> values;
  bool names_file = false;
  bool negated = false;

  bool needs_table() const { return values.empty() && !names_file; }
  /// The values, "\"sine\" or \"random\"", or "a file".
  std::string alternatives() const;
  /// "has no effect without [motion]": of a key where the condition does not hold.
  std::string why_idle() const;
};

struct Key {
  std::string path;  ///< "rail.inclination"
  Effects effects;
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
  std::optional<double> idle_value = {};  ///< may be stated where only_with does not hold
  std::string excludes = {};              ///< a key that a later layer's value of this one replaces
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
/// Begins the path of every probe's table: "probe.midspan".
inline constexpr std::string_view kProbeTables = "probe.";
/// Begins the path of every table of a surface's depths: "surface.weld".
inline constexpr std::string_view kSurfaceTables = "surface.";
/// Begins the path of every table of a body from a file: "body.web".
inline constexpr std::string_view kBodyTables = "body.";

/// Begins the path of every table of a support that differs: "support.broken".
inline constexpr std::string_view kSupportTables = "support.";

/// Begins the path of every table of a finely divided part of the rail: "zone.weld".
inline constexpr std::string_view kZoneTables = "zone.";

/// All of them: tables that are there only where a scene names one.
inline constexpr std::array kNamedTables = {kZoneTables, kSupportTables, kSurfaceTables, kBodyTables,
                                            kProbeTables};

/// Names that a scene gives to its own tables.
struct TableNames {
  std::vector<std::string> materials;
  std::vector<std::string> zones;
  std::vector<std::string> supports;
  std::vector<std::string> surfaces;
  std::vector<std::string> bodies;
  std::vector<std::string> probes;

  /// Adds the name in the path of a table that a scene names; nothing for other tables.
  void add(std::string_view table);
};

/// The number that the field holds; nothing where it is not a number or not set.
std::optional<double> number_at(const Field& field);

/// "above 0 m and at most 1000 m"; "" where every number is allowed.
std::string describe_range(const Key& key);

}  // namespace tread
