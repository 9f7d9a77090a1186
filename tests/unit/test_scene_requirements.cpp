// Scenes that a program fills, without the checks of files.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/error.hpp"
#include "drivers/engine/model/model.hpp"
#include "drivers/engine/model/scene_requirements.hpp"
#include "drivers/engine/simulation.hpp"
#include "io/scene/schema.hpp"
#include "kernels/material/law_state.hpp"
#include "tests/refusal.hpp"
#include "tests/tyre_scene.hpp"

namespace tread {
namespace {

std::string refusal(const Scene& scene) {
  return samples::refusal<InputError>([&] { require_scene(scene); });
}

/// A scene with every table that the schema has, one of each name.
Scene full_scene() {
  Scene scene = samples::tyre_scene();
  const TableNames names{.materials = {"steel"},
                         .zones = {"weld"},
                         .supports = {"broken"},
                         .surfaces = {"dip"},
                         .bodies = {"web"},
                         .probes = {"middle"}};
  for (const SceneTable& table : scene_tables(names))
    if (table.removable() && !table.exists(scene)) table.create(scene);
  scene.load.reset();  // beside the vehicle
  scene.contact->friction_memory = 1e-4;
  scene.contact->friction_x = {0};
  scene.contact->friction_at_x = {0.3};
  scene.corrugation->table_x = {0, 0.1};
  scene.corrugation->map_y = {0};
  scene.corrugation->table_depth = {0, 0};
  return scene;
}

/// A name that only one of both lists has would pass as another's.
TEST(SceneRequirements, KnowTheNamesOfTheSchemaAndNoOthers) {
  Scene scene = full_scene();
  ASSERT_EQ(refusal(scene), "");
  int names = 0;
  for (const Key& key : scene_keys(scene)) {
    if (key.allowed.empty() || key.takes_file) continue;
    std::string& value = *std::get<std::string*>(key.locate(scene));
    const std::string before = value;
    for (const std::string& name : key.allowed) {
      value = name;
      EXPECT_EQ(refusal(scene), "") << key.path;
      ++names;
    }
    value = before + "d";
    samples::expect_part(refusal(scene), key.path + " = \"" + value + "\": no such name; state one of \"");
    value = before;
  }
  EXPECT_GT(names, 50);
}

TEST(SceneRequirements, NameTheMemberAndItsValue) {
  const auto expect_refused = [](const std::function<void(Scene&)>& change, const std::string& text) {
    Scene scene = samples::tyre_scene({"scene.element_size=14 mm"});
    change(scene);
    samples::expect_part(samples::refusal<InputError>([&] { const Model model(scene); }), text);
  };
  for (const double size : {0.0, -1e-3, std::nan(""), std::numeric_limits<double>::infinity()})
    expect_refused([&](Scene& s) { s.element_size = size; }, "scene.element_size = ");
  expect_refused([](Scene& s) { s.materials["steel"].density = 0; }, "material.steel.density = 0 kg/m3");
  expect_refused([](Scene& s) { s.materials["steel"].poissons_ratio = 0.5; }, "poissons_ratio = 0.5");
  expect_refused([](Scene& s) { s.wheel->diameter = 0; }, "wheel.diameter = 0 m");
  expect_refused([](Scene& s) { s.vehicle.emplace(); }, "load.wheel_load = 87564 N beside a vehicle");
  expect_refused([](Scene& s) { s.contact->friction_law = "falling"; }, "contact.friction_memory = 0 m");
  expect_refused([](Scene& s) { s.contact->friction_law = "table"; }, "\"table\" with 0 places");
  expect_refused([](Scene& s) { s.corrugation.emplace().kind = "map"; }, "\"map\" with 0 depths");
  expect_refused([](Scene& s) { s.corrugation.emplace().wavelength = 1; }, "corrugation.wavelength = 1 m");
  const auto apart = [](Scene& scene) {
    scene.corrugation.emplace();
    scene.contact.reset();
  };
  expect_refused(apart, "corrugation.kind = \"sine\": no wheel rolls over it");
}

TEST(SceneRequirements, NoStepWithoutTimeOrOverACorrugationThatIsNotThere) {
  Model model(samples::tyre_scene({"scene.element_size=14 mm", "corrugation.start=60 mm",
                                   "corrugation.wavelength=20 mm", "corrugation.length=20 mm"}));
  Preload preload;
  preload.displacement.assign(static_cast<std::size_t>(3 * model.mesh.slots), 0.0);
  preload.wheel.origin.z = model.contact->touching_height() - 5e-5;
  const auto expect_refused = [&](double dt, const std::string& text) {
    for (const auto& make : {std::function([&] { Simulation(model, preload, dt); }),
                             std::function([&] { Simulation(model, 0.0, dt); })})
      samples::expect_part(samples::refusal<InputError>(make), text);
  };
  expect_refused(1e-7, "Model::apply_corrugation()");
  model.apply_corrugation(0);
  EXPECT_NO_THROW(Simulation(model, preload, 1e-7));
  for (const double dt : {0.0, -1e-7, std::nan("")}) expect_refused(dt, "the step is ");
}

/// The materials of a slab: the advice of one refusal is not refused next.
TEST(SceneRequirements, NodesThatMoveVerticallyNeedTheLinearLawInEveryMaterial) {
  Material elastic = samples::tyre_scene().materials["steel"];
  Material yielding = elastic;
  yielding.law = "j2";
  yielding.yield_stress = 1e6;
  for (const auto& [first, other] : {std::pair(yielding, elastic), {elastic, yielding}}) {
    SweptBlock slab;
    slab.materials = {first, other};
    const auto look = [&] { law_of(slab); };
    samples::expect_part(samples::refusal<InputError>(look), "state the same law for both");
    slab.vertical_only = true;
    samples::expect_part(samples::refusal<InputError>(look), "state law = \"elastic\"");
  }
}

}  // namespace
}  // namespace tread
