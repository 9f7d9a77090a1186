// Faults of a mesh of hexahedra: shape, neighbourhood, cohesion.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "core/index.hpp"
#include "io/mesh/imported_mesh.hpp"

namespace tread {

namespace {

/// The element with its ends exchanged, or its faces run about the other way.
bool proper_if_turned(std::array<Vec3, 8> x) {
  for (std::size_t i = 0; i < 4; ++i) std::swap(x[i], x[i + 4]);
  return hex_shape(x).smallest_jacobian > 0;
}

/// Sets of elements that hang together.
class Pieces {
 public:
  explicit Pieces(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }
  std::int32_t of(std::int32_t i) {
    while (parent_[index(i)] != i) i = parent_[index(i)] = parent_[index(parent_[index(i)])];
    return i;
  }
  void join(std::int32_t a, std::int32_t b) {
    a = of(a);
    b = of(b);
    parent_[index(std::max(a, b))] = std::min(a, b);
  }

 private:
  std::vector<std::int32_t> parent_;
};

class MeshChecks {
 public:
  MeshChecks(const HexMesh& mesh, const std::vector<int>& lines, MeshFaults& faults)
      : mesh_(mesh), lines_(lines), faults_(faults), pieces_(mesh.elements.size()) {}

  void run(int pieces) {
    check_shapes();
    check_copies();
    if (!faults_.empty()) return;
    join_faces();
    if (!faults_.empty()) return;
    check_nodes(pieces);
    check_pieces(pieces);
  }

 private:
  void fault(std::int32_t element, const char* kind, const std::string& message) {
    faults_.add(lines_[index(element)], kind,
                fmt::format("element {} {}", mesh_.element_number[index(element)], message));
  }

  void check_shapes() {
    for (std::size_t e = 0; e < mesh_.elements.size(); ++e) {
      const HexShape shape = hex_shape(mesh_.corners(e));
      shortest_ = std::min(shortest_, shape.shortest_edge);
      if (shape.smallest_jacobian > 0) continue;
      const auto element = static_cast<std::int32_t>(e);
      if (proper_if_turned(mesh_.corners(e)))
        fault(element, "inverted elements",
              "is inverted: its nodes run the other way round; list nodes 5 to 8 before nodes 1 to 4");
      else if (shape.shortest_edge == 0)
        fault(element, "elements without volume",
              "has an edge of no length: two of its nodes lie on one place");
      else
        fault(element, "folded elements",
              fmt::format(
                  "is folded: its smallest Jacobian at a corner is {:.3g} of the mean, and must be above "
                  "0; are its nodes in order?",
                  shape.smallest_jacobian));
    }
  }

  /// Elements on the same nodes.
  void check_copies() {
    std::vector<std::pair<HexCorners, std::int32_t>> sorted;
    sorted.reserve(mesh_.elements.size());
    for (std::size_t e = 0; e < mesh_.elements.size(); ++e) {
      sorted.emplace_back(mesh_.elements[e], static_cast<std::int32_t>(e));
      std::sort(sorted.back().first.begin(), sorted.back().first.end());
    }
    std::sort(sorted.begin(), sorted.end());
    for (std::size_t i = 1; i < sorted.size(); ++i)
      if (sorted[i].first == sorted[i - 1].first)
        fault(sorted[i].second, "elements on the nodes of others",
              fmt::format("has the nodes of element {}: delete one of them",
                          mesh_.element_number[index(sorted[i - 1].second)]));
  }

  /// Joins elements with a common face.
  void join_faces() {
    std::vector<std::pair<std::array<std::int32_t, 4>, std::int32_t>> faces;
    faces.reserve(6 * mesh_.elements.size());
    for (std::size_t e = 0; e < mesh_.elements.size(); ++e)
      for (const auto& corners : kHexFaces) {
        std::array<std::int32_t, 4> nodes;
        for (std::size_t i = 0; i < 4; ++i) nodes[i] = mesh_.elements[e][corners[i]];
        std::sort(nodes.begin(), nodes.end());
        faces.emplace_back(nodes, static_cast<std::int32_t>(e));
      }
    std::sort(faces.begin(), faces.end());
    for (std::size_t i = 1; i < faces.size(); ++i) {
      if (faces[i].first != faces[i - 1].first) continue;
      pieces_.join(faces[i].second, faces[i - 1].second);
      if (i + 1 == faces.size() || faces[i + 1].first != faces[i].first) continue;
      fault(faces[i + 1].second, "faces of more than two elements",
            fmt::format("shares a face (nodes {}) with elements {} and {}: a face belongs to two elements at "
                        "most",
                        nodes_text(faces[i].first), mesh_.element_number[index(faces[i].second)],
                        mesh_.element_number[index(faces[i - 1].second)]));
    }
  }

  std::string nodes_text(const std::array<std::int32_t, 4>& nodes) const {
    std::string text;
    for (const std::int32_t node : nodes)
      text += fmt::format("{}{}", text.empty() ? "" : ", ", mesh_.node_number[index(node)]);
    return text;
  }

