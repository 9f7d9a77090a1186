// Decks that start in the static state of a scene: places, stresses, velocities, forces. [deck_start.hpp]

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "drivers/engine/simulation.hpp"
#include "drivers/engine/start/step_limit.hpp"
#include "drivers/studies/export/deck_start.hpp"
#include "kernels/element/element.hpp"
#include "tests/exported_deck.hpp"

namespace tread {
namespace {

using samples::exported;
using samples::Exported;
using samples::half_wheelset;
using samples::ReadDeck;

Scene moving(Scene scene) {
  scene.motion->start = "moving";
  return scene;
}

/// A scene in its static state.
struct Preloaded {
  explicit Preloaded(const Scene& scene)
      : model(scene),
        preload(solve_preload(model, steady_motion(model), [](const std::string& /*text*/) {})),
        step(model.scene.motion->step_safety * step_limit(model).stable_step) {}

  DeckOptions options(DeckReader reader) const { return {reader, 0, 0, &preload}; }

  Model model;
  Preload preload;
  double step;  ///< [s]
};

const Preloaded& wheelset() {
  static const Preloaded preloaded(
      moving(half_wheelset("smooth", {"motion.traction.mu=0.3", "motion.traction.ramp=0 ms"})));
  return preloaded;
}

/// Directions of the coordinates of three nodes.
std::array<Vec3, 3> axes_of(const ReadDeck& deck, const std::array<std::int64_t, 3>& plane) {
  const auto unit = [](const Vec3& v) { return (1 / norm(v)) * v; };
  const Vec3 first = unit(deck.nodes.at(plane[1]) - deck.nodes.at(plane[0]));
  const Vec3 third = unit(cross(first, deck.nodes.at(plane[2]) - deck.nodes.at(plane[0])));
  return {first, cross(third, first), third};
}

/// Nodal forces of the stresses of a deck's elements, by the deck alone [kN].
std::map<std::int64_t, Vec3> forces_of_stresses(const ReadDeck& deck) {
  std::map<std::int64_t, Vec3> forces;
  for (const auto& [number, solid] : deck.solids) {
    HexNodes corners;
    for (std::size_t k = 0; k < 8; ++k) corners[k] = deck.nodes.at(solid.nodes[k]);
    const ElementGeometry geometry = element_geometry(corners);
    const std::array<double, 6>& s = deck.stresses.at(number);
    for (int node = 0; node < 8; ++node) {
      Vec3 g;
      for (std::size_t mode = 0; mode < kGradientModes; ++mode)
        g += mode_value(static_cast<Mode>(mode), node) * geometry.gradient[mode];
      forces[solid.nodes[static_cast<std::size_t>(node)]] +=
          geometry.volume * Vec3{s[0] * g.x + s[3] * g.y + s[5] * g.z, s[3] * g.x + s[1] * g.y + s[4] * g.z,
                                 s[5] * g.x + s[4] * g.y + s[2] * g.z};
    }
  }
  return forces;
}

/// Forces of the elements in the static state, by node of a deck, of blocks that are not held along and
/// across [kN].
std::map<std::int64_t, Vec3> element_forces(const DeckModel& deck) {
  const auto values = static_cast<std::size_t>(3 * deck.model().mesh.slots);
  AlignedVector<double> displacement(values), force(values, 0.0);
  for (std::size_t i = 0; i < values; ++i)
    displacement[i] = deck.displacement()[static_cast<std::int64_t>(i)];
  deck.model().internal->internal_force(displacement.data(), nullptr, force.data());
  std::map<std::int64_t, Vec3> forces;
  for (const VtkGrid::Point& point : deck.grid().points) {
    const SweptBlock& block = deck.model().mesh.blocks[static_cast<std::size_t>(point.block)];
    if (block.vertical_only) continue;
    const Vec3 own = ConstNodeField(force.data()).at(deck.slot(point));
    forces[deck.node(deck.slot(point))] = 1e-3 * to_cartesian(block, point.station, 0, own);
  }
  return forces;
}

double size_of(const std::map<std::int64_t, Vec3>& forces) {
  double squares = 0;
  for (const auto& [node, force] : forces) squares += dot(force, force);
  return std::sqrt(squares);
}

TEST(PreloadedDeck, StressesAndHourglassForcesAreThoseOfTheElements) {
  const Preloaded& at = wheelset();
  const DeckModel deck(at.model, at.options(DeckReader::ls_dyna), at.step);
  const ReadDeck read = exported(at.model, at.options(DeckReader::ls_dyna)).deck;
  const std::map<std::int64_t, Vec3> wanted = element_forces(deck);
  std::map<std::int64_t, Vec3> missing = wanted;
  for (const auto& [node, force] : forces_of_stresses(read))
    if (wanted.count(node) > 0) missing[node] -= force;
  const double without = size_of(missing) / size_of(wanted);
  for (const auto& [node, force] : hourglass_forces(deck, {0, read.solids.size()}))
    if (wanted.count(node) > 0) missing[node] += 1e-3 * force;
  EXPECT_GT(without, 0.05);  // there is something to mend
  EXPECT_LT(size_of(missing) / size_of(wanted), 1e-2);
}

TEST(PreloadedDeck, LoadsHoldTheHourglassForces) {
  const Preloaded& at = wheelset();
  const DeckModel deck(at.model, at.options(DeckReader::ls_dyna), at.step);
  const ReadDeck read = exported(at.model, at.options(DeckReader::ls_dyna)).deck;
  std::map<std::int64_t, Vec3> loads;
  for (const ReadDeck::Load& load : read.loads) {
    std::array<Vec3, 3> axes = {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
    if (load.turns) axes = axes_of(read, load.plane);
    loads[load.node] += load.value * axes[static_cast<std::size_t>(load.axis)];
  }
  Vec3 sum;
  std::size_t journal = 0;
  for (const auto& [node, force] : hourglass_forces(deck)) {
    sum += force;
    // Nodes of the journal bear its load as well.
    if (norm(loads.at(node) - 1e-3 * force) > 1e-4) ++journal;
  }
  EXPECT_LT(norm(sum), 1e-6 * at.model.wheel_load());
  EXPECT_LT(journal, 200U);
}

TEST(PreloadedDeck, NodesMoveAsInTheFirstStep) {
  const Preloaded& at = wheelset();
  const DeckModel deck(at.model, at.options(DeckReader::ls_dyna), at.step);
  const ReadDeck read = exported(at.model, at.options(DeckReader::ls_dyna)).deck;
  Simulation simulation(at.model, at.preload, at.step);
  simulation.step();
  const BodyFrame& wheel = simulation.wheel();
  const double c = std::cos(wheel.angle);
  const double s = std::sin(wheel.angle);
  double largest = 0;
  for (const VtkGrid::Point& point : deck.grid().points) {
    const SweptBlock& block = at.model.mesh.blocks[static_cast<std::size_t>(point.block)];
    Vec3 place = position(block, point.node, point.station) +
                 to_cartesian(block, point.station, 0, simulation.displacement().at(deck.slot(point)));
    if (block.sweep == Sweep::revolved)
      place = wheel.origin + Vec3{c * place.x + s * place.z, place.y, c * place.z - s * place.x};
    const std::int64_t node = deck.node(deck.slot(point));
    const Vec3 moved = (1 / at.step) * (place - 1e-3 * read.nodes.at(node));
    largest = std::max(largest, norm(moved - read.velocities.at(node)));
  }
  EXPECT_LT(largest, 1e-2 * at.model.scene.motion->speed);
}

TEST(PreloadedDeck, TheSpringsBearTheRail) {
  const Preloaded& at = wheelset();
  const ReadDeck read = exported(at.model, at.options(DeckReader::ls_dyna)).deck;
  const DeckModel deck(at.model, at.options(DeckReader::ls_dyna), at.step);
  const auto bodies = static_cast<std::int64_t>(deck.grid().points.size());
  double up = 0;
  for (const ReadDeck::Load& load : read.loads)
    if (load.node > bodies && load.axis == 2 && load.value > 0 && load.value < 40) up += load.value;
  // Wheel load and the rail's own weight, but for the dampers' share of a moving load.
  EXPECT_GT(up, 0.7e-3 * at.model.wheel_load());
}

TEST(PreloadedDeck, TheAxleBoxSitsInTheDeflectedJournal) {
  // Spokes turn with the wheel: about another place they would swing the box.
  const Preloaded& at = wheelset();
  const DeckModel deck(at.model, at.options(DeckReader::ls_dyna), at.step);
  const ReadDeck read = exported(at.model, at.options(DeckReader::ls_dyna)).deck;
  Vec3 sum;
  int spokes = 0;
  double deflection = 0;  // of the journal against the wheel's axis
  for (const auto& [number, card] : read.discretes) {
    if (samples::whole(card[4]) > 0) continue;
    const Vec3 box = read.nodes.at(samples::whole(card[2]));
    sum += read.nodes.at(samples::whole(card[3])) - box;
    deflection = std::abs(box.z - 1e3 * deck.wheel().origin.z);
    ++spokes;
  }
  ASSERT_GT(spokes, 0);
  EXPECT_LT(std::hypot(sum.x, sum.z) / spokes, 0.05 * deflection);
}

TEST(PreloadedDeck, OverlapLowersTheWheelset) {
  const Preloaded& at = wheelset();
  DeckOptions options = at.options(DeckReader::openradioss);
  const DeckModel as_here(at.model, options, at.step);
  options.overlap = 20e-6;
  const DeckModel lower(at.model, options, at.step);
  for (const VtkGrid::Point& point : as_here.grid().points) {
    const SweptBlock& block = at.model.mesh.blocks[static_cast<std::size_t>(point.block)];
    const double lowered = block.sweep == Sweep::revolved ? 20e-6 : 0;
    ASSERT_NEAR((as_here.place(point) - lower.place(point)).z, lowered, 1e-12);
    ASSERT_NEAR(norm(as_here.velocity(point) - lower.velocity(point)), 0, 1e-9);
  }
}

/// Parts of springs and dampers.
std::size_t springs_of(const ReadDeck& deck) {
  std::set<std::int64_t> parts;
  for (const auto& [number, card] : deck.discretes) parts.insert(samples::whole(card[1]));
  return parts.size();
}

/// Lines of a Radioss file behind a keyword, without comments.
std::vector<std::string> cards_behind(const std::string& text, const std::string& keyword) {
  std::vector<std::string> cards;
  std::istringstream lines(text);
  bool inside = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with('/')) inside = line.starts_with(keyword);
    if (inside && !line.starts_with('#') && !line.starts_with('/')) cards.push_back(line);
  }
  return cards;
}

TEST(PreloadedDeck, OpenRadiossGetsWhatNoKeywordHolds) {
  const Preloaded& at = wheelset();
  const Exported deck = exported(at.model, at.options(DeckReader::openradioss));
  EXPECT_TRUE(deck.deck.contacts.empty());
  EXPECT_TRUE(deck.deck.stresses.empty());
  EXPECT_TRUE(deck.deck.velocities.empty());
  const RadiossCards& cards = deck.summary.radioss;
  const auto [keywords, summary] = exported(at.model, at.options(DeckReader::ls_dyna));
  EXPECT_EQ(std::ranges::count(summary.differences,
                               "Contact at t = 0: without force. LS-DYNA moves overlapping nodes to the "
                               "surface; F_N builds up while the deck runs."),
            1);
  EXPECT_EQ(keywords.accuracy.at(0), "1");  // OSU
  EXPECT_TRUE(deck.deck.accuracy.empty());
  EXPECT_EQ(cards.ties.size() + cards.contacts.size(), keywords.contacts.size());
  for (const RadiossTie& tie : cards.ties) {
    EXPECT_EQ(deck.deck.node_sets.count(tie.nodes), 1U);
    EXPECT_EQ(deck.deck.segment_sets.count(tie.faces), 1U);
    EXPECT_GT(tie.reach, 0);
  }
  ASSERT_EQ(cards.contacts.size(), 1U);
  EXPECT_EQ(deck.deck.segment_sets.count(cards.contacts[0].secondary), 1U);
  EXPECT_EQ(deck.deck.segment_sets.count(cards.contacts[0].primary), 1U);
  EXPECT_EQ(cards.contacts[0].friction, at.model.scene.contact->friction);
  EXPECT_EQ(cards.velocities.size(), keywords.velocities.size());
  EXPECT_EQ(cards.references.size(), deck.deck.parts.size() - springs_of(deck.deck));
  for (const RadiossReference& reference : cards.references) {
    EXPECT_EQ(deck.deck.parts.count(reference.part), 1U);
    for (const auto& [node, place] : reference.nodes)
      ASSERT_LT(norm(place - deck.deck.nodes.at(node)), 3) << node;  // mm: no displacement is larger
  }
}

TEST(PreloadedDeck, RadiossFileHasFieldsOfTenAndTwenty) {
  std::string text;
  RadiossFile file([&](std::string_view piece) { text += piece; });
  file.begin("name", "name.k");
  file.tie({"tie of a", 3, 4, 0.1});
  file.contact({"wheel on rail", 11, 12, 0.25, 0.15, 0.01});
  file.reference({7, {{1, {0.5, -2, 1e3}}}});
  const std::vector<std::pair<std::int64_t, Vec3>> velocities = {{1, {83.25, 0, -0.5}}, {2, {0, 1, 2}}};
  file.velocities(velocities);
  file.end();
  EXPECT_EQ(cards_behind(text, "/INCLUDE_LS-DYNA"), std::vector<std::string>{"name.k"});
  const auto tie = cards_behind(text, "/INTER/TYPE2/");
  ASSERT_EQ(tie.size(), 2U);
  EXPECT_EQ(tie[1].size(), 100U);
  EXPECT_EQ(std::stoi(tie[1].substr(30, 10)), 5);
  EXPECT_EQ(std::stod(tie[1].substr(80)), 0.1);
  const auto contact = cards_behind(text, "/INTER/TYPE25/");
  ASSERT_EQ(contact.size(), 9U);
  EXPECT_EQ(std::stod(contact[4].substr(20, 20)), 0.25);
  EXPECT_EQ(std::stoi(contact[5].substr(30, 10)), -1);
  EXPECT_EQ(std::stoi(contact[6].substr(0, 10)), 2);
  EXPECT_EQ(std::stod(contact[7].substr(80)), 0.15);
  EXPECT_EQ(std::stod(contact[8]), -0.01);
  const auto reference = cards_behind(text, "/XREF/7");
  ASSERT_EQ(reference.size(), 3U);
  EXPECT_EQ(std::stod(reference[2].substr(30, 20)), -2);
  const auto moved = cards_behind(text, "/INIVEL/NODE");
  ASSERT_EQ(moved.size(), 5U);
  EXPECT_EQ(std::stod(moved[1].substr(20, 20)), 83.25);
  EXPECT_EQ(moved[2].size(), 80U);
}

}  // namespace
}  // namespace tread
