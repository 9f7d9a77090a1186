#pragma once
// The operator on the aggregates' rigid modes, found by probing and factorised by a sparse direct method.

#include <cstdint>
#include <memory>
#include <vector>

#include "kernels/solver/aggregates.hpp"
#include "kernels/solver/linear_operator.hpp"

namespace tread {

/// Aggregates that A may couple with each aggregate (itself included, ascending): those of nodes that share
/// an element, with the primaries in place of a secondary node. `ties` in ascending order of secondaries.
std::vector<std::vector<int>> aggregate_graph(const Mesh& mesh, const Aggregates& aggregates,
                                              const std::vector<TiedSlot>& ties);

/// Colours such that two aggregates with a common neighbour in the graph differ.
std::vector<int> distance_two_colours(const std::vector<std::vector<int>>& graph);

/// Solves A_c y = r, A_c = Z^T (A + springs) Z, by L D L^T. Motions without stiffness are held by 1e-12 of
/// their diagonal.
class CoarseSolver {
 public:
  /// Probes `a` with six applications for each colour. `a` must hold nothing but elements and ties. Throws
  /// NumericalError if `a` couples aggregates that the graph does not.
  CoarseSolver(const Aggregates& aggregates, const std::vector<std::vector<int>>& graph, const Operator& a,
               std::int64_t values);
  ~CoarseSolver();
  CoarseSolver(CoarseSolver&&) noexcept;

  /// Adds the springs to the probed matrix and factorises it. Throws NumericalError if the factorisation
  /// fails.
  void factorise(const Aggregates& aggregates, const std::vector<Spring>& springs);

  /// Solves for `y`. `r` and `y` have Aggregates::modes() values and may be one array.
  void solve(const double* r, double* y) const;

 private:
  struct Matrices;
  std::unique_ptr<Matrices> matrices_;
};

}  // namespace tread
