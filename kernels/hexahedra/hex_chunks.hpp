#pragma once
// Parts of a mesh of hexahedra that one thread works on at a time.

#include <cstdint>
#include <span>
#include <vector>

#include "core/mesh/hex_mesh.hpp"

namespace tread {

/// Elements and nodes of a chunk at the most. Large chunks share few nodes.
inline constexpr std::size_t kChunkElements = 4096;
inline constexpr std::size_t kChunkNodes = 8000;

/// The elements, halved across their longest side until they are few.
std::vector<std::vector<std::int32_t>> hex_chunks(const HexMesh& mesh);

/// Nodes of elements, ascending.
std::vector<std::int32_t> nodes_of(const HexMesh& mesh, std::span<const std::int32_t> elements);

/// Renumbers the nodes chunk by chunk: a thread then finds what its chunks need together.
void number_by_chunks(HexMesh& mesh);

}  // namespace tread
