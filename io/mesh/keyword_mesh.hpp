#pragma once
// Meshes in LS-DYNA keyword decks.

#include <string_view>

#include "io/mesh/mesh_source.hpp"
#include "io/mesh/mesh_text.hpp"

namespace tread {

/// Reads *NODE, *ELEMENT_SOLID in one or two cards, *PART, *SET_NODE, *SET_SOLID and *SET_SEGMENT of a deck
/// in the standard format or with numbers in ten characters, and counts the other keywords.
MeshSource read_keyword_mesh(std::string_view text, MeshFaults& faults);

}  // namespace tread
