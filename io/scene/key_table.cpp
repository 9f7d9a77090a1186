#include "io/scene/key_table.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <optional>
#include <utility>

#include "io/scene/key_builders.hpp"

namespace tread::keys {

namespace {

void add_general(Keys& keys) {
  keys.push_back(text("scene.title", {Effect::text}, at(&Scene::title), "Name of the scene in reports"));
  keys.push_back({.path = "scene.based_on",
                  .effects = Effects::all(),
                  .kind = Kind::directive,
                  .locate = {},
                  .description = "Library entry whose values hold where the file states none"});
  keys.push_back(choice("scene.quality", {Effect::fineness, Effect::mesh}, at(&Scene::quality),
                        {"draft", "standard", "paper"},
                        "Fineness of the generated mesh: elements of 2.2, 1.6 or 1.1 mm in the contact "
                        "surface; `paper` has 1.48 million in the paper's scene, where the paper had 1.46"));
  keys.push_back(
      choice("scene.precision", {Effect::fineness, Effect::motion, Effect::cost}, at(&Scene::precision),
             {"double", "mixed", "single"},
             "Of nodes and elements while they move: `mixed` keeps displacements in double and the "
             "rest in "
             "single precision, `single` keeps them in single too. The static state, contact, "
             "frames, time and sums are in double always"));
  keys.push_back(quantity("scene.element_size", {Effect::fineness, Effect::mesh}, at(&Scene::element_size),
                          kLength, "mm", from(5e-5, 0.1),
                          "Element size in the contact surface, in place of the quality's"));
  keys.push_back(quantity("scene.gravity", {Effect::preload, Effect::cost}, at(&Scene::gravity),
                          kAcceleration, "m/s2", from(0, 100), "Acceleration of gravity"));
  keys.push_back(
      only_with("wheel.shape", "tyre",
                flag("scene.plane_strain", {Effect::preload, Effect::cost}, at(&Scene::plane_strain),
                     "Nothing moves across: a slice of a wide tyre on a wide block")));
  keys.push_back(
      with_table("wheel", quantity("solution_zone.start", {Effect::mesh}, at(&Scene::zone_start), kLength,
                                   "m", from(-1000, 1000), "x where the finely divided rail starts")));
  keys.push_back(
      with_table("wheel", quantity("solution_zone.length", {Effect::mesh}, at(&Scene::zone_length), kLength,
                                   "m", above(0, 1000), "Length of the finely divided rail")));
  keys.push_back(with_table(
      "wheel",
      quantity("solution_zone.margin", {Effect::mesh}, at(&Scene::zone_margin), kLength, "m",
               from(0.05, 1000),
               "Way on both sides of each zone with elements two or three times as long as in it; "
               "on the rest of the run the rail's are four or six times as long, if that is below 9 mm")));
}

void add_zone(Keys& keys, const std::string& name) {
  const std::string table = std::string(kZoneTables) + name;
  keys.push_back(with_table(
      "wheel", required(quantity(table + ".start", {Effect::mesh}, at(&Scene::zones, name, &ZoneSpec::start),
                                 kLength, "m", from(-1000, 1000), "x where the part begins"))));
  keys.push_back(with_table(
      "wheel", quantity(table + ".length", {Effect::mesh}, at(&Scene::zones, name, &ZoneSpec::length),
                        kLength, "m", above(0, 1000), "Length of the part")));
}

/// Effects of each table's keys together, by the table's name.
std::map<std::string, Effects, std::less<>> effects_of_tables(const Keys& keys) {
  std::map<std::string, Effects, std::less<>> found;
  for (const Key& key : keys) {
    const std::string_view named = named_table_of(key.path);
    const std::string_view path = key.path;
    const std::string_view table = named.empty() ? path.substr(0, path.find('.')) : named;
    const auto [at, is_new] = found.try_emplace(std::string(table), key.effects);
    if (!is_new) at->second = at->second | key.effects;
  }
  return found;
}

/// The key that leaves the table out; `effects`: those of the table's own keys.
Key presence_of(const std::string& table, Effects effects) {
  return {.path = table + ".present",
          .effects = effects,
          .kind = Kind::directive,
          .locate = {},
          .description = "false leaves the table out"};
}

template <class Spec>
SceneTable component(const std::string& name, std::optional<Spec> Scene::*spec,
                     const std::string& description) {
  return {.name = name,
          .description = description,
          .create = [spec](Scene& scene) { (scene.*spec).emplace(); },
          .remove = [spec](Scene& scene) { (scene.*spec).reset(); },
          .exists = [spec](const Scene& scene) { return (scene.*spec).has_value(); }};
}

SceneTable always(std::string name, std::string description) {
  return {.name = std::move(name), .description = std::move(description), .exists = [](const Scene&) {
            return true;
          }};
}

}  // namespace

Keys make_keys(const TableNames& names) {
  Keys keys;
  add_general(keys);
  for (const std::string& name : names.zones) add_zone(keys, name);
  for (const std::string& name : names.materials) add_material(keys, name);
  add_wheel(keys);
  add_rail(keys);
  add_fastenings(keys);
  add_slab(keys);
  add_sleepers(keys);
  for (const std::string& name : names.supports) add_support(keys, name);
  add_vehicle_and_load(keys);
  add_contact(keys);
  add_motion(keys);
  add_corrugation(keys);
  add_wear(keys);
  add_impacts(keys);
  add_forks(keys);
  for (const std::string& name : names.surfaces) add_surface(keys, name);
  for (const std::string& name : names.bodies) add_body(keys, name);
  for (const std::string& name : names.probes) add_probe(keys, name);
  add_output(keys);
  const auto effects = effects_of_tables(keys);
  for (const SceneTable& table : make_tables(names)) {
    if (!table.removable()) continue;
    const auto found = effects.find(table.name);
    keys.push_back(presence_of(table.name, found == effects.end() ? Effects({}) : found->second));
  }
  return keys;
}

namespace {

/// Tables of one kind, of which a scene has as many as it gives names to.
struct NamedTables {
  std::string_view prefix;
  void (*add_keys)(Keys&, const std::string& name);
  const char* description;
  void (*create)(Scene&, const std::string& name);
  void (*remove)(Scene&, const std::string& name);
  bool (*exists)(const Scene&, const std::string& name);

