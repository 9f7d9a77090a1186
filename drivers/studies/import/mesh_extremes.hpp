#pragma once
// Sizes of a mesh of hexahedra, and the elements that have the extreme ones.

#include <cstdint>

#include "core/material.hpp"
#include "core/mesh/hex_mesh.hpp"

namespace tread {

/// A value and the number, in the file, of the element that has it.
struct ElementExtreme {
  double value = 0;
  std::int64_t element = 0;
};

struct MeshExtremes {
  Vec3 low, high;                              ///< corners of the bounding box [m]
  double volume = 0;                           ///< [m3]
  ElementExtreme shortest_edge, longest_edge;  ///< [m]
  ElementExtreme edge_ratio;   ///< largest ratio of longest to shortest edge in an element [-]
  ElementExtreme jacobian;     ///< smallest at a corner, by its mean [-]
  ElementExtreme stable_step;  ///< smallest of an element alone, without damping [s]
  double assembled_step = 0;   ///< of the free mesh, without damping [s]
};

/// The same bits for any number of threads.
MeshExtremes mesh_extremes(const HexMesh& mesh, const Material& material);

}  // namespace tread
