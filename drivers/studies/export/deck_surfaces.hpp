#pragma once
// Surfaces that tie blocks or touch.

#include "drivers/studies/export/deck_model.hpp"
#include "io/deck/keyword_deck.hpp"

namespace tread {

/// Writes the ties: nodes of the fine side on the faces of the coarse side.
void write_ties(DeckModel& deck, KeywordDeck& out);

/// Writes the contact of the running surfaces of wheel and rail; nothing without contact.
void write_contact(DeckModel& deck, KeywordDeck& out);

}  // namespace tread