  SceneTable table(const std::string& name) const {
    return {.name = std::string(prefix) + name,
            .description = std::string(description) + " The name consists of letters, digits, _ and -.",
            .create = [create = create, name](Scene& scene) { create(scene, name); },
            .remove = [remove = remove, name](Scene& scene) { remove(scene, name); },
            .exists = [exists = exists, name](const Scene& scene) { return exists(scene, name); }};
  }
};

template <auto Map>
void add_to(Scene& scene, const std::string& name) {
  (scene.*Map)[name] = {};
}

void add_material_to(Scene& scene, const std::string& name) {
  scene.materials[name] = {.name = name};
}

/// Tables that are entries of a map of the scene.
template <auto Map>
constexpr NamedTables entries_of(std::string_view prefix, void (*add_keys)(Keys&, const std::string& name),
                                 const char* description,
                                 void (*create)(Scene&, const std::string& name) = add_to<Map>) {
  return {prefix,
          add_keys,
          description,
          create,
          [](Scene& scene, const std::string& name) { (scene.*Map).erase(name); },
          [](const Scene& scene, const std::string& name) { return (scene.*Map).contains(name); }};
}

constexpr std::array<NamedTables, 6> kNamedTables = {
    entries_of<&Scene::materials>(
        kMaterialTables, add_material,
        "A material of that name; parts name their material: `wheel.material`, `rail.material`, "
        "`slab.material`.",
        add_material_to),
    entries_of<&Scene::zones>(
        kZoneTables, add_zone,
        "Another finely divided part of the rail, for a weld or a squat away from the solution zone.\nThe "
        "wheel "
        "is finely divided where it meets the part.\nFigures and stresses of the report stay those of the "
        "solution zone."),
    entries_of<&Scene::supports>(
        kSupportTables, add_support,
        "A fastening, with the sleeper under it, that differs from the others: a broken clip, a loose pad, a "
        "hanging or displaced sleeper."),
    entries_of<&Scene::surfaces>(
        kSurfaceTables, add_surface,
        "Depth on the running surface of rail or wheel, added to the contact gap. Depths of all such tables "
        "and of [corrugation] are summed.\nA place on the wheel is where it meets the rail in free rolling, "
        "once a turn."),
    entries_of<&Scene::bodies>(
        kBodyTables, add_body,
        "A mesh of another program in place of the wheel's disc, between tread and axle, or of the rail "
        "below its head.\nSets of its nodes are tied to the parts beside it.\n"
        "`tread import` reads and checks such a mesh by itself."),
    entries_of<&Scene::probes>(
        kProbeTables, add_probe,
        "A point of a body whose motion or stress the histories hold, in columns that begin with the "
        "probe's name.\nAccelerations are means over the interval between two samples.\nFrequencies above "
        "half the sample rate are weakened, not removed; shorten `output.history_interval`.")};

/// The kind of the table; null for tables that no scene names.
const NamedTables* kind_of(std::string_view table) {
  for (const NamedTables& kind : kNamedTables)
    if (table.starts_with(kind.prefix)) return &kind;
  return nullptr;
}

/// Adds the tables of these names.
void add_named(std::vector<SceneTable>& tables, std::string_view prefix,
               const std::vector<std::string>& names) {
  for (const std::string& name : names) tables.push_back(kind_of(prefix)->table(name));
}

}  // namespace

std::vector<SceneTable> make_tables(const TableNames& names) {
  std::vector<SceneTable> tables = {always("scene", "Title, base and fineness of the scene."),
                                    always("solution_zone", "The finely divided part of the rail.")};
  add_named(tables, kZoneTables, names.zones);
  add_named(tables, kMaterialTables, names.materials);
  const std::vector<SceneTable> others = {
      component("wheel", &Scene::wheel, "The flexible wheelset, or a simpler body that rolls."),
      component("rail", &Scene::rail, "The flexible rail, or a block or bar in its place."),
      component("fastenings", &Scene::fastenings,
                "Groups of spring-dampers under the rail; they stand on the slab or on sleepers, or on rigid "
                "ground "
                "where there is neither."),
      component("slab", &Scene::slab_track, "Slabs with filled gaps on mortar, moving vertically."),
      component("sleepers", &Scene::sleepers,
                "Elastic sleepers under the fastenings, on ballast or another bed of spring-dampers.\n"
                "Half of each lies on this side of the track's middle, which is a plane of symmetry.\n"
                "They bend in the plane across the track.\nNot together with [slab]."),
      component("vehicle", &Scene::vehicle, "Masses and primary suspension on the wheelset."),
      component("load", &Scene::load, "A force on the wheel in place of a vehicle."),
      component("contact", &Scene::contact, "Contact and friction between wheel and rail."),
      component("motion", &Scene::motion,
                "The transient run; a scene without it ends with its static state."),
      component("corrugation", &Scene::corrugation,
                "Periodic or measured depth of the rail's running surface."),
      component("wear", &Scene::wear,
                "Wear of the profile by the frictional work of passages, for `tread develop`. "
                "[Corrugation that grows](../records/develop.md)"),
      component("pulse", &Scene::pulse, "An initial velocity at one end of a bar: a rail without a wheel."),
      component("hammer", &Scene::hammer,
                "A blow on the rail head; the histories hold its force and the struck point's "
                "displacement."),
      component("forks", &Scene::forks,
                "A kept state, from which runs over other corrugations begin. "
                "[Long runs](../explanation/long-runs.md)"),
  };
  tables.insert(tables.end(), others.begin(), others.end());
  add_named(tables, kSupportTables, names.supports);
  add_named(tables, kSurfaceTables, names.surfaces);
  add_named(tables, kBodyTables, names.bodies);
  add_named(tables, kProbeTables, names.probes);
  tables.push_back(always("output", "Intervals of samples, progress lines, checkpoints and frames."));
  tables.push_back(
      always("stop", "Limits that end a run before its duration. [Long runs](../explanation/long-runs.md)"));
  return tables;
}

std::string_view named_table_of(std::string_view path) {
  const auto allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  };
  const NamedTables* kind = kind_of(path);
  if (!kind) return "";
  const std::string_view table = path.substr(0, path.find('.', kind->prefix.size()));
  const std::string_view name = table.substr(kind->prefix.size());
  return !name.empty() && std::all_of(name.begin(), name.end(), allowed) ? table : "";
}

Keys named_keys(std::string_view table) {
  Keys keys;
  if (table.empty()) return keys;
  const NamedTables& kind = *kind_of(table);
  kind.add_keys(keys, std::string(table.substr(kind.prefix.size())));
  Effects effects = {};
  for (const Key& key : keys) effects = effects | key.effects;
  keys.push_back(presence_of(std::string(table), effects));
  return keys;
}

std::optional<SceneTable> named_table(std::string_view table) {
  if (table.empty()) return std::nullopt;
  const NamedTables& kind = *kind_of(table);
  return kind.table(std::string(table.substr(kind.prefix.size())));
}

}  // namespace tread::keys
