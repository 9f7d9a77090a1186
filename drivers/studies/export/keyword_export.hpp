#pragma once
// A model as an LS-DYNA keyword deck.

#include <cstdint>
#include <string>
#include <vector>

#include "drivers/engine/model/model.hpp"
#include "drivers/studies/export/deck_model.hpp"
#include "drivers/studies/export/deck_options.hpp"
#include "io/deck/keyword_deck.hpp"

namespace tread {

/// Statement about a deck for its head and for the user.
struct DeckSummary {
  std::int64_t nodes = 0, elements = 0;  ///< of the bodies
  std::int64_t discrete_elements = 0;    ///< springs and dampers
  double mass = 0;                       ///< of the bodies [kg]
  double step = 0;                       ///< this program's step [s]
  double step_factor = 0;                ///< of the reader's own step, which knows no damping [-]
  double duration = 0;                   ///< [s]
  RadiossCards radioss;                  ///< beside the deck; empty where that holds all
  std::vector<std::string> differences;  ///< sentences on what the deck leaves out or states in another way
};

/// Writes the model. Without a preload its motion starts rigidly: MotionSpec::start is "rigid". `origin`:
/// program that writes the deck. Throws InputError for models that the deck would falsify.
DeckSummary write_keyword_deck(const Model& model, const DeckOptions& options, const std::string& origin,
                               KeywordDeck& out);

}  // namespace tread
