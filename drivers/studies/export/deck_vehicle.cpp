#include "drivers/studies/export/deck_vehicle.hpp"

#include <numbers>

#include "drivers/studies/export/deck_units.hpp"

namespace tread {

namespace {

using Ring = std::vector<std::pair<std::int64_t, double>>;

/// Mean over the journal's nodes of `value(node)`.
template <class Value>
Vec3 mean_of(const Ring& ring, const Value& value) {
  Vec3 mean;
  for (const auto& [node, share] : ring) mean += share * value(node);
  return mean;
}

/// The axle box's place: on the axle, in the middle of the journal [m].
Vec3 axle_box(const DeckModel& deck, const Ring& ring) {
  const Vec3 middle = mean_of(ring, [&](std::int64_t node) { return deck.place(node); });
  // The spokes turn with the axle: about another place than its deflected middle they would swing the box.
  if (deck.preloaded()) return middle;
  return {deck.wheel().origin.x, middle.y, deck.wheel().origin.z};
}

/// Its velocity at t = 0 [m/s].
Vec3 box_velocity(const DeckModel& deck, const Ring& ring) {
  if (!deck.preloaded()) return deck.wheel().velocity;
  const Vec3 mean = mean_of(ring, [&](std::int64_t node) { return deck.velocity(node); });
  return {mean.x, 0, mean.z};
}

/// Stiffness by which two masses [kg] swing against each other at a frequency [Hz]. [N/m]
double stiffness_of(double one, double other, double frequency) {
  const double omega = 2 * std::numbers::pi * frequency;
  return omega * omega / (1 / one + 1 / other);
}

}  // namespace

std::vector<std::pair<std::int64_t, double>> journal_shares(const DeckModel& deck) {
  // The journal itself spreads a unit force.
  const Model& model = deck.model();
  AlignedVector<double> force(static_cast<std::size_t>(3 * model.mesh.slots), 0.0);
  model.journal.add(force.data(), deck.wheel(), {0, 0, 1});
  std::vector<std::pair<std::int64_t, double>> shares;
  for (const VtkGrid::Point& point : deck.grid().points) {
    const SweptBlock& block = model.mesh.blocks[static_cast<std::size_t>(point.block)];
    if (block.sweep == Sweep::extruded) continue;
    const std::int64_t slot = deck.slot(point);
    const double up = to_cartesian(block, point.station, 0, ConstNodeField(force.data()).at(slot)).z;
    if (up != 0) shares.emplace_back(deck.node(slot), up);
  }
  return shares;
}

void write_vehicle(DeckModel& deck, DiscreteParts& parts, KeywordDeck& out) {
  if (!deck.scene().vehicle || deck.model().journal.empty()) return;
  const VehicleSpec& vehicle = *deck.scene().vehicle;
  const auto ring = journal_shares(deck);
  const Vec3 box = axle_box(deck, ring);
  const std::int64_t unsprung = ++deck.numbers.node;
  const std::int64_t sprung = ++deck.numbers.node;
  deck.sprung = sprung;
  deck.unsprung = unsprung;
  deck.moving.emplace_back(unsprung, box_velocity(deck, ring));

  out.remark("Axle box with the unsprung mass, and the sprung mass.");
  out.keyword("*NODE");
  out.names(kNodeCard, {"nid", "x", "y", "z"});
  // Both at one place: see SpringEnds.
  for (const std::int64_t node : {unsprung, sprung}) {
    const Vec3 at = deck_unit::kLength * box;
    out.card(kNodeCard, {node, at.x, at.y, at.z});
  }
  out.keyword("*ELEMENT_MASS");
  out.names(kMassCard, {"eid", "nid", "mass"});
  for (const auto& [node, mass] :
       {std::pair(unsprung, vehicle.unsprung_mass), std::pair(sprung, vehicle.sprung_mass)})
    out.card(kMassCard, {++deck.numbers.element, node, mass});

  DeckSpring suspension;
  suspension.stiffness = vehicle.suspension_stiffness;
  suspension.damping = vehicle.suspension_damping;
  parts.add(sprung, unsprung, suspension);
  const double pulling = vehicle.unsprung_mass + deck.model().wheelset->mass();
  if (vehicle.longitudinal == "carried") {
    DeckSpring link;
    link.component = 0;
    link.stiffness = stiffness_of(vehicle.sprung_mass, pulling, kLinkFrequency);
    parts.add(sprung, unsprung, link);
    deck.moving.emplace_back(sprung, Vec3{deck.wheel().velocity.x, 0, deck.sprung_start().speed});
    deck.held[2].push_back(sprung);
  } else {
    deck.moving.emplace_back(sprung, Vec3{0, 0, deck.sprung_start().speed});
    deck.held[1 + 2].push_back(sprung);
  }
  // Spokes of equal stiffness k hold a ring of n nodes by n k / 2 in each direction of its plane.
  DeckSpring spoke;
  spoke.component = DeckSpring::kOwnDirection;
  spoke.stiffness = 2 / static_cast<double>(ring.size()) *
                    stiffness_of(vehicle.unsprung_mass, deck.model().wheelset->mass(), kSpokeFrequency);
  for (const auto& [node, share] : ring) parts.add(unsprung, node, spoke);
  deck.held[2].push_back(unsprung);
}

}  // namespace tread
