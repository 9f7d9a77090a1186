#pragma once
// The tables and keys of a scene with given names of its own tables. Private to the schema.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/scene/key.hpp"

namespace tread::keys {

using Keys = std::vector<Key>;

/// Adds the keys of the material of that name.
void add_material(Keys& keys, const std::string& name);
/// Adds the keys of the support of that name.
void add_support(Keys& keys, const std::string& name);
/// Adds the keys of the depths of that name on a running surface.
void add_surface(Keys& keys, const std::string& name);
/// Adds the keys of the body of that name from a file.
void add_body(Keys& keys, const std::string& name);
/// Adds the keys of the probe of that name.
void add_probe(Keys& keys, const std::string& name);
void add_wheel(Keys& keys);
void add_rail(Keys& keys);
void add_fastenings(Keys& keys);
void add_slab(Keys& keys);
void add_sleepers(Keys& keys);
void add_vehicle_and_load(Keys& keys);
void add_contact(Keys& keys);
void add_motion(Keys& keys);
void add_corrugation(Keys& keys);
void add_wear(Keys& keys);
void add_impacts(Keys& keys);
void add_forks(Keys& keys);
void add_output(Keys& keys);

/// All keys, and all tables, of a scene with tables of these names, in the order of documentation.
Keys make_keys(const TableNames& names);
std::vector<SceneTable> make_tables(const TableNames& names);

/// The table that a scene names, "material.steel", to which "material.steel" and "material.steel.density"
/// belong; "" for other paths and for names that are not letters, digits, _ and -.
std::string_view named_table_of(std::string_view path);

/// The keys of a table that a scene names, that of its presence included; none for "".
Keys named_keys(std::string_view table);
/// A table that a scene names; nothing for "".
std::optional<SceneTable> named_table(std::string_view table);

}  // namespace tread::keys
