// Parts that come as bodies of hexahedra are the swept parts that they were made of.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/index.hpp"
#include "core/parallel/parallel.hpp"
#include "drivers/engine/chosen_fields.hpp"
#include "drivers/engine/simulation.hpp"
#include "drivers/engine/start/preload.hpp"
#include "drivers/engine/start/step_limit.hpp"
#include "drivers/results/frame_files.hpp"
#include "drivers/results/resolution.hpp"
#include "drivers/studies/export/keyword_export.hpp"
#include "io/mesh/imported_mesh.hpp"
#include "io/scene/scene_reader.hpp"
#include "kernels/device/device.hpp"
#include "kernels/hexahedra/body_force.hpp"
#include "tests/field_differences.hpp"
#include "tests/refusal.hpp"
#include "tests/swept_samples.hpp"

namespace tread {
namespace {

Scene wheelset_scene(const std::vector<std::string>& overrides) {
  std::vector<std::string> all = {"scene.element_size=9mm",    "rail.length=1.4m",
                                  "fastenings.count=2",        "fastenings.first=0.35m",
                                  "rail.origin=0.6m",          "solution_zone.start=0.05m",
                                  "solution_zone.length=0.1m", "corrugation.start=0.07m",
                                  "corrugation.length=0.08m",  "motion.duration=1.2ms"};
  all.insert(all.end(), overrides.begin(), overrides.end());
  SceneSource source{"bodies", "[scene]\nbased_on = \"highspeed-slab-2014\"\n", "/nowhere"};
  return resolve_scene(source, all).scene;
}

/// Nodes of a path of the block's section at all stations, as hexahedra_of() numbers them.
std::vector<std::int32_t> nodes_on(const SweptBlock& block, const std::string& path) {
  std::vector<std::int32_t> nodes;
  for (int station = 0; station < block.station_count(); ++station)
    for (const int node : block.section.paths.at(path))
      nodes.push_back(station * block.section.nodes() + node);
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

/// A smooth field: of a body that moves and stretches.
AlignedVector<double> smooth_field(const Mesh& mesh) {
  AlignedVector<double> field(index(3 * mesh.slots), 0.0);
  for (const SweptBlock& block : mesh.blocks)
    for (int station = 0; station < block.station_count(); ++station)
      for (int node = 0; node < block.section.nodes(); ++node) {
        const Vec3 x = position(block, node, station);
        const Vec3 u = {1e-5 * std::sin(3 * x.z + x.y), 1e-5 * std::cos(4 * x.x),
                        1e-5 * std::sin(2 * x.x - 5 * x.y)};
        NodeField(field.data()).set(block.base + block.slot(node, station), to_local(block, station, 0, u));
      }
  return field;
}

/// A set of a body's nodes: where the spec has its name, and the path of the block that they are.
struct SetOfPath {
  std::string BodySpec::*name;
  const char* path;
};

/// A model's swept block as a body.
BodySpec swept_body(const SweptBlock& block, const char* replaces, std::initializer_list<SetOfPath> sets) {
  BodySpec spec;
  spec.replaces = replaces;
  HexMesh mesh = hexahedra_of(block);
  for (const SetOfPath& set : sets) {
    spec.*set.name = set.path;
    mesh.node_sets[set.path] = nodes_on(block, set.path);
  }
  spec.mesh = std::make_shared<const HexMesh>(std::move(mesh));
  return spec;
}

Scene with_disc(const Model& model, Scene scene) {
  scene.bodies["disc"] = swept_body(model.mesh.blocks[index(model.index.disc)], "disc",
                                    {{&BodySpec::tread, "tie_outer"}, {&BodySpec::axle, "tie_inner"}});
  scene.wheel->web_thickness = model.web_thickness;  // lines of the tread meet those of the web
  return scene;
}

Scene with_base(const Model& model, Scene scene) {
  scene.bodies["base"] = swept_body(model.mesh.blocks[index(model.index.rail_base)], "rail",
                                    {{&BodySpec::head, "tie"}, {&BodySpec::foot, "foot"}});
  return scene;
}

TEST(Bodies, HaveTheMassesOfTheSweptDisc) {
  const Scene scene = wheelset_scene({});
  const Model swept(scene);
  const Model model(with_disc(swept, scene));
  ASSERT_EQ(model.mesh.bodies.size(), 1u);
  EXPECT_EQ(model.elements(), swept.elements());
  EXPECT_NEAR(model.wheelset->mass() / swept.wheelset->mass(), 1, 1e-12);
  EXPECT_NEAR(model.wheelset->inertia() / swept.wheelset->inertia(), 1, 1e-6);
  EXPECT_NEAR(model.wheelset->transverse_inertia() / swept.wheelset->transverse_inertia(), 1, 1e-5);
  EXPECT_NEAR(model.wheelset->centre_y(), swept.wheelset->centre_y(), 1e-12);
  EXPECT_EQ(model.ties->secondary_count(), swept.ties->secondary_count());
  EXPECT_EQ(model.ties->primary_slots().size(), swept.ties->primary_slots().size());
  EXPECT_NEAR(stable_step_of(model) / stable_step_of(swept), 1, 1e-4);

  choose_device("emulated");  // takes steps of blocks alone
  EXPECT_THROW(make_node_fields(model), InputError);
  choose_device("cpu");
}

/// The field of the swept model in the fields of the model with the body.
AlignedVector<double> carried_over(const Model& swept, const Model& model,
                                   const AlignedVector<double>& field) {
  AlignedVector<double> out(index(3 * model.mesh.slots), 0.0);
  const ConstNodeField from(field.data());
  const NodeField to(out.data());
  for (const SweptBlock& block : swept.mesh.blocks) {
    const auto same = std::find_if(model.mesh.blocks.begin(), model.mesh.blocks.end(),
                                   [&](const SweptBlock& other) { return other.name == block.name; });
    for (int station = 0; station < block.station_count(); ++station)
      for (int node = 0; node < block.section.nodes() && same != model.mesh.blocks.end(); ++node)
        to.set(same->base + same->slot(node, station), from.at(block.base + block.slot(node, station)));
    if (same != model.mesh.blocks.end()) continue;
    const HexBody& body = model.mesh.bodies[0];
    for (std::int64_t n = 0; n < body.nodes(); ++n) {
      const auto number = static_cast<int>(body.mesh.node_number[index(n)] - 1);  // of hexahedra_of()
      const int station = number / block.section.nodes();
      const std::int64_t slot = block.base + block.slot(number % block.section.nodes(), station);
      to.set(body.slot(n), to_cartesian(block, station, 0, from.at(slot)));
    }
  }
  return out;
}

/// Compares forces of a smooth motion before and after the ties gather them, and the motion of tied nodes.
void expect_same_forces(const Model& swept, const Model& model, double of_motion, double of_forces) {
  AlignedVector<double> u = smooth_field(swept.mesh), f(u.size());
  swept.ties->follow({u.data()});
  const AlignedVector<double> same = carried_over(swept, model, u);
  AlignedVector<double> followed = same, g(same.size(), 0.0);
  model.ties->follow({followed.data()});
  EXPECT_LT(samples::relative_difference(followed, same), of_motion);
  swept.internal_force(u.data(), f.data());
  model.internal_force(same.data(), g.data());
  EXPECT_LT(samples::relative_difference(g, carried_over(swept, model, f)), of_forces);
  swept.ties->gather(f.data());
  model.ties->gather(g.data());
  EXPECT_LT(samples::relative_difference(g, carried_over(swept, model, f)), of_forces);
  swept.apply_stiffness(u.data(), f.data());
  model.apply_stiffness(same.data(), g.data());
  EXPECT_LT(samples::relative_difference(g, carried_over(swept, model, f)), of_forces);
}

TEST(Bodies, HaveTheForcesOfTheSweptRail) {
  const Scene scene = wheelset_scene({});
  const Model swept(scene);
  const Model model(with_base(swept, scene));
  EXPECT_EQ(model.restrained.size(), swept.restrained.size());
  expect_same_forces(swept, model, 1e-12, 1e-11);
}

/// The beam of a rolling start has the section and the material of the built-in rail.
TEST(Bodies, ThatAreNoneOfTheBeamAreNamed) {
  const Scene scene = wheelset_scene({"motion.start=rolling"});
  Scene with_body = with_base(Model(scene), scene);
  const auto warning = [](const Scene& of) {
    for (const std::string& text : resolution_warnings(Model(of)))
      if (text.find("rail.profile and rail.material alone") != std::string::npos) return text;
    return std::string();
  };
  EXPECT_EQ(warning(scene), "");
  EXPECT_EQ(warning(with_body), "");
  BodySpec& base = with_body.bodies.at("base");
  Material soft = scene.rail_material();
  soft.name = "soft";
  soft.youngs_modulus *= 0.9;
  with_body.materials["soft"] = soft;
  base.material = "soft";
  EXPECT_NE(warning(with_body).find("body.base of another Young's modulus"), std::string::npos);
  base.material.clear();
  HexMesh deeper = *base.mesh;  // the head's lower side and what lies near it stay
  for (Vec3& at : deeper.nodes) at.z = std::min(at.z, -0.1 + 1.5 * (at.z + 0.1));
  base.mesh = std::make_shared<const HexMesh>(std::move(deeper));
  EXPECT_NE(warning(with_body).find("body.base of "), std::string::npos);
  EXPECT_NE(warning(with_body).find(" cm2 below its head, makes F_N swing"), std::string::npos);
  with_body.motion->start = "moving";
  EXPECT_EQ(warning(with_body), "");
}

/// Between stations tied nodes lie where they are nearest to the chord, and not at their angle's share of it.
TEST(Bodies, HaveTheForcesOfTheSweptDisc) {
  const Scene scene = wheelset_scene({});
  const Model swept(scene);
  expect_same_forces(swept, Model(with_disc(swept, scene)), 1e-5, 3e-4);
}

/// The rail's base with a layer of a tenth of the elements' length between longer ones.
Scene with_thin_layer(const Model& model, Scene scene) {
  const SweptBlock& block = model.mesh.blocks[index(model.index.rail_base)];
  scene = with_base(model, std::move(scene));
  BodySpec& base = scene.bodies.at("base");
  HexMesh mesh = *base.mesh;
  const int station = block.station_count() / 2;
  for (int node = 0; node < block.section.nodes(); ++node) {
    const double before = mesh.nodes[index((station - 1) * block.section.nodes() + node)].x;
    double& x = mesh.nodes[index(station * block.section.nodes() + node)].x;
    x = before + 0.1 * (x - before);
  }
  base.mesh = std::make_shared<const HexMesh>(std::move(mesh));
  return scene;
}

/// Thicker neighbours hold a thin layer's nodes back, so that it limits the step less than it does alone.
TEST(Bodies, DampingIsRefusedByAssembledElements) {
  const Scene even = wheelset_scene({});
  Scene scene = with_thin_layer(Model(even), even);
  for (auto& [name, material] : scene.materials) material.high_frequency_fraction = 0;
  const StepLimit undamped = step_limit(Model(scene));
  const double of_element = undamped.stiffest[undamped.stiffest_block()].step;
  ASSERT_GT(undamped.stable_step, 2 * of_element);
  Material& steel = scene.materials.at("steel");
  const auto limit_with = [&](double beta) {
    steel.rayleigh_beta = beta;
    return step_limit(Model(scene));
  };
  EXPECT_GT(limit_with(0.7 * undamped.stable_step).stable_step, 0.5 * undamped.stable_step);
  const std::string text = samples::refusal<InputError>([&] { limit_with(0.9 * undamped.stable_step); });
  const std::string words = "rayleigh_beta of at most ";
  ASSERT_NE(text.find(words), std::string::npos) << text;
  const double advised = std::stod(text.substr(text.find(words) + words.size()));
  EXPECT_GT(advised, 0.7 * undamped.stable_step) << text;
  EXPECT_GT(limit_with(advised).stable_step, 0.49 * undamped.stable_step);
}

Scene with_both(const Model& model, Scene scene) {
  return with_base(model, with_disc(model, std::move(scene)));
}

Preload preload_of(Model& model) {
  Preload preload = solve_preload(model, steady_motion(model), [](const std::string& /*text*/) {});
  model.apply_corrugation(preload.contact.centre.y);
  return preload;
}

/// F_N and F_L of every step.
struct Passage {
  std::vector<double> normal, along;  ///< [N]
  double energy_missed = 0;           ///< [J]
};

Passage pass(const Model& model, const Preload& preload, double dt) {
  Passage passage;
  Simulation simulation(model, preload, dt);
  simulation.set_sampling_interval(1);
  constexpr int kSteps = 300;
  for (int i = 0; i < kSteps; ++i) {
    simulation.step();
    passage.normal.push_back(-model.contact->totals().force_on_rail.z);
    passage.along.push_back(model.contact->totals().force_on_rail.x);
  }
  passage.energy_missed = simulation.energy_watch().missed();
  return passage;
}

using WithPart = Scene (*)(const Model& model, Scene scene);

/// `tolerances`: by precision.
void expect_same_passage(const std::vector<std::string>& overrides, WithPart with_part,
                         const std::map<std::string, double>& tolerances) {
  const Scene scene = wheelset_scene(overrides);
  Model swept(scene);
  Model model(with_part(swept, scene));
  const double dt = 0.9 * stable_step_of(swept);
  const Preload of_swept = preload_of(swept);
  const Preload preload = preload_of(model);
  for (const auto& [precision, tolerance] : tolerances) {
    SCOPED_TRACE(precision);
    swept.scene.precision = model.scene.precision = precision;
    const Passage expected = pass(swept, of_swept, dt);
    const Passage passage = pass(model, preload, dt);
    EXPECT_NEAR(preload.rail_deflection / of_swept.rail_deflection, 1, tolerance);
    const double load = swept.wheel_load();
    EXPECT_LT(samples::difference(passage.normal, expected.normal) / load, tolerance);
    EXPECT_LT(samples::difference(passage.along, expected.along) / load, tolerance);
    EXPECT_NEAR(passage.energy_missed, expected.energy_missed, 0.01 * std::abs(expected.energy_missed));
  }
}

TEST(Bodies, RollAsTheSweptRailDoesFromARigidStart) {
  expect_same_passage({"motion.start=rigid", "motion.spin_in_preload=false"}, with_base, {{"double", 1e-7}});
}

/// A rolling start takes derivatives of the deflection along the motion, which differ between the paths.
/// Damping by Maxwell branches.
TEST(Bodies, RollAsTheSweptPartsDoInEveryPrecision) {
  expect_same_passage({"material.steel.damping={ kind = \"rayleigh_beta\", value = \"1e-6 s\" }",
                       "material.steel.damping_up_to=30 kHz"},
                      with_both, {{"double", 1e-4}, {"mixed", 1e-4}, {"single", 1e-3}});
}

/// The scene with disc and rail of the deck that `tread export` writes.
Scene with_exported(const Model& model, Scene scene) {
  std::string text;
  KeywordDeck deck([&](std::string_view piece) { text += piece; });
  write_keyword_deck(model, {}, "test", deck);
  const auto body = [&](const std::string& part) {
    MeshFaults faults;
    ImportedMesh imported = mesh_of(text, "scene.k", {1e-3, {part + ", steel"}, 1}, faults);
    for (const LineFault& fault : faults.list()) ADD_FAILURE() << fault.line << ": " << fault.message;
    return imported.mesh;
  };
  HexMesh disc = body("wheel disc");
  const Vec3 axle = resting_places(model)[index(model.index.tread)].origin;
  for (Vec3& at : disc.nodes) at = at - axle;
  BodySpec& on_wheel = scene.bodies["disc"];
  on_wheel.tread = "disc on tread";
  on_wheel.axle = "disc on axle";
  on_wheel.mesh = std::make_shared<const HexMesh>(std::move(disc));
  BodySpec& on_rail = scene.bodies["base"];
  on_rail.replaces = "rail";
  on_rail.head = "rail under head";
  on_rail.foot = "rail on fastenings";
  on_rail.mesh = std::make_shared<const HexMesh>(body("rail"));
  scene.wheel->web_thickness = model.web_thickness;
  return scene;
}

TEST(Bodies, RollAsTheSceneFromWhichTheyWereExported) {
  expect_same_passage({"motion.start=rigid", "motion.spin_in_preload=false"}, with_exported,
                      {{"double", 3e-5}});
}

TEST(Bodies, HaveTheSameBitsForAnyNumberOfThreads) {
  const Scene scene = wheelset_scene({"motion.start=rigid", "motion.spin_in_preload=false"});
  const Model swept(scene);
  Model model(with_both(swept, scene));
  const Preload preload = preload_of(model);
  const double dt = 0.9 * stable_step_of(model);
  std::vector<std::uint64_t> hashes;
  for (const int count : {1, 3}) {
    set_threads(count);
    Simulation simulation(model, preload, dt);
    for (int i = 0; i < 150; ++i) simulation.step();
    hashes.push_back(simulation.state_hash());
  }
  set_threads(1);
  EXPECT_EQ(hashes[0], hashes[1]);
}

}  // namespace
}  // namespace tread
