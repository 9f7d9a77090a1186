#pragma once
// The static state in which a preloaded deck starts: stresses of the elements, velocities of the nodes.

#include <cstdint>
#include <utility>
#include <vector>

#include "drivers/studies/export/deck_model.hpp"
#include "io/deck/keyword_deck.hpp"

namespace tread {

/// Writes the stress in the middle of each element, which are numbered in the order of the deck's grid.
void write_stresses(const DeckModel& deck, KeywordDeck& out);

/// The undeformed places of the nodes of each part.
std::vector<RadiossReference> references(const DeckModel& deck);

/// Elements whose hourglass forces are kept.
struct KeptHourglass {
  double smallest = 0.05;  ///< share of the largest, of an element's forces
  /// The time that OpenRadioss's starter needs grows with the square of the number of loads.
  std::size_t elements = 1500;
};

/// Forces on nodes of the bodies that keep the static state where stresses in the middle of elements do not:
/// those of the hourglass stiffness, which no card holds. Forces on the wheel turn with it. [N]
std::vector<std::pair<std::int64_t, Vec3>> hourglass_forces(const DeckModel& deck,
                                                            const KeptHourglass& keep = {});

/// Velocity of each node at t = 0 [m/s], those beside the mesh included.
std::vector<std::pair<std::int64_t, Vec3>> node_velocities(const DeckModel& deck);

/// The same as cards.
void write_node_velocities(const DeckModel& deck, KeywordDeck& out);

}  // namespace tread
