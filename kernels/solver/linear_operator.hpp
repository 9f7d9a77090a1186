#pragma once
// The static solver's view of the model: a symmetric operator on vector fields and its rank-one springs.

#include <cstdint>
#include <functional>
#include <vector>

namespace tread {

/// Computes y = A x on vector fields of 3 * mesh.slots values (layout: dof()). A is symmetric and positive
/// semidefinite; x and y are zero outside the free unknowns and do not overlap. The operator may change x
/// while it works and restores it before it returns.
using Operator = std::function<void(double* x, double* y)>;

/// Energy stiffness / 2 (sum_i weights[i] x[dofs[i]])^2 of a spring between bodies or of one contact point.
struct Spring {
  double stiffness = 0;            ///< [N/m]
  std::vector<std::int64_t> dofs;  ///< free unknowns, each once
  std::vector<double> weights;     ///< weights of the displacements in the elongation [-], as many as dofs
};

/// A secondary node that a tie eliminates and one of the primary nodes that it follows. A primary node is not
/// secondary itself.
struct TiedSlot {
  std::int64_t secondary = -1;
  std::int64_t primary = -1;
};

/// Adds K x of all springs to y, in their order.
inline void add_springs(const std::vector<Spring>& springs, const double* x, double* y) {
  for (const Spring& spring : springs) {
    double elongation = 0;
    for (std::size_t i = 0; i < spring.dofs.size(); ++i) elongation += spring.weights[i] * x[spring.dofs[i]];
    const double force = spring.stiffness * elongation;
    for (std::size_t i = 0; i < spring.dofs.size(); ++i) y[spring.dofs[i]] += spring.weights[i] * force;
  }
}

}  // namespace tread
