// Elastic constants of two bodies in contact, and that a model gives each body its own material.

#include <gtest/gtest.h>

#include <cmath>

#include "core/math/elastic_pair.hpp"
#include "core/math/hertz.hpp"
#include "drivers/engine/model/model.hpp"
#include "drivers/engine/start/rail_beam.hpp"
#include "tests/tyre_scene.hpp"

namespace tread {
namespace {

constexpr ElasticConstants kSteel{205.9e9, 0.3};
constexpr ElasticConstants kLight{70e9, 0.33};

TEST(ElasticPair, AlikeBodiesGiveTheSameBitsAsOneMaterial) {
  const ElasticPair pair{kSteel, kSteel};
  EXPECT_EQ(pair.contact_modulus(), contact_modulus(205.9e9, 0.3));
  EXPECT_EQ(pair.alike().youngs_modulus, 205.9e9);
  EXPECT_EQ(pair.alike().poissons_ratio, 0.3);
  EXPECT_EQ(pair.dundurs_constant(), 0);
}

TEST(ElasticPair, ComplianceIsTheSumOfTheBodies) {
  const ElasticPair pair{kLight, kSteel};
  const double compliance = (1 - 0.33 * 0.33) / 70e9 + (1 - 0.3 * 0.3) / 205.9e9;
  EXPECT_NEAR(pair.contact_modulus() * compliance, 1, 1e-14);
  const ElasticConstants alike = pair.alike();
  const double light = kLight.shear_modulus();
  const double steel = kSteel.shear_modulus();
  EXPECT_NEAR(alike.shear_modulus() * 0.5 * (1 / light + 1 / steel), 1, 1e-14);
  EXPECT_NEAR(alike.poissons_ratio / alike.shear_modulus() / (0.5 * (0.33 / light + 0.3 / steel)), 1, 1e-14);
  EXPECT_NEAR(contact_modulus(alike.youngs_modulus, alike.poissons_ratio) / pair.contact_modulus(), 1, 1e-14);
}

TEST(ElasticPair, BodiesMayChangePlaces) {
  const ElasticPair pair{kLight, kSteel};
  const ElasticPair swapped{kSteel, kLight};
  EXPECT_NEAR(pair.contact_modulus() / swapped.contact_modulus(), 1, 1e-14);
  EXPECT_NEAR(pair.alike().youngs_modulus / swapped.alike().youngs_modulus, 1, 1e-14);
  EXPECT_NEAR(pair.dundurs_constant(), -swapped.dundurs_constant(), 1e-15);
  EXPECT_GT(pair.dundurs_constant(), 0.1);
  // On a rigid rail: (1 - 2 nu) / (2 (1 - nu)).
  const ElasticPair rigid{kLight, {1e30, 0.3}};
  EXPECT_NEAR(rigid.dundurs_constant(), (1 - 0.66) / (2 * (1 - 0.33)), 1e-12);
}

Scene light_wheel(const std::vector<std::string>& more = {}) {
  std::vector<std::string> overrides = {
      "scene.element_size=8 mm", "wheel.material=light", "material.light.youngs_modulus=70 GPa",
      "material.light.poissons_ratio=0.33", "material.light.density=2700 kg/m3"};
  overrides.insert(overrides.end(), more.begin(), more.end());
  return samples::tyre_scene(overrides);
}

TEST(PartMaterials, EachBodyIsOfItsOwn) {
  const Model both_steel(samples::tyre_scene({"scene.element_size=8 mm"}));
  const Model model(light_wheel());
  const auto material = [&](int block) {
    return model.mesh.blocks[static_cast<std::size_t>(block)].materials.front();
  };
  EXPECT_EQ(material(model.index.tread).name, "light");
  EXPECT_EQ(material(model.index.tread).youngs_modulus, 70e9);
  EXPECT_EQ(material(model.index.rail_cap).name, "steel");
  EXPECT_NEAR(model.wheelset->mass() / both_steel.wheelset->mass(), 2700.0 / 7790, 1e-12);
  const ElasticPair pair{kLight, kSteel};
  const HertzPatch expected = hertz(0.43, model.hertz_radius_y, pair.contact_modulus(), model.wheel_load());
  EXPECT_DOUBLE_EQ(model.hertz_patch.semi_axis_x, expected.semi_axis_x);
  EXPECT_DOUBLE_EQ(model.hertz_patch.approach, expected.approach);
}

TEST(PartMaterials, PenaltyFollowsTheHarmonicMeanOfTheModuli) {
  const Model model(light_wheel({"scene.element_size=2.5 mm"}));
  EXPECT_NEAR(model.contact->options().penalty / (10 * 2 / (1 / 70e9 + 1 / 205.9e9) / 2.5e-3), 1, 1e-12);
}

TEST(PartMaterials, DampingBelongsToTheMaterial) {
  const std::string fraction = "damping={ kind = \"high_frequency_fraction\", value = 0.01 }";
  const Model wheel(light_wheel({"material.light." + fraction}));
  const Model rail(light_wheel({"material.steel." + fraction}));
  const auto beta = [](const Model& model, int block) { return model.beta[static_cast<std::size_t>(block)]; };
  EXPECT_GT(beta(wheel, wheel.index.tread), 0);
  EXPECT_EQ(beta(wheel, wheel.index.rail_cap), 0);
  EXPECT_EQ(beta(rail, rail.index.tread), 0);
  EXPECT_GT(beta(rail, rail.index.rail_cap), 0);
}

TEST(PartMaterials, RailBeamIsOfTheRailsMaterial) {
  Scene scene = light_wheel();
  const double of_steel = rail_beam_section(scene).shear_coefficient;
  scene.materials.at("light").poissons_ratio = 0.1;
  EXPECT_EQ(rail_beam_section(scene).shear_coefficient, of_steel);
  scene.materials.at("steel").poissons_ratio = 0.1;
  EXPECT_NE(rail_beam_section(scene).shear_coefficient, of_steel);
}

}  // namespace
}  // namespace tread
