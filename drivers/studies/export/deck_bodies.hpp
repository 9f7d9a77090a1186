#pragma once
// Nodes, elements, parts and materials of the bodies.

#include "drivers/studies/export/deck_model.hpp"
#include "io/deck/keyword_deck.hpp"

namespace tread {

/// Writes nodes, hexahedra, a part for each material of each block, and its damping.
void write_bodies(DeckModel& deck, KeywordDeck& out);

}  // namespace tread
