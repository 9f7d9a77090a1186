// Spring-dampers of a keyword deck: fastenings, bed, suspension, spokes, and the ties of their ends.
// [drivers/studies/export]

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include "drivers/studies/export/deck_surfaces.hpp"
#include "tests/exported_deck.hpp"

namespace tread {
namespace {

using samples::exported;
using samples::half_wheelset;
using samples::kCorrugated;
using samples::normal_of;
using samples::ReadDeck;
using samples::real;
using samples::sum_of;
using samples::whole;

/// Expects springs in their own direction from one node to others around it, whose sum in the plane of the
/// wheel swings the unsprung mass at 3 kHz.
void expect_spokes_hold_the_axle_box(const ReadDeck& deck, const Model& model) {
  double along = 0;
  double up = 0;
  std::set<std::int64_t> middle;
  for (const auto& [number, card] : deck.discretes) {
    if (whole(card[4]) > 0) continue;
    middle.insert(whole(card[2]));
    const Vec3 spoke = deck.nodes.at(whole(card[3])) - deck.nodes.at(whole(card[2]));
    const double stiffness = 1e6 * real(deck.materials.at(whole(deck.parts.at(whole(card[1]))[2]))[1]);
    along += stiffness * spoke.x * spoke.x / dot(spoke, spoke);
    up += stiffness * spoke.z * spoke.z / dot(spoke, spoke);
  }
  EXPECT_EQ(middle.size(), 1U);
  const double mass = 1 / (1 / model.scene.vehicle->unsprung_mass + 1 / model.wheelset->mass());
  for (const double stiffness : {along, up})
    EXPECT_NEAR(std::sqrt(stiffness / mass) / (2 * std::acos(-1.0)), 3000, 600);
}

TEST(KeywordDeckSprings, HoldFasteningsAndSuspension) {
  const Model model(half_wheelset("corrugation-d", kCorrugated));
  const auto [deck, summary] = exported(model);
  const FasteningSpec& fastening = *model.scene.fastenings;
  const VehicleSpec& vehicle = *model.scene.vehicle;
  const Vec3 up = {0, 0, 1};
  EXPECT_NEAR(sum_of(deck, "SPRING", up),
              1e-6 * (fastening.count * fastening.stiffness + vehicle.suspension_stiffness), 1e-5);
  EXPECT_NEAR(sum_of(deck, "DAMPER", up),
              1e-3 * (fastening.count * fastening.damping + vehicle.suspension_damping), 1e-3);
  EXPECT_EQ(static_cast<std::int64_t>(deck.discretes.size()), summary.discrete_elements);

  expect_spokes_hold_the_axle_box(deck, model);
}

/// OpenRadioss uses the masses of the nodes for elements without a length alone.
TEST(KeywordDeckSprings, HaveNoLengthAndStableEnds) {
  const Model model(half_wheelset("corrugation-d", kCorrugated));
  const auto [deck, summary] = exported(model);
  std::map<std::int64_t, double> masses, dampings;
  for (const auto& [number, card] : deck.masses) masses[whole(card[1])] += real(card[2]);
  for (const auto& [number, card] : deck.discretes) {
    if (whole(card[4]) == 0) continue;
    const std::int64_t first = whole(card[2]);
    const std::int64_t second = whole(card[3]);
    EXPECT_EQ(norm(deck.nodes.at(first) - deck.nodes.at(second)), 0);
    const ReadDeck::Card& law = deck.materials.at(whole(deck.parts.at(whole(card[1]))[2]));
    if (law[0].find("DAMPER") == std::string::npos) continue;
    for (const std::int64_t end : {first, second}) dampings[end] += 1e3 * real(law[1]);
  }
  EXPECT_FALSE(dampings.empty());
  const double scaled_below = real(deck.time_step[4]);  // [ms]; not zero: the step of the nodes
  EXPECT_LT(scaled_below, 0);
  EXPECT_GT(scaled_below, -1e-3 * 1e3 * summary.step);
  for (const auto& [node, damping] : dampings) EXPECT_GT(masses[node] / damping, summary.step);
}

/// Returns true if a place is up to `distance` [mm] from a face, as far as its plane and its size tell.
bool lies_on(const ReadDeck& deck, const Vec3& at, const DeckFace& face, double distance) {
  const Vec3 normal = normal_of(deck, face);
  const Vec3 middle = 0.25 * (deck.nodes.at(face[0]) + deck.nodes.at(face[1]) + deck.nodes.at(face[2]) +
                              deck.nodes.at(face[3]));
  double reach = 0;
  for (const std::int64_t node : face) reach = std::max(reach, norm(deck.nodes.at(node) - middle));
  return std::abs(dot(at - middle, normal)) < distance * norm(normal) &&
         norm(at - middle) < 1.01 * reach + distance;
}

TEST(KeywordDeckSprings, TiedNodesLieOnTheirFaces) {
  const auto [deck, summary] = exported(Model(half_wheelset("ballasted", {"probe.head.x=0.5 m"})));
  for (const ReadDeck::Contact& contact : deck.contacts) {
    if (contact.secondary_kind != 4) continue;
    for (const std::int64_t node : deck.node_sets.at(contact.secondary)) {
      const std::vector<DeckFace>& faces = deck.segment_sets.at(contact.primary);
      EXPECT_TRUE(std::any_of(
          faces.begin(), faces.end(),
          [&](const DeckFace& face) { return lies_on(deck, deck.nodes.at(node), face, contact.reach); }))
          << node << " of set " << contact.secondary;
    }
  }
}

TEST(KeywordDeckSprings, HoldsSleepersOnTheirBed) {
  const Model model(half_wheelset("ballasted", {"probe.head.x=0.5 m"}));
  const auto [deck, summary] = exported(model);
  const FasteningSpec& fastening = *model.scene.fastenings;
  const SleeperSpec& sleepers = *model.scene.sleepers;
  EXPECT_NEAR(sum_of(deck, "SPRING", {0, 0, 1}),
              1e-6 * (fastening.count * (fastening.stiffness + sleepers.stiffness) +
                      model.scene.vehicle->suspension_stiffness),
              1e-4);
}

}  // namespace
}  // namespace tread
