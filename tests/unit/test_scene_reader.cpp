#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "io/scene/scene_checks.hpp"
#include "io/scene/scene_library.hpp"
#include "io/scene/scene_reader.hpp"
#include "io/scene/schema.hpp"
#include "tests/refusal.hpp"
#include "tests/temporary_folder.hpp"

namespace tread {
namespace {

namespace fs = std::filesystem;

const fs::path kScenes = fs::path(TREAD_SOURCE_DIR) / "scenes";

std::string value_of(const ResolvedScene& resolved, const std::string& path) {
  for (const Entry& entry : resolved.entries) {
    if (entry.path == path) return entry.value + (entry.unit.empty() ? "" : " " + entry.unit);
  }
  return "absent";
}

std::string source_of(const ResolvedScene& resolved, const std::string& path) {
  for (const Entry& entry : resolved.entries) {
    if (entry.path == path) return entry.source;
  }
  return "absent";
}

ResolvedScene resolve(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return resolve_scene(SceneSource{"scene.toml", text, "."}, overrides);
}

const std::string kBase = "[scene]\nbased_on = \"highspeed-slab-2014\"\n";

/// Compares field by field, bit by bit.
void expect_same(Scene a, Scene b) {
  for (const SceneTable& table : scene_tables()) EXPECT_EQ(table.exists(a), table.exists(b)) << table.name;
  EXPECT_EQ(a.material_names(), b.material_names());
  for (const Key& key : scene_keys(a)) {
    if (!key.locate) continue;
    const Field left = key.locate(a);
    const Field right = key.locate(b);
    EXPECT_EQ(left.index(), right.index()) << key.path;
    EXPECT_EQ(number_at(left), number_at(right)) << key.path;
    if (const auto* text = std::get_if<std::string*>(&left)) {
      EXPECT_EQ(**text, *std::get<std::string*>(right)) << key.path;
    }
    if (const auto* truth = std::get_if<bool*>(&left)) {
      EXPECT_EQ(**truth, *std::get<bool*>(right)) << key.path;
    }
    if (const auto* damping = std::get_if<DampingField>(&left)) {
      EXPECT_EQ(*damping->rayleigh_beta, *std::get<DampingField>(right).rayleigh_beta) << key.path;
    }
  }
  if (a.rail) {
    EXPECT_EQ(a.rail->profile_y, b.rail->profile_y);
  }
  if (a.wheel) {
    EXPECT_EQ(a.wheel->profile_z, b.wheel->profile_z);
  }
  if (a.corrugation) {
    EXPECT_EQ(a.corrugation->table_x, b.corrugation->table_x);
    EXPECT_EQ(a.corrugation->table_depth, b.corrugation->table_depth);
  }
}

void expect_round_trip(const ResolvedScene& resolved) {
  const std::string text = resolved_toml(resolved);
  const ResolvedScene again = resolve_scene(SceneSource{"scene.resolved.toml", text, "/"});
  expect_same(resolved.scene, again.scene);
  EXPECT_EQ(resolved.entries.size(), again.entries.size());
}

TEST(SceneReader, ShippedScenesReadAndSurviveTheResolvedFile) {
  int scenes = 0;
  for (const auto& file : fs::directory_iterator(kScenes)) {
    if (file.path().extension() != ".toml") continue;
    SCOPED_TRACE(file.path().string());
    const ResolvedScene resolved = resolve_scene(file.path());
    EXPECT_FALSE(resolved.scene.title.empty());
    EXPECT_TRUE(validate(resolved.scene).empty());
    expect_round_trip(resolved);
    ++scenes;
  }
  EXPECT_GE(scenes, 5);
}

TEST(SceneReader, ShippedScenesContainOnlyWhatTheyName) {
  const Scene paper = read_scene(kScenes / "corrugation-d.toml");
  EXPECT_TRUE(paper.wheel && paper.rail && paper.fastenings && paper.slab_track && paper.vehicle &&
              paper.contact);
  EXPECT_TRUE(paper.motion && paper.corrugation);
  EXPECT_FALSE(paper.load || paper.pulse);
  EXPECT_EQ(paper.motion->traction_mu, 0.3);

  EXPECT_FALSE(read_scene(kScenes / "smooth.toml").corrugation);

  const Scene ground = read_scene(kScenes / "rigid-ground.toml");
  EXPECT_TRUE(ground.fastenings);
  EXPECT_FALSE(ground.slab_track);
  EXPECT_EQ(ground.material_names(), "steel");

  const Scene sphere = read_scene(kScenes / "sphere-on-block.toml");
  EXPECT_TRUE(sphere.wheel && sphere.rail && sphere.load && sphere.contact);
  EXPECT_FALSE(sphere.fastenings || sphere.slab_track || sphere.vehicle || sphere.motion ||
               sphere.corrugation);

  const Scene bar = read_scene(kScenes / "bar-wave.toml");
  EXPECT_TRUE(bar.rail && bar.pulse && bar.motion);
  EXPECT_FALSE(bar.wheel || bar.contact || bar.vehicle || bar.load);
}

TEST(SceneReader, LibraryHoldsTable1) {
  const Scene scene = resolve(kBase).scene;
  EXPECT_EQ(scene.contact->friction, 0.5);
  EXPECT_EQ(scene.vehicle->sprung_mass, 8000);
  EXPECT_EQ(scene.wheel->diameter, 0.86);
  EXPECT_EQ(scene.wheel->mass, 586);
  EXPECT_EQ(scene.vehicle->unsprung_mass, 340);
  EXPECT_EQ(scene.vehicle->suspension_stiffness, 880e3);
  EXPECT_EQ(scene.vehicle->suspension_damping, 4e3);
  EXPECT_EQ(scene.fastenings->stiffness, 22e6);
  EXPECT_EQ(scene.fastenings->damping, 200e3);
  EXPECT_EQ(scene.material("steel").youngs_modulus, 205.9e9);
  EXPECT_EQ(scene.material("steel").poissons_ratio, 0.3);
  EXPECT_EQ(scene.material("steel").density, 7790);
  EXPECT_EQ(scene.material("steel").high_frequency_fraction, 1e-4);
  EXPECT_EQ(scene.material("steel").rayleigh_beta, 0);
  EXPECT_EQ(scene.material("slab").youngs_modulus, 34.5e9);
  EXPECT_EQ(scene.material("slab").poissons_ratio, 0.25);
  EXPECT_EQ(scene.material("slab").density, 2400);
  EXPECT_EQ(scene.material("gap_filler").youngs_modulus, 29.5e9);
  EXPECT_EQ(scene.material("gap_filler").poissons_ratio, 0.25);
  EXPECT_EQ(scene.material("gap_filler").density, 2400);
  EXPECT_EQ(scene.material("mortar").youngs_modulus, 8e9);
  EXPECT_EQ(scene.material("mortar").poissons_ratio, 0.2);
  EXPECT_EQ(scene.material("mortar").density, 1600);
}

TEST(SceneReader, LibraryNamesKnownKeysOnly) {
  for (const LibraryEntry& entry : scene_library()) {
    for (const LibraryValue& value : entry.values) {
      EXPECT_TRUE(find_key(value.path)) << value.path;
      EXPECT_FALSE(value.source.empty()) << value.path;
    }
  }
}

TEST(SceneReader, LibraryEntryStandsOnItsBase) {
  const ResolvedScene scene = resolve(kBase, {"scene.based_on=highspeed-slab-2014-calibrated"});
  EXPECT_EQ(scene.scene.fastenings->damping, 100e3);
  EXPECT_EQ(scene.scene.rail->origin, 6.4625);
  EXPECT_EQ(scene.scene.fastenings->stiffness, 22e6);
  EXPECT_EQ(source_of(scene, "fastenings.stiffness"), "highspeed-slab-2014: Table 1");
  EXPECT_EQ(source_of(scene, "rail.origin").rfind("highspeed-slab-2014-calibrated: ", 0), 0U);
}

TEST(SceneReader, AHeadFromAFileBelongsToTheRailOfTheLibraryEntry) {
  const std::string base = "[scene]\nbased_on = \"ballasted-60e1\"\n";
  SceneSource source{"scene.toml", base + "[rail]\nprofile = \"head.txt\"\n", "/nowhere"};
  source.files["/nowhere/head.txt"] =
      std::make_shared<const std::string>("# y [mm]  z [mm]\n-36 -14\n-20 -1\n0 0\n20 -1\n36 -14\n");
  const ResolvedScene worn = resolve_scene(source);
  EXPECT_EQ(worn.scene.rail->section, "60E1");
  EXPECT_EQ(source_of(worn, "rail.section"), "ballasted-60e1: EN 13674-1");
  EXPECT_EQ(resolve_scene(source, {"rail.section=60E2"}).scene.rail->section, "60E2");
  EXPECT_EQ(value_of(resolve(base), "rail.section"), "absent");
}

/// A resume compares the resolved scene's text, also with that of runs of earlier versions.
TEST(SceneReader, KeysOfTheTorqueStandInTheResolvedSceneWithoutOne) {
  for (const char* key : {"ramp", "shape", "reversals"})
    EXPECT_NE(source_of(resolve(kBase), std::string("motion.traction.") + key), "absent") << key;
  expect_round_trip(resolve(kBase, {"motion.traction.ramp=1 ms", "motion.traction.reversals=2"}));
}

TEST(SceneReader, LaterLevelsOverrideEarlierOnes) {
  const std::string text = kBase + "[motion]\nspeed = \"250 km/h\"\ntraction = { mu = 0.2 }\n";
  const ResolvedScene file = resolve(text);
  EXPECT_EQ(file.scene.motion->speed, 250e3 / 3600);
  EXPECT_EQ(source_of(file, "motion.speed"), "scene.toml:4");
  EXPECT_EQ(source_of(file, "motion.traction.mu"), "scene.toml:5");
  EXPECT_EQ(source_of(file, "rail.length"), "highspeed-slab-2014: section 2.1.1");
  EXPECT_EQ(source_of(file, "motion.step_safety"), "default");

  const ResolvedScene set = resolve(text, {"motion.speed=500 km/h", "rail.inclination = 1:20",
                                           "motion.spin_in_preload=false", "scene.title = \"a \\\"b\\\"\""});
  EXPECT_EQ(value_of(set, "motion.speed"), "138.88888888888889 m/s");
  EXPECT_EQ(source_of(set, "motion.speed"), "--set");
  EXPECT_EQ(set.scene.rail->inclination, 0.05);
  EXPECT_FALSE(set.scene.motion->spin_in_preload);
  EXPECT_EQ(set.scene.title, "a \"b\"");
  expect_round_trip(set);
}

TEST(SceneReader, ATorqueSetLaterReplacesTheTractionCoefficient) {
  const std::string text = kBase + "[motion]\ntraction = { mu = 0.2 }\n";
  const Scene scene = resolve(text, {"motion.traction.torque=13.8 kN m"}).scene;
  EXPECT_FALSE(scene.motion->traction_mu);
  EXPECT_EQ(scene.motion->traction_torque, 13.8e3);
}

TEST(SceneReader, TablesComeAndGo) {
  EXPECT_FALSE(resolve(kBase + "[slab]\npresent = false\n").scene.slab_track);
  EXPECT_TRUE(resolve(kBase + "[slab]\npresent = false\n", {"slab.present=true"}).scene.slab_track);
  EXPECT_FALSE(resolve(kBase, {"slab.present=false"}).scene.slab_track);
  EXPECT_FALSE(resolve(kBase).scene.corrugation);
  EXPECT_EQ(resolve(kBase + "[corrugation]\n").scene.corrugation->depth, 0.14e-3);
  EXPECT_EQ(resolve(kBase, {"corrugation.depth=0.1 mm"}).scene.corrugation->depth, 0.1e-3);
}

TEST(SceneReader, DampingHasTwoNames) {
  const std::string text =
      kBase + "[material.steel]\ndamping = { kind = \"rayleigh_beta\", value = \"1e-8 s\" }\n";
  const ResolvedScene resolved = resolve(text);
  EXPECT_EQ(resolved.scene.material("steel").rayleigh_beta, 1e-8);
  EXPECT_EQ(resolved.scene.material("steel").high_frequency_fraction, 0);
  expect_round_trip(resolved);
}

TEST(SceneReader, DampingIsNotNegative) {
  for (const char* damping : {"{ kind = \"rayleigh_beta\", value = \"-1e-8 s\" }",
                              "{ kind = \"high_frequency_fraction\", value = -0.1 }"})
    EXPECT_THROW(resolve(kBase + "[material.steel]\ndamping = " + damping + "\n"), InputError) << damping;
}

const std::string kWheelSteel =
    "[material.wheel_steel]\nyoungs_modulus = \"70 GPa\"\npoissons_ratio = 0.33\ndensity = \"2700 kg/m3\"\n"
    "damping = { kind = \"rayleigh_beta\", value = \"1e-8 s\" }\n";

TEST(SceneReader, EveryPartNamesItsMaterial) {
  const ResolvedScene resolved = resolve(
      kBase + kWheelSteel +
      "[material.rail-2]\nyoungs_modulus = \"210 GPa\"\npoissons_ratio = 0.29\ndensity = \"7850 kg/m3\"\n"
      "[wheel]\nmaterial = \"wheel_steel\"\n[rail]\nmaterial = \"rail-2\"\n[slab]\nmortar_material = "
      "\"slab\"\n");
  const Scene& scene = resolved.scene;
  EXPECT_EQ(scene.wheel_material().youngs_modulus, 70e9);
  EXPECT_EQ(scene.wheel_material().rayleigh_beta, 1e-8);
  EXPECT_EQ(scene.wheel_material().name, "wheel_steel");
  EXPECT_EQ(scene.rail_material().density, 7850);
  EXPECT_EQ(scene.material(scene.slab_track->mortar_material).youngs_modulus, 34.5e9);
  // Steel and mortar of the base, which no part is of, have gone.
  EXPECT_EQ(scene.material_names(), "gap_filler, rail-2, slab, wheel_steel");
  EXPECT_EQ(source_of(resolved, "material.wheel_steel.density"), "scene.toml:6");
  EXPECT_EQ(source_of(resolved, "wheel.material"), "scene.toml:13");
  expect_round_trip(resolved);
}

TEST(SceneReader, MaterialsAreNamedOnTheCommandLine) {
  const ResolvedScene resolved =
      resolve(kBase, {"material.soft.youngs_modulus=70 GPa", "material.soft.poissons_ratio=0.33",
                      "material.soft.density=2700 kg/m3", "wheel.material=soft"});
  EXPECT_EQ(resolved.scene.wheel_material().youngs_modulus, 70e9);
  EXPECT_EQ(resolved.scene.rail_material().youngs_modulus, 205.9e9);
  EXPECT_EQ(source_of(resolved, "material.soft.density"), "--set");
  expect_round_trip(resolved);
}

TEST(SceneReader, LongTextsAndNamesAreReadBack) {
  const std::string title = "title = \"\"\"\n" + std::string(998, 'x') + "\t\n\"\"\"\n";
  const std::string name = std::string(3000, 'd') + "\xDF.toml";  // Latin-1
  expect_round_trip(resolve_scene(SceneSource{name, kBase + title, {}}));
}

TEST(SceneReader, ScenesKeptByFinishedRunsStayReadable) {
  const fs::path kept =
      fs::path(TREAD_SOURCE_DIR) / "docs/records/performance/paper-passage/scene.resolved.toml";
  const Scene scene = read_scene(kept);
  EXPECT_EQ(scene.wheel_material().youngs_modulus, 205.9e9);
  EXPECT_EQ(scene.rail_material().name, "steel");
  EXPECT_EQ(scene.material(scene.slab_track->mortar_material).density, 1600);
}

TEST(SceneReader, TheHeadIsOfTheRailsMaterialUnlessItHasItsOwn) {
  const std::string head =
      "[material.head]\nyoungs_modulus = \"200 GPa\"\npoissons_ratio = 0.3\ndensity = \"7800 kg/m3\"\n"
      "[rail]\nhead_material = \"head\"\n";
  const std::string track = "[scene]\nbased_on = \"highspeed-slab-2014\"\n";
  const Scene plain = resolve_scene(SceneSource{"scene.toml", track, {}}).scene;
  EXPECT_EQ(&plain.head_material(), &plain.rail_material());
  const ResolvedScene resolved = resolve_scene(SceneSource{"scene.toml", track + head, {}});
  EXPECT_EQ(resolved.scene.rail_material().youngs_modulus, 205.9e9);
  EXPECT_EQ(resolved.scene.elastic_pair().rail.youngs_modulus, 200e9);
  const ResolvedScene again = resolve_scene(SceneSource{"again.toml", resolved_toml(resolved), {}});
  EXPECT_EQ(again.scene.head_material().name, "head");
}

TEST(SceneReader, MaterialsOfBodiesThatAreNotThereAreErrors) {
  const Scene rail = read_scene(kScenes / "bar-wave.toml");
  EXPECT_EQ(rail.rail_material().name, "steel");
  EXPECT_THROW(rail.wheel_material(), InputError);
  EXPECT_THROW(rail.elastic_pair(), InputError);
  EXPECT_EQ(samples::refusal<InputError>([&] { rail.material("stel"); }),
            "the scene has no material \"stel\"; it has steel");
}

TEST(SceneReader, CorrugationTableIsReadBesideTheScene) {
  const samples::TemporaryFolder temporary;
  const fs::path& folder = temporary.path;
  std::ofstream(folder / "measured.txt") << "# x [mm]; d [um]\n0; 0\n50; 60.5  # trough\n\n100, 0\n";
  const SceneSource source{"scene.toml", kBase + "[corrugation]\nkind = \"table\"\nfile = \"measured.txt\"\n",
                           folder};
  const ResolvedScene resolved = resolve_scene(source);
  EXPECT_EQ(resolved.scene.corrugation->table_x, (std::vector<double>{0, 0.05, 0.1}));
  EXPECT_EQ(resolved.scene.corrugation->table_depth, (std::vector<double>{0, 60.5e-6, 0}));
  expect_round_trip(resolved);
}

TEST(SceneReader, ProfilesAreReadBesideTheScene) {
  const samples::TemporaryFolder temporary;
  const fs::path& folder = temporary.path;
  std::ofstream(folder / "worn.txt") << "-70 0\n65 -3.1\n";
  const ResolvedScene resolved =
      resolve_scene(SceneSource{"scene.toml", kBase + "[wheel]\nprofile = \"worn.txt\"\n", folder});
  EXPECT_EQ(resolved.scene.wheel->profile_y, (std::vector<double>{-70e-3, 65e-3}));
  EXPECT_EQ(resolved.scene.wheel->profile_z, (std::vector<double>{0, -3.1e-3}));
  EXPECT_EQ(resolved.scene.wheel->profile_reading,
            "two columns, stated or mm, 2 points; fewer than 10 points give radii only roughly");
  EXPECT_TRUE(resolved.scene.rail->profile_y.empty());
  expect_round_trip(resolved);
}

TEST(SceneReader, ReferencePageIsUpToDate) {
  std::ifstream stream(fs::path(TREAD_SOURCE_DIR) / "docs" / "reference" / "scene.md");
  std::stringstream page;
  page << stream.rdbuf();
  EXPECT_EQ(page.str(), scene_reference())
      << "docs/reference/scene.md is not scene_reference(); write it anew";
}

TEST(Schema, KnowsTheKeysOfMaterialsOfAnyName) {
  const std::optional<Key> key = find_key("material.wheel_steel.density");
  ASSERT_TRUE(key);
  EXPECT_EQ(key->path, "material.wheel_steel.density");
  EXPECT_TRUE(is_table("material.wheel_steel"));
  EXPECT_EQ(table_of("material.wheel_steel.density")->name, "material.wheel_steel");
  EXPECT_FALSE(find_key("material.wheel_steel"));
  EXPECT_FALSE(find_key("material.wheel_steel.colour"));
  EXPECT_FALSE(find_key("material.wheel steel.density"));
  EXPECT_FALSE(is_table("material.wheel steel"));
  EXPECT_FALSE(is_table("material."));
  Scene scene;
  EXPECT_TRUE(std::holds_alternative<std::monostate>(key->locate(scene)));
  scene.materials["wheel_steel"].density = 7800;
  EXPECT_EQ(number_at(key->locate(scene)), 7800);
  EXPECT_EQ(usual_user("steel"), "wheel");
  EXPECT_EQ(usual_user("mortar"), "slab");
  EXPECT_EQ(usual_user("wheel_steel"), "");
}

TEST(Schema, TheKeyOfATablesPresenceAffectsWhatTheTablesKeysDo) {
  EXPECT_EQ(find_key("hammer.present")->effects, Effects({Effect::motion}));
  EXPECT_EQ(find_key("probe.a.present")->effects, Effects({Effect::output}));
  TableNames names;
  names.zones = {"a", "b"};
  names.probes = {"a"};
  const std::map<std::string, Effects> expected = {{"zone.a.present", {Effect::mesh}},
                                                   {"zone.b.present", {Effect::mesh}},
                                                   {"probe.a.present", {Effect::output}},
                                                   {"hammer.present", {Effect::motion}}};
  std::size_t found = 0;
  for (const Key& key : scene_keys(names)) {
    const auto known = expected.find(key.path);
    if (known == expected.end()) continue;
    ++found;
    EXPECT_EQ(key.effects, known->second) << key.path;
  }
  EXPECT_EQ(found, expected.size());
}

TEST(Schema, EveryKeyIsWellFormed) {
  Scene everything;
  for (const SceneTable& table : scene_tables()) {
    if (table.removable()) table.create(everything);
  }
  std::set<std::string> paths;
  for (const Key& key : scene_keys()) {
    SCOPED_TRACE(key.path);
    EXPECT_TRUE(paths.insert(key.path).second);
    EXPECT_FALSE(key.description.empty());
    EXPECT_TRUE(table_of(key.path));
    if (key.quantity) {
      EXPECT_EQ(parse_unit(key.unit).dimension, key.quantity->dimension);
      EXPECT_EQ(parse_unit(key.quantity->si).dimension, key.quantity->dimension);
    }
    if (!key.only_with.key.empty()) {
      EXPECT_TRUE(table_of(key.only_with.key));
    }
    if (!key.locate || key.required) continue;
    const std::optional<double> value = number_at(key.locate(everything));
    EXPECT_TRUE(!value || key.range.contains(*value)) << *value;
  }
}

}  // namespace
}  // namespace tread