  /// Nodes on nodes of the same piece; those of other pieces are remembered.
  void check_nodes(int pieces) {
    constexpr double kSame = 1e-3;  // of the shortest edge
    constexpr double kLargest = 1e9;
    const double reach = kSame * shortest_, cell = 0.25 * shortest_;
    double size = 0;
    for (const Vec3& at : mesh_.nodes)
      size = std::max({size, std::abs(at.x), std::abs(at.y), std::abs(at.z)});
    if (!(size < kLargest * shortest_)) {
      faults_.add(
          0, "sizes that do not fit",
          fmt::format("places reach {:.3g} m from the origin and the shortest edge is {:.3g} m long: the "
                      "numbers of the file cannot tell such nodes apart",
                      size, shortest_));
      return;
    }
    std::vector<std::int32_t> element_at(mesh_.nodes.size(), -1);
    for (std::size_t e = mesh_.elements.size(); e-- > 0;)
      for (const std::int32_t node : mesh_.elements[e])
        element_at[index(node)] = static_cast<std::int32_t>(e);
    using Cell = std::array<std::int64_t, 3>;
    struct Hash {
      std::size_t operator()(const Cell& c) const {
        std::uint64_t sum = 0;
        for (const std::int64_t i : c) sum = (sum ^ static_cast<std::uint64_t>(i)) * 0x9E3779B97F4A7C15ULL;
        return static_cast<std::size_t>(sum ^ (sum >> 29U));
      }
    };
    std::unordered_map<Cell, std::int32_t, Hash> first;  // elements are proper: a cell holds few nodes
    std::vector<std::int32_t> before(mesh_.nodes.size(), -1);
    const auto cell_of = [&](const Vec3& at) {
      Cell c;
      for (int i = 0; i < 3; ++i) c[index(i)] = static_cast<std::int64_t>(std::floor(at[i] / cell));
      return c;
    };
    for (std::size_t n = 0; n < mesh_.nodes.size(); ++n) {
      const Vec3& at = mesh_.nodes[n];
      const Cell low = cell_of(at - Vec3{reach, reach, reach}),
                 high = cell_of(at + Vec3{reach, reach, reach});
      std::int32_t found = -1;
      for (Cell c = low; c[0] <= high[0] && found < 0; ++c[0])
        for (c[1] = low[1]; c[1] <= high[1] && found < 0; ++c[1])
          for (c[2] = low[2]; c[2] <= high[2] && found < 0; ++c[2]) {
            const auto in_cell = first.find(c);
            for (std::int32_t other = in_cell == first.end() ? -1 : in_cell->second; other >= 0;
                 other = before[index(other)])
              if (norm(mesh_.nodes[index(other)] - at) <= reach) found = other;
          }
      const auto node = static_cast<std::int32_t>(n);
      const auto [here, added] = first.try_emplace(cell_of(at), node);
      if (!added) before[n] = std::exchange(here->second, node);
      if (found >= 0) report_pair(node, found, element_at, pieces);
    }
  }

  void report_pair(std::int32_t node, std::int32_t other, const std::vector<std::int32_t>& element_at,
                   int pieces) {
    const std::int32_t one = element_at[index(node)], two = element_at[index(other)];
    if (pieces > 1 && pieces_.of(one) != pieces_.of(two)) return;
    fault(one, "nodes on nodes",
          fmt::format("has node {} on the place of node {} of element {}: merge coincident nodes",
                      mesh_.node_number[index(node)], mesh_.node_number[index(other)],
                      mesh_.element_number[index(two)]));
  }

  void check_pieces(int pieces) {
    std::map<std::int32_t, std::int64_t> sizes;
    for (std::size_t e = 0; e < mesh_.elements.size(); ++e) ++sizes[pieces_.of(static_cast<std::int32_t>(e))];
    if (static_cast<int>(sizes.size()) == pieces) return;
    std::string text;
    constexpr std::size_t kMost = 5;
    std::size_t listed = 0;
    for (const auto& [first, size] : sizes) {
      if (listed++ == kMost) break;
      text += fmt::format("{}{} from element {}", text.empty() ? "" : ", ", size,
                          mesh_.element_number[index(first)]);
    }
    faults_.add(
        0, "wrong numbers of pieces",
        fmt::format("the mesh consists of {} pieces without a common face ({} on{}), and {} {} stated: "
                    "merge their nodes, choose parts, or state the pieces",
                    sizes.size(), text, sizes.size() > kMost ? ", ..." : "", pieces,
                    pieces == 1 ? "is" : "are"));
  }

  const HexMesh& mesh_;
  const std::vector<int>& lines_;
  MeshFaults& faults_;
  Pieces pieces_;
  double shortest_ = 1e300;  ///< edge [m]
};

}  // namespace

void check_mesh(const HexMesh& mesh, int pieces, const std::vector<int>& lines, MeshFaults& faults) {
  MeshChecks(mesh, lines, faults).run(pieces);
}

}  // namespace tread
