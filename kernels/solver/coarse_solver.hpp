#pragma once
// The operator on the aggregates' rigid modes: found by probing, factorised by a sparse direct method.

#include <cstdint>
#include <memory>
#include <vector>

#include "kernels/solver/aggregates.hpp"
#include "kernels/solver/linear_operator.hpp"

namespace tread {

/// For each aggregate the aggregates that A may couple with it (itself included, ascending): those of nodes
/// that share an element, a secondary node standing for its primaries. `ties` in ascending order of
/// secondaries.
std::vector<std::vector<int>> aggregate_graph(const Mesh& mesh, const Aggregates& aggregates,
                                              const std::vector<TiedSlot>& ties);

/// Colours such that two aggregates with a common neighbour in the graph differ.
std::vector<int> distance_two_colours(const std::vector<std::vector<int>>& graph);

/// Solves A_c y = r, A_c = Z^T (A + springs) Z, by L D L^T. Motions without stiffness are held by 1e-12 of
/// their diagonal.
class CoarseSolver {
 public:
  /// Probes `a`, which must hold nothing but elements and ties: six applications for each colour. Throws
  /// NumericalError if `a` couples aggregates that the graph does not.
  CoarseSolver(const Aggregates& aggregates, const std::vector<std::vector<int>>& graph, const Operator& a,
               std::int64_t values);
  ~CoarseSolver();
  CoarseSolver(CoarseSolver&&) noexcept;

  /// Adds the springs to the probed matrix and factorises. Throws NumericalError if that fails.
  void factorise(const Aggregates& aggregates, const std::vector<Spring>& springs);

  /// `r` and `y` have Aggregates::modes() values and may be the same.
  void solve(const double* r, double* y) const;

  int probes() const;                   ///< applications spent
  std::int64_t factor_entries() const;  ///< entries of L

 private:
  struct Matrices;
  std::unique_ptr<Matrices> matrices_;
};

}  // namespace tread
