#include "drivers/studies/export/deck_vehicle.hpp"

#include <numbers>

#include "drivers/studies/export/deck_units.hpp"

namespace tread {

namespace {

/// The axle box's place: on the axle, over the middle of the journal [m].
Vec3 axle_box(const DeckModel& deck, const std::vector<std::pair<std::int64_t, double>>& ring) {
  double across = 0;
  for (const auto& [node, share] : ring) across += share * deck.place(node).y;
  return {deck.wheel().origin.x, across, deck.wheel().origin.z};
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
  constexpr double kAbove = 0.5;  // of the sprung mass over the axle box, for the eye alone [m]
  const Vec3 box = axle_box(deck, ring);
  const std::int64_t unsprung = ++deck.numbers.node;
  const std::int64_t sprung = ++deck.numbers.node;
  deck.sprung = sprung;
  deck.moving.emplace_back(unsprung, deck.wheel().velocity);

  out.remark("Axle box with the unsprung mass, and the sprung mass.");
  out.keyword("*NODE");
  out.names(kNodeCard, {"nid", "x", "y", "z"});
  for (const auto& [node, above] : {std::pair(unsprung, 0.0), std::pair(sprung, kAbove)}) {
    const Vec3 at = deck_unit::kLength * (box + Vec3{0, 0, above});
    out.card(kNodeCard, {node, at.x, at.y, at.z});
  }
  out.keyword("*ELEMENT_MASS");
  out.names(kMassCard, {"eid", "nid", "mass"});
  for (const auto& [node, mass] :
       {std::pair(unsprung, vehicle.unsprung_mass), std::pair(sprung, vehicle.sprung_mass)})
    if (mass > 0) out.card(kMassCard, {++deck.numbers.element, node, mass});

  out.remark("The axle box moves as the journal's nodes do in the mean, and does not turn.");
  out.keyword("*CONSTRAINED_INTERPOLATION");
  out.names({"icid", "dnid", "ddof", "cidd", "ityp"});
  out.card({1, unsprung, 123, 0, 0});
  out.names({"inid", "idof", "twghtx"});
  for (const auto& [node, share] : ring) out.card({node, 123, 1});

  DeckSpring suspension;
  suspension.stiffness = vehicle.suspension_stiffness;
  suspension.damping = vehicle.suspension_damping;
  parts.add(sprung, unsprung, suspension);
  if (vehicle.longitudinal == "carried") {
    const double pulling = vehicle.unsprung_mass + deck.model().wheelset->mass();
    const double mass = 1 / (1 / vehicle.sprung_mass + 1 / pulling);
    const double omega = 2 * std::numbers::pi * kLinkFrequency;
    DeckSpring link;
    link.component = 0;
    link.stiffness = mass * omega * omega;
    parts.add(sprung, unsprung, link);
    deck.moving.emplace_back(sprung, Vec3{deck.wheel().velocity.x, 0, 0});
    deck.held[2].push_back(sprung);
  } else {
    deck.held[1 + 2].push_back(sprung);
  }
}

}  // namespace tread
