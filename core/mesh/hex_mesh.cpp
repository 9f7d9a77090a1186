#include "core/mesh/hex_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tread {

namespace {

/// Corners at the other ends of a corner's three edges, in the order of a positive triple product.
constexpr std::size_t kNeighbours[8][3] = {{1, 3, 4}, {2, 0, 5}, {3, 1, 6}, {0, 2, 7},
                                           {7, 5, 0}, {4, 6, 1}, {5, 7, 2}, {6, 4, 3}};

double triple(const Vec3& a, const Vec3& b, const Vec3& c) {
  return dot(a, cross(b, c));
}

/// Volume of the trilinear hexahedron: a third of the flux of the position through its bilinear faces.
double volume_of(const std::array<Vec3, 8>& x) {
  double sum = 0;
  for (const auto& face : kHexFaces) {
    const Vec3 a = x[face[0]] - x[0], b = x[face[1]] - x[0], c = x[face[2]] - x[0], d = x[face[3]] - x[0];
    sum += dot(0.25 * (a + b + c + d), 0.5 * cross(c - a, d - b));  // of the other terms none is even
  }
  return sum / 3;
}

}  // namespace

HexShape hex_shape(const std::array<Vec3, 8>& corners) {
  HexShape shape;
  shape.volume = volume_of(corners);
  shape.shortest_edge = std::numeric_limits<double>::max();
  double smallest = std::numeric_limits<double>::max();
  for (std::size_t i = 0; i < 8; ++i) {
    std::array<Vec3, 3> edge;
    for (std::size_t k = 0; k < 3; ++k) {
      edge[k] = corners[kNeighbours[i][k]] - corners[i];
      shape.shortest_edge = std::min(shape.shortest_edge, norm(edge[k]));
      shape.longest_edge = std::max(shape.longest_edge, norm(edge[k]));
    }
    smallest = std::min(smallest, triple(edge[0], edge[1], edge[2]));
  }
  // The map's Jacobian is an eighth of the triple product of edges.
  shape.smallest_jacobian = smallest / std::abs(shape.volume);
  return shape;
}

}  // namespace tread
