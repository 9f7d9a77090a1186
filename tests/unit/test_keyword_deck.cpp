// Keyword decks: every card is read back and set beside the model. [drivers/studies/export]

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "drivers/engine/start/traction.hpp"
#include "drivers/report/mesh_measures.hpp"
#include "drivers/studies/export/deck_surfaces.hpp"
#include "kernels/element/element.hpp"
#include "tests/exported_deck.hpp"
#include "tests/refusal.hpp"

namespace tread {
namespace {

using samples::bar;
using samples::exported;
using samples::half_wheelset;
using samples::kCorrugated;
using samples::normal_of;
using samples::ReadDeck;
using samples::real;
using samples::rigid_start;
using samples::tyre;
using samples::whole;

/// Mass of each block's elements, by the deck alone. Expects that all have positive Jacobians. [kg]
std::vector<double> masses_by_block(const ReadDeck& deck, const Model& model) {
  std::vector<double> masses;
  auto solid = deck.solids.begin();
  for (const SweptBlock& block : model.mesh.blocks) {
    masses.push_back(0);
    for (std::int64_t i = 0; i < block.elements(); ++i, ++solid) {
      HexNodes corners;
      for (std::size_t k = 0; k < 8; ++k) corners[k] = deck.nodes.at(solid->second.nodes[k]);
      const ElementGeometry geometry = element_geometry(corners);
      EXPECT_GT(geometry.smallest_jacobian, 0);
      const std::int64_t material = whole(deck.parts.at(solid->second.part)[2]);
      masses.back() += geometry.volume * real(deck.materials.at(material)[1]);
    }
  }
  EXPECT_EQ(solid, deck.solids.end());
  return masses;
}

void expect_same_bodies(const ReadDeck& deck, const Model& model) {
  EXPECT_EQ(static_cast<std::int64_t>(deck.solids.size()), model.elements());
  const std::vector<double> masses = masses_by_block(deck, model);
  const std::vector<BlockMeasures> blocks = measure_blocks(model);
  ASSERT_EQ(masses.size(), blocks.size());
  for (std::size_t b = 0; b < blocks.size(); ++b)
    EXPECT_NEAR(masses[b] / blocks[b].mass, 1, 1e-6) << blocks[b].name;
}

/// Momentum of the elements with an eighth of their mass at each corner, and of the added masses [kg m/s].
Vec3 momentum(const ReadDeck& deck) {
  Vec3 sum;
  const auto add = [&](std::int64_t node, double mass) {
    const auto velocity = deck.velocities.find(node);
    if (velocity != deck.velocities.end()) sum += mass * velocity->second;
  };
  for (const auto& [number, solid] : deck.solids) {
    HexNodes corners;
    for (std::size_t k = 0; k < 8; ++k) corners[k] = deck.nodes.at(solid.nodes[k]);
    const ElementGeometry geometry = element_geometry(corners);
    const double density = real(deck.materials.at(whole(deck.parts.at(solid.part)[2]))[1]);
    for (std::size_t k = 0; k < 8; ++k) add(solid.nodes[k], density * geometry.nodal_volume[k]);
  }
  for (const auto& [number, card] : deck.masses) add(whole(card[1]), real(card[2]));
  return sum;
}

/// Momentum of the model's wheel that rolls rigidly, with the elements' masses, which are not balanced
/// [kg m/s].
Vec3 momentum_of_wheel(const Model& model) {
  BodyFrame frame;
  frame.velocity = {model.scene.motion->speed, 0, 0};
  frame.spin = model.scene.motion->speed / model.wheel_radius();
  const AlignedVector<double> rest(static_cast<std::size_t>(3 * model.mesh.slots), 0.0);
  AlignedVector<double> mass(static_cast<std::size_t>(model.mesh.slots), 0.0);
  model.add_lumped_mass(mass.data());
  if (model.ties) model.ties->gather_mass(mass.data());
  return SpinningBody(model.mesh, model.index.wheel(), mass.data()).momentum(rest.data(), rest.data(), frame);
}

void expect_near(const Vec3& a, const Vec3& b) {
  EXPECT_LT(norm(a - b) / norm(b), 1e-6)
      << a.x << " " << a.y << " " << a.z << " and " << b.x << " " << b.y << " " << b.z;
}

/// Height of the wheel's axis [mm], by its running surface.
double axis_height(const ReadDeck& deck, const std::vector<DeckFace>& tread) {
  double low = 1e9;
  double high = -1e9;
  for (const DeckFace& face : tread)
    for (const std::int64_t node : face) {
      low = std::min(low, deck.nodes.at(node).z);
      high = std::max(high, deck.nodes.at(node).z);
    }
  return 0.5 * (low + high);
}

/// Torque of the forces that turn with the wheel, about +y through the axis at (0, height) [kN mm].
double torque_of(const ReadDeck& deck, double height) {
  double sum = 0;
  for (const ReadDeck::Load& load : deck.loads) {
    if (!load.turns) continue;
    const auto at = [&](std::size_t i) { return deck.nodes.at(load.plane[i]); };
    Vec3 normal = cross(at(1) - at(0), at(2) - at(0));
    normal = (1 / norm(normal)) * normal;
    const Vec3 arm = deck.nodes.at(load.node) - Vec3{0, 0, height};
    sum += load.value * cross(arm, normal).y;
  }
  return sum;
}

double vertical_load(const ReadDeck& deck, const std::function<bool(double)>& counts) {
  double sum = 0;
  for (const ReadDeck::Load& load : deck.loads)
    if (!load.turns && counts(load.value)) sum += load.value;
  return sum;
}

TEST(KeywordDeck, TitlesAreLinesOfTheirOwn) {
  std::string text;
  KeywordDeck deck([&](std::string_view piece) { text += piece; });
  const std::string longest(69, 'x');
  for (const std::string& title : {std::string("*a\nb"), std::string("$c"), longest + "\xC3\xA9z"})
    deck.title(title);
  deck.finish();
  EXPECT_EQ(text, " *a b\n $c\n" + longest + "\n");
}

TEST(KeywordDeck, HoldsTheBarAndItsPulse) {
  const Model model(bar());
  const auto [deck, summary] = exported(model);
  EXPECT_EQ(static_cast<std::int64_t>(deck.nodes.size()), model.nodes());
  expect_same_bodies(deck, model);
  EXPECT_NEAR(deck.end, 0.1, 1e-12);
  // A tenth of the bar but half of its last element moves at 1 m/s.
  const double mass = 7790 * 0.02 * 0.02 * 1;
  EXPECT_NEAR(momentum(deck).x, mass * (0.1 - 0.5 * 0.01), 1e-6 * mass);
  EXPECT_TRUE(deck.held.empty());
  EXPECT_TRUE(deck.contacts.empty());
  EXPECT_EQ(deck.gravity, 0);
}

TEST(KeywordDeck, HoldsATyreThatRollsOnABlock) {
  const Model model(tyre({"motion.traction.torque=13.8 kN m", "motion.traction.ramp=0.1 ms"}));
  const auto [deck, summary] = exported(model);
  expect_same_bodies(deck, model);
  expect_near(momentum(deck), momentum_of_wheel(model));
  EXPECT_NEAR(deck.gravity, 9.81e-3, 1e-9);
  EXPECT_NEAR(vertical_load(deck, [](double) { return true; }), -87.564, 1e-4);

  ASSERT_EQ(deck.contacts.size(), 1U);
  const ReadDeck::Contact& contact = deck.contacts[0];
  EXPECT_EQ(contact.keyword, "*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE_ID");
  EXPECT_EQ(contact.friction, 0.5);
  EXPECT_EQ(contact.slow_friction, 0.5);
  EXPECT_EQ(contact.decay, 0);
  const std::vector<DeckFace>& tread = deck.segment_sets.at(contact.secondary);
  const double height = axis_height(deck, tread);
  EXPECT_NEAR(height, 430, 1);
  double lowest = 1e9;
  for (const DeckFace& face : tread) {
    const Vec3 arm = deck.nodes.at(face[0]) - Vec3{0, 0, height};
    const Vec3 radial = {arm.x, 0, arm.z};
    EXPECT_GT(dot(normal_of(deck, face), radial), 0);
    lowest = std::min(lowest, norm(deck.velocities.at(face[0])));
  }
  EXPECT_LT(lowest, 2);  // of 83 mm/ms: the lowest node rolls, the ring is wider than its circle
  for (const DeckFace& face : deck.segment_sets.at(contact.primary)) EXPECT_GT(normal_of(deck, face).z, 0);

  EXPECT_NEAR(torque_of(deck, height) / full_torque(model), 1, 1e-5);
}

TEST(KeywordDeck, HoldsAWheelsetOnFasteningsAndSlab) {
  const Model model(half_wheelset("corrugation-d", kCorrugated));
  const auto [deck, summary] = exported(model);
  expect_same_bodies(deck, model);
  const VehicleSpec& vehicle = *model.scene.vehicle;
  const double carried = vehicle.unsprung_mass + vehicle.sprung_mass;
  expect_near(momentum(deck), momentum_of_wheel(model) + Vec3{carried * model.scene.motion->speed, 0, 0});
  // The weight of the sprung mass presses on the journal, and its spring carries it.
  const double weight = 1e-3 * vehicle.sprung_mass * model.scene.gravity;
  EXPECT_NEAR(vertical_load(deck, [](double value) { return value < 0; }) / weight, -1, 1e-5);
  EXPECT_NEAR(vertical_load(deck, [](double value) { return value > 0; }) / weight, 1, 1e-6);

  ASSERT_FALSE(deck.contacts.empty());
  const std::vector<DeckFace>& tread = deck.segment_sets.at(deck.contacts.back().secondary);
  EXPECT_NEAR(torque_of(deck, axis_height(deck, tread)) / full_torque(model), 1, 1e-4);
  for (const auto& [part, coefficient] : deck.damping) EXPECT_LT(coefficient, 0);
  EXPECT_FALSE(deck.damping.empty());

  const auto nodes_on = [&](int part, const char* path) {
    const SweptBlock& block = model.mesh.blocks[static_cast<std::size_t>(part)];
    return block.stations.size() * block.section.paths.at(path).size();
  };
  ASSERT_EQ(deck.titled_sets.size(), 4U);
  EXPECT_EQ(deck.titled_sets.at("disc on tread").size(), nodes_on(model.index.disc, "tie_outer"));
  EXPECT_EQ(deck.titled_sets.at("disc on axle").size(), nodes_on(model.index.disc, "tie_inner"));
  EXPECT_EQ(deck.titled_sets.at("rail under head").size(), nodes_on(model.index.rail_base, "tie"));
  EXPECT_EQ(deck.titled_sets.at("rail on fastenings").size(), nodes_on(model.index.rail_base, "foot"));
}

TEST(KeywordDeck, HoldsSleepers) {
  const Model model(half_wheelset("ballasted", {"probe.head.x=0.5 m"}));
  expect_same_bodies(exported(model).deck, model);
}

TEST(KeywordDeck, HoldsMovedNodesOfACorrugation) {
  const Scene scene = half_wheelset("corrugation-d", kCorrugated);
  const Model smooth(scene);
  const Model corrugated(scene, 0.0);
  const ReadDeck a = exported(smooth).deck;
  const ReadDeck b = exported(corrugated).deck;
  double deepest = 0;
  for (const auto& [node, at] : b.nodes) deepest = std::max(deepest, a.nodes.at(node).z - at.z);
  EXPECT_NEAR(deepest, 0.14, 0.03);  // [mm]
}

TEST(KeywordDeck, HoldsRestraintsOfTheModel) {
  const Model model(tyre());
  const ReadDeck deck = exported(model).deck;
  std::size_t directions = 0;
  for (const ReadDeck::Card& card : deck.held)
    for (const std::size_t field : {2U, 3U, 4U})
      if (card[field] == "1") directions += deck.node_sets.at(whole(card[0])).size();
  EXPECT_EQ(directions, model.restrained.size());
}

TEST(KeywordDeck, WatchesTheStruckNodes) {
  const std::vector<std::string> blow = {"hammer.force=1 kN", "hammer.duration=0.2 ms"};
  const Scene scene = rigid_start(resolve_scene(SceneSource{"bar.toml", samples::kBar, {}}, blow).scene);
  const ReadDeck deck = exported(Model(scene)).deck;
  std::set<std::int64_t> struck;
  double force = 0;
  for (const ReadDeck::Load& load : deck.loads) {
    struck.insert(load.node);
    force += load.value * 1000;  // of the curve's largest value [kN]
  }
  EXPECT_FALSE(struck.empty());
  EXPECT_EQ(deck.watched, struck);
  EXPECT_NEAR(force, -1, 1e-6);
}

TEST(KeywordDeck, StatesTheHourglassStiffnessForTheReaderThatNeedsIt) {
  const Model model(bar());
  EXPECT_TRUE(exported(model).deck.hourglass.empty());
  const ReadDeck deck = exported(model, {DeckReader::ls_dyna, 0}).deck;
  EXPECT_TRUE(deck.accuracy.empty());
  ASSERT_EQ(deck.hourglass.size(), 1U);
  EXPECT_EQ(deck.hourglass.at(1)[1], "6");
  for (const std::size_t coefficient : {4U, 5U}) {  // of bulk viscosity: 0 would select the reader's own
    EXPECT_GT(real(deck.hourglass.at(1)[coefficient]), 0);
    EXPECT_LT(real(deck.hourglass.at(1)[coefficient]), 1e-6);
  }
  for (const auto& [number, part] : deck.parts) EXPECT_EQ(part[4], "1");
}

TEST(KeywordDeck, RampsStaticLoads) {
  const ReadDeck deck = exported(Model(tyre()), {DeckReader::openradioss, 0.5e-3}).deck;
  const std::int64_t curve = deck.loads.at(0).curve;
  EXPECT_EQ(deck.curves.at(curve).at(0)[1], 0);
  EXPECT_NEAR(deck.curves.at(curve).at(1)[0], 0.5, 1e-12);
  EXPECT_EQ(deck.curves.at(curve).at(1)[1], 1);
}

TEST(KeywordDeck, StatesFallingFrictionAndPlasticity) {
  const Model model(
      tyre({"contact.friction_law=falling", "contact.friction_fast=0.2", "contact.friction_speed=2 m/s",
            "contact.friction_memory=1 mm", "material.steel.law=j2", "material.steel.yield_stress=500 MPa",
            "material.steel.isotropic_hardening=1 GPa", "material.steel.kinematic_hardening=3 GPa"}));
  const ReadDeck deck = exported(model).deck;
  EXPECT_EQ(deck.contacts.at(0).slow_friction, 0.5);
  EXPECT_EQ(deck.contacts.at(0).friction, 0.2);
  EXPECT_EQ(deck.contacts.at(0).decay, 0.5);
  const ReadDeck::Card& steel = deck.materials.at(1);
  EXPECT_NE(steel[0].find("*MAT_PLASTIC_KINEMATIC"), std::string::npos);
  const double tangent = real(steel[5]);
  const double e = real(steel[2]);
  EXPECT_NEAR(e * tangent / (e - tangent), 4, 1e-4);  // both hardenings [GPa]
  EXPECT_NEAR(real(steel[6]), 0.25, 1e-6);
}

TEST(KeywordDeck, RefusesWhatItWouldFalsify) {
  const auto message_of = [](const Model& model) {
    return samples::refusal<InputError>([&] { exported(model); });
  };
  const auto message = [&](const Scene& scene) { return message_of(Model(scene)); };
  EXPECT_NE(message(tyre({"wheel.bore=guided"})).find("wheel.bore"), std::string::npos);
  std::vector<std::string> in_the_gap = kCorrugated;
  in_the_gap.push_back("corrugation.apply=gap");
  EXPECT_NE(message(half_wheelset("corrugation-d", in_the_gap)).find("corrugation.apply"), std::string::npos);
  Scene still = bar();
  still.motion.reset();
  EXPECT_NE(message(still).find("motion.duration"), std::string::npos);
  // Laws that only this program has.
  Model creeping(tyre());
  const auto overlapping = [](const Model& model, DeckReader reader) {
    return samples::refusal<InputError>([&] { exported(model, {reader, 0, 20e-6}); });
  };
  EXPECT_NE(overlapping(Model(bar()), DeckReader::openradioss).find("no wheel on a rail"), std::string::npos);
  EXPECT_NE(overlapping(creeping, DeckReader::ls_dyna).find("state --for openradioss"), std::string::npos);
  creeping.mesh.blocks.front().materials.front().law = "creep";
  EXPECT_NE(message_of(creeping).find("material.steel.law = \"creep\": no card is written"),
            std::string::npos);
  Model patchy(tyre());
  patchy.scene.contact->friction_law = "patchy";
  EXPECT_NE(message_of(patchy).find("contact.friction_law = \"patchy\""), std::string::npos);
}

TEST(KeywordDeck, ListsEveryDifference) {
  const auto [deck, summary] = exported(Model(tyre({"probe.head.x=50 mm"})));
  const auto named = [&, &differences = summary.differences](const std::string& text) {
    return std::any_of(differences.begin(), differences.end(),
                       [&](const std::string& sentence) { return sentence.find(text) != std::string::npos; });
  };
  for (const char* text : {"Element:", "Contact surfaces:", "Contact stiffness:", "Preload: none", "[probe]"})
    EXPECT_TRUE(named(text)) << text;
  EXPECT_FALSE(named("Damping"));
}

TEST(KeywordDeckCards, KeepFieldsApart) {
  std::string text;
  KeywordDeck deck([&](std::string_view piece) { text += piece; });
  deck.card({-123456789.0123456, 1e-300, "mm", DeckField(), 1.0 / 3});
  deck.remark(std::string(100, 'a') + " " + std::string(30, 'b'));
  deck.finish();
  EXPECT_EQ(text.substr(0, 51), " -1.23e+08    1e-300mm                   0.3333333\n");
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80U);
  EXPECT_THROW(deck.card({std::int64_t{12345678901}}), InputError);
}

}  // namespace
}  // namespace tread
