#pragma once
// Nodes of the patch, and sums between them and the points that they carry. [theory.md, Contact]

#include <array>
#include <cstdint>
#include <vector>

#include "core/page_vector.hpp"
#include "core/parallel/parallel.hpp"
#include "kernels/contact/contact_point.hpp"
#include "kernels/lanes/patch_loop.hpp"

namespace tread {

struct TileForces;

/// True if the patch has points enough for all threads: of few points, waiting for one another takes longer
/// than the work.
inline bool worth_sharing(std::size_t points) {
  return points >= 2048;
}

/// Calls body(i) for i below n, by all threads if that is worth while.
template <class Body>
void share_patch(std::size_t points, std::size_t n, const Body& body) {
  const auto run = [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i) body(static_cast<std::size_t>(i));
  };
  if (worth_sharing(points))
    parallel_ranges(static_cast<std::int64_t>(n), run);
  else
    run(0, static_cast<std::int64_t>(n));
}

/// Points by cells: those that the same 16 nodes of a body carry share one. A sum goes over the nodes of each
/// cell once, not of each point. The bits do not depend on the number of threads.
class PatchCells {
 public:
  struct Node {
    std::int64_t slot;
    bool of_wheel;
    double cosine, sine;  ///< of the space angle of its basis (wheel)
    double inverse_mass;  ///< [1/kg]
  };

  PatchCells();
  /// Makes room for fields of `slots` nodes and for `points` points that carry `nodes` nodes at once.
  void reserve(std::int64_t slots, std::size_t points, std::size_t nodes);

  /// Finds the cells and nodes of the points. `mass`: by slot, above zero where surfaces have nodes [kg].
  void link(const std::vector<ContactPoint>& points, const double* mass);

  const std::vector<Node>& nodes() const { return nodes_; }

  /// Sets `nodes` to the inverse mass times the weighted sum of the points' vectors.
  void to_nodes(const std::vector<PatchVector>& points, std::vector<PatchVector>& nodes);
  /// Sets the sums by body to the points' weighted sums of the nodes' vectors.
  void to_points(const std::vector<PatchVector>& nodes);
  /// By point, of the last to_points(); of the rail and of the wheel.
  const std::vector<PatchVector>& sums(int body) const { return sums_[static_cast<std::size_t>(body)]; }
  /// The sum of both bodies.
  Vec3 sum(std::size_t point) const;

  /// Sets the sum over a point's nodes of the square of the weight times the inverse mass. [1/kg]
  void own_mobility(std::vector<double>& of_points) const;

  std::int64_t bytes() const;

 private:
  struct Cell {
    std::array<int, kCellNodes> node;
    int body;
    int first, count;  ///< of point_ and weights_
  };

  void find_cells(const std::vector<ContactPoint>& points, int body);
  int cell_of(const ContactPoint& point, int body);
  int number(const Node& node);
  void list_points(const std::vector<ContactPoint>& points);
  void list_terms();
  CellPoints points_of(const Cell& cell) const;

  const TileForces* lanes_;  ///< the widest instruction set's loops
  const double* mass_ = nullptr;
  PageVector<int> node_of_;  ///< by slot, its number and one; 0: none
  std::vector<Node> nodes_;
  std::vector<int> last_cell_;  ///< by node, the last cell at whose corner it is, -1: none
  std::vector<Cell> cells_;
  std::vector<int> cell_number_;  ///< by body and point
  std::vector<int> point_;        ///< by cell
  std::vector<PatchWeights> weights_;
  std::vector<PatchVector> cell_sums_;  ///< kCellNodes of each cell
  std::vector<int> first_term_, term_;  ///< of a node among the cell sums
  std::array<std::vector<PatchVector>, 2> sums_;
};

}  // namespace tread
