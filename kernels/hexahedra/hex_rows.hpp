#pragma once
// Rows of hexahedra with a common face from one to the next: their corners lie on four lines.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/mesh/hex_mesh.hpp"

namespace tread {

/// Eight elements of one part, one behind the other.
struct ElementRow {
  std::array<std::int32_t, 8> element;
  /// Nodes of the four lines. Corners of element i are the nodes i of the lines and then the nodes i + 1, in
  /// an order that HexMesh allows.
  std::array<std::array<std::int32_t, 9>, 4> line;
};

/// Rows among these elements, each in one row at the most; `rest` gets the others, in their order. The rows
/// depend on the order of the elements alone.
std::vector<ElementRow> find_rows(const HexMesh& mesh, std::span<const std::int32_t> elements,
                                  std::vector<std::int32_t>& rest);

}  // namespace tread
