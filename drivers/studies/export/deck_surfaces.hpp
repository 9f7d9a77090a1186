#pragma once
// Surfaces that tie blocks or touch.

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "drivers/studies/export/deck_model.hpp"
#include "io/deck/keyword_deck.hpp"

namespace tread {

/// Four nodes of a face, along its border.
using DeckFace = std::array<std::int64_t, 4>;

/// Two sets that are tied or touch.
struct ContactSides {
  /// Kinds of a set, as contact cards name them.
  static constexpr int kSegments = 0, kNodes = 4;

  std::int64_t secondary = 0, primary = 0;
  int secondary_kind = kSegments, primary_kind = kSegments;
};

/// Writes a set of nodes or faces and returns its number.
std::int64_t write_node_set(DeckModel& deck, std::span<const std::int64_t> nodes, KeywordDeck& out);
std::int64_t write_segment_set(DeckModel& deck, const std::vector<DeckFace>& faces, KeywordDeck& out);

/// Writes the tie of nodes that lie on faces, or up to `distance` [m] beside them.
void write_tie_contact(DeckModel& deck, const std::string& title, const ContactSides& sides, double distance,
                       KeywordDeck& out);

/// Writes the ties of blocks: nodes of the fine side on the faces of the coarse side.
void write_ties(DeckModel& deck, KeywordDeck& out);

/// Writes sets of the surfaces by which a part of the deck may be tied as a body from a file; nothing where
/// there is neither disc nor rail below a head.
void write_part_sets(DeckModel& deck, KeywordDeck& out);

/// Writes the contact of the running surfaces of wheel and rail; nothing without contact.
void write_contact(DeckModel& deck, KeywordDeck& out);

}  // namespace tread
