#pragma once
// Choices of a keyword deck.

namespace tread {

/// Solver that reads the deck: both take the same cards, but for the hourglass control.
enum class DeckReader { openradioss, ls_dyna };

struct DeckOptions {
  DeckReader reader = DeckReader::openradioss;
  double ramp = 0;  ///< over which gravity and static loads grow to their full values [s]
};

}  // namespace tread
