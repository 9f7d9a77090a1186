#pragma once
// The tables and keys of a scene with given materials. Private to the schema.

#include <string>
#include <string_view>
#include <vector>

#include "io/scene/key.hpp"

namespace tread::keys {

using Keys = std::vector<Key>;

/// Adds the keys of the material of that name.
void add_material(Keys& keys, const std::string& name);
void add_wheel(Keys& keys);
void add_rail(Keys& keys);
void add_fastenings(Keys& keys);
void add_slab(Keys& keys);
void add_vehicle_and_load(Keys& keys);
void add_contact(Keys& keys);
void add_motion(Keys& keys);
void add_corrugation(Keys& keys);
void add_wear(Keys& keys);
void add_impacts_and_output(Keys& keys);

/// All keys, and all tables, of a scene with these materials, in the order of documentation.
Keys make_keys(const std::vector<std::string>& materials);
std::vector<SceneTable> make_tables(const std::vector<std::string>& materials);

/// The material that the path, "material.steel" or "material.steel.density", belongs to; "" for other paths
/// and for names that are not letters, digits, _ and -.
std::string_view material_of(std::string_view path);

/// The keys of the material of that name, that of its presence included; none for "".
Keys material_keys(std::string_view name);
SceneTable material_table(const std::string& name);

}  // namespace tread::keys
