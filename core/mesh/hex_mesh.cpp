#include "core/mesh/hex_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace tread {

namespace {

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

template <class Takes>
std::vector<OuterFace> outer_faces_where(const HexMesh& mesh, const Takes& takes) {
  using Nodes = std::array<std::int32_t, 4>;
  std::vector<std::pair<Nodes, OuterFace>> faces;  // by their nodes, ascending
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    for (const auto& of : kHexFaces) {
      OuterFace face{{}, static_cast<std::int32_t>(e)};
      for (std::size_t k = 0; k < 4; ++k) face.nodes[k] = mesh.elements[e][of[k]];
      if (!std::all_of(face.nodes.begin(), face.nodes.end(), takes)) continue;
      Nodes sorted = face.nodes;
      std::sort(sorted.begin(), sorted.end());
      faces.emplace_back(sorted, face);
    }
  std::sort(faces.begin(), faces.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<OuterFace> outer;
  for (std::size_t i = 0; i < faces.size();) {
    std::size_t end = i + 1;
    while (end < faces.size() && faces[end].first == faces[i].first) ++end;
    if (end == i + 1) outer.push_back(faces[i].second);
    i = end;
  }
  return outer;
}

}  // namespace

std::vector<OuterFace> outer_faces(const HexMesh& mesh) {
  return outer_faces_where(mesh, [](std::int32_t) { return true; });
}

std::vector<OuterFace> outer_faces(const HexMesh& mesh, const std::vector<std::int32_t>& set) {
  return outer_faces_where(
      mesh, [&](std::int32_t node) { return std::binary_search(set.begin(), set.end(), node); });
}

HexShape hex_shape(const std::array<Vec3, 8>& corners) {
  HexShape shape;
  shape.volume = volume_of(corners);
  shape.shortest_edge = std::numeric_limits<double>::max();
  double smallest = std::numeric_limits<double>::max();
  for (std::size_t i = 0; i < 8; ++i) {
    std::array<Vec3, 3> edge;
    for (std::size_t k = 0; k < 3; ++k) {
      edge[k] = corners[kHexNeighbours[i][k]] - corners[i];
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
