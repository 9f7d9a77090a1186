#pragma once
// A mesh of hexahedra with a connectivity of its own, as other programs make it.

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/math/vec.hpp"

namespace tread {

/// Indices of an element's nodes: 0 ... 3 run about one face, counter-clockwise seen from the face opposite;
/// 4 ... 7 are the nodes opposite to them.
using HexCorners = std::array<std::int32_t, 8>;

/// Every node belongs to an element, and every element has a positive Jacobian at its corners.
struct HexMesh {
  std::vector<Vec3> nodes;  ///< Cartesian positions [m]
  std::vector<HexCorners> elements;
  std::vector<std::int32_t> part;  ///< by element: index into `parts`
  std::vector<std::string> parts;
  std::vector<std::int64_t> node_number, element_number;          ///< in the file
  std::map<std::string, std::vector<std::int32_t>> node_sets;     ///< indices, ascending
  std::map<std::string, std::vector<std::int32_t>> element_sets;  ///< indices, ascending

  /// Positions of an element's nodes [m].
  std::array<Vec3, 8> corners(std::size_t element) const {
    std::array<Vec3, 8> at;
    for (std::size_t i = 0; i < 8; ++i) at[i] = nodes[static_cast<std::size_t>(elements[element][i])];
    return at;
  }
};

/// Corners of the six faces. Normals point outwards.
inline constexpr std::array<std::array<std::size_t, 4>, 6> kHexFaces = {
    {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};

/// Corners at the other ends of a corner's three edges, in the order of a positive triple product.
inline constexpr std::array<std::array<std::size_t, 3>, 8> kHexNeighbours = {
    {{1, 3, 4}, {2, 0, 5}, {3, 1, 6}, {0, 2, 7}, {7, 5, 0}, {4, 6, 1}, {5, 7, 2}, {6, 4, 3}}};

/// A face of one element alone. Its nodes run about it, its normal points outwards.
struct OuterFace {
  std::array<std::int32_t, 4> nodes;
  std::int32_t element = -1;
};
/// All outer faces, or those all of whose nodes belong to a set (indices, ascending).
std::vector<OuterFace> outer_faces(const HexMesh& mesh);
std::vector<OuterFace> outer_faces(const HexMesh& mesh, const std::vector<std::int32_t>& set);

/// Shape of an element by its corners.
struct HexShape {
  double volume = 0;             ///< of the trilinear map [m3]
  double shortest_edge = 0;      ///< [m]
  double longest_edge = 0;       ///< [m]
  double smallest_jacobian = 0;  ///< over the corners, by volume / 8: 1 for a brick [-]
};
HexShape hex_shape(const std::array<Vec3, 8>& corners);

}  // namespace tread
