#pragma once
// Vehicle over the wheelset: axle box with the unsprung mass, sprung mass on its suspension.

#include "drivers/studies/export/deck_model.hpp"
#include "drivers/studies/export/deck_springs.hpp"
#include "io/deck/keyword_deck.hpp"

namespace tread {

/// Frequency of the link by which the axle box pulls a carried sprung mass along [Hz].
inline constexpr double kLinkFrequency = 300;
/// Frequency of the axle box on its spokes to the journal [Hz].
inline constexpr double kSpokeFrequency = 3000;

/// Writes both masses and their nodes, and adds the suspension. Spokes, springs along their own direction,
/// hold the axle box in the middle of the journal, which turns about it. Nothing without a vehicle.
void write_vehicle(DeckModel& deck, DiscreteParts& parts, KeywordDeck& out);

/// Share of each node of the journal in a force on it: number of the node and share [-].
std::vector<std::pair<std::int64_t, double>> journal_shares(const DeckModel& deck);

}  // namespace tread
