#pragma once
// Where a keyword deck differs from the model that it is written from.

#include <string>
#include <vector>

#include "drivers/engine/model/model.hpp"
#include "drivers/studies/export/deck_options.hpp"

namespace tread {

/// InputError for scenes whose deck would be wrong: a guided bore, a corrugation in the gap alone, friction
/// by place, an axle box without mass, no time to end.
void require_deck_can_hold(const Model& model, const DeckOptions& options);

/// Sentences on all that the deck leaves out or states in another way.
std::vector<std::string> deck_differences(const Model& model, const DeckOptions& options, double step);

}  // namespace tread
