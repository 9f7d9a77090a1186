#pragma once
// Choices of a keyword deck.

namespace tread {

struct Preload;

/// Solver that reads the deck: both take the same cards, but for hourglass control and stress update.
enum class DeckReader { openradioss, ls_dyna };

struct DeckOptions {
  DeckReader reader = DeckReader::openradioss;
  double ramp = 0;                   ///< over which gravity and static loads grow to their full values [s]
  double overlap = 0;                ///< by which the wheelset sits deeper at t = 0; for OpenRadioss [m]
  const Preload* preload = nullptr;  ///< static state in which the deck starts; null: undeformed

  /// True if contacts, ties and the start stand in cards of OpenRadioss beside the deck.
  bool radioss_cards() const { return preload != nullptr && reader == DeckReader::openradioss; }
};

}  // namespace tread
