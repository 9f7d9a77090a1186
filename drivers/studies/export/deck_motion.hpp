#pragma once
// Restraints, loads and initial velocities.

#include "drivers/studies/export/deck_model.hpp"
#include "io/deck/keyword_deck.hpp"

namespace tread {

/// Writes the nodes that are held: those of the model and DeckModel::held.
void write_restraints(DeckModel& deck, KeywordDeck& out);

/// Writes gravity, static loads on the journal, torque and hammer with their curves.
void write_loads(DeckModel& deck, KeywordDeck& out);

/// Writes the motion of every node at t = 0.
void write_velocities(DeckModel& deck, KeywordDeck& out);

}  // namespace tread
