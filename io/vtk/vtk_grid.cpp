#include "io/vtk/vtk_grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace tread {

namespace {

/// Collects the cells of one block.
class BlockCells {
 public:
  BlockCells(VtkGrid& grid, const SweptBlock& block, int index)
      : grid_(grid),
        block_(block),
        index_(index),
        nodes_(static_cast<std::size_t>(block.section.nodes())),
        place_(static_cast<std::size_t>(block.nodes()), -1) {}

  /// Adds the elements. A quad runs counter-clockwise seen along the sweep, as VTK requires for the first
  /// face of a hexahedron.
  void add_elements() {
    for_stations([&](int near, int far) {
      for (int quad = 0; quad < quads(); ++quad) {
        for (const int station : {near, far})
          for (const int node : corners(quad)) use(node, station);
        grid_.cells.push_back({index_, quad, near});
      }
    });
  }

  void add_faces() {
    const std::vector<Edge> edges = outer_edges();
    if (!block_.closed) add_end(0, 0, true);
    for_stations([&](int near, int far) {
      for (const Edge& edge : edges) {
        use(edge.from, near);
        use(edge.to, near);
        use(edge.to, far);
        use(edge.from, far);
        grid_.cells.push_back({index_, edge.quad, near});
      }
    });
    const int last = block_.station_count() - 1;
    if (!block_.closed) add_end(last, last - 1, false);
  }

 private:
  /// Edge of a quad, in its sense of rotation.
  struct Edge {
    int from, to, quad;
  };

  int quads() const { return static_cast<int>(block_.section.quads.size()); }
  const std::array<int, 4>& corners(int quad) const {
    return block_.section.quads[static_cast<std::size_t>(quad)];
  }

  /// Calls visit(near, far) for the elements along the sweep.
  template <class Visit>
  void for_stations(const Visit& visit) const {
    for (const Tile& tile : block_.tiles)
      for (int element = 0; element < tile.elements; ++element)
        visit(tile.first_station + element, (tile.first_station + element + 1) % block_.station_count());
  }

  /// Edges that belong to one quad only.
  std::vector<Edge> outer_edges() const {
    std::map<std::pair<int, int>, std::pair<Edge, int>> all;  // edges and the number of their quads
    for (int quad = 0; quad < quads(); ++quad)
      for (std::size_t i = 0; i < 4; ++i) {
        const Edge edge{corners(quad)[i], corners(quad)[(i + 1) % 4], quad};
        ++all.try_emplace(std::minmax(edge.from, edge.to), edge, 0).first->second.second;
      }
    std::vector<Edge> outer;
    for (const auto& [nodes, edge] : all)
      if (edge.second == 1) outer.push_back(edge.first);
    return outer;
  }

  /// Adds the section at a station as an end of the body; the elements behind it start at `element`.
  void add_end(int station, int element, bool backwards) {
    for (int quad = 0; quad < quads(); ++quad) {
      std::array<int, 4> nodes = corners(quad);
      if (backwards) std::reverse(nodes.begin(), nodes.end());
      for (const int node : nodes) use(node, station);
      grid_.cells.push_back({index_, quad, element});
    }
  }

  void use(int node, int station) {
    std::int64_t& place = place_[static_cast<std::size_t>(station) * nodes_ + static_cast<std::size_t>(node)];
    if (place < 0) {
      place = static_cast<std::int64_t>(grid_.points.size());
      grid_.points.push_back({index_, node, station});
    }
    grid_.connectivity.push_back(place);
  }

  VtkGrid& grid_;
  const SweptBlock& block_;
  int index_;
  std::size_t nodes_;
  std::vector<std::int64_t> place_;  ///< [station][node]: index in grid_.points, -1: not used so far
};

/// Adds the elements of a body, or its outer faces.
void add_body(VtkGrid& grid, const HexBody& body, int part) {
  constexpr int kNoStation = 0;
  std::vector<std::int64_t> place(body.mesh.nodes.size(), -1);
  const auto use = [&](std::int32_t node) {
    std::int64_t& at = place[static_cast<std::size_t>(node)];
    if (at < 0) {
      at = static_cast<std::int64_t>(grid.points.size());
      grid.points.push_back({part, node, kNoStation});
    }
    grid.connectivity.push_back(at);
  };
  if (grid.kind == VtkCells::elements) {
    for (std::size_t e = 0; e < body.mesh.elements.size(); ++e) {
      for (const std::int32_t node : body.mesh.elements[e]) use(node);
      grid.cells.push_back({part, static_cast<int>(e), kNoStation});
    }
    return;
  }
  for (const OuterFace& face : outer_faces(body.mesh)) {
    for (const std::int32_t node : face.nodes) use(node);
    grid.cells.push_back({part, face.element, kNoStation});
  }
}

}  // namespace

Vec3 position(const Mesh& mesh, const VtkGrid::Point& point) {
  if (const HexBody* body = mesh.body_of(point.block))
    return body->mesh.nodes[static_cast<std::size_t>(point.node)];
  return position(mesh.blocks[static_cast<std::size_t>(point.block)], point.node, point.station);
}

VtkGrid make_vtk_grid(const Mesh& mesh, VtkCells kind) {
  VtkGrid grid;
  grid.kind = kind;
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    BlockCells cells(grid, mesh.blocks[b], static_cast<int>(b));
    if (kind == VtkCells::elements)
      cells.add_elements();
    else
      cells.add_faces();
  }
  for (std::size_t b = 0; b < mesh.bodies.size(); ++b)
    add_body(grid, mesh.bodies[b], static_cast<int>(mesh.blocks.size() + b));
  return grid;
}

Vec3 placed(const Placement& placement, const Vec3& at) {
  const double c = std::cos(placement.angle);
  const double s = std::sin(placement.angle);
  return placement.origin + Vec3{c * at.x + s * at.z, at.y, c * at.z - s * at.x};
}

}  // namespace tread
