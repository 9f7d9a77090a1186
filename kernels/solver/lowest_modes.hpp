#pragma once
// Lowest natural modes of a body by the preconditioned block method LOBPCG.
// [Knyazev, Toward the optimal preconditioned eigensolver, SIAM J. Sci. Comput. 23 (2001)]

#include <vector>

#include "core/aligned.hpp"
#include "kernels/solver/conjugate_gradients.hpp"
#include "kernels/solver/linear_operator.hpp"

namespace tread {

struct LowestModesOptions {
  int count = 10;           ///< modes wanted
  int guard = 4;            ///< iterated beside them, so that the wanted ones converge
  double shift = 0;         ///< of the preconditioner, added to eigenvalues in the tolerance [rad2/s2]
  double tolerance = 3e-3;  ///< of the residual in the norm of M^-1 against eigenvalue + shift: no eigenvalue
                            ///< is farther off; an error that is smooth leaves its square
  int max_iterations = 200;
};

struct LowestModes {
  std::vector<double> omega;                  ///< ascending; rigid motions come out near 0 [rad/s]
  std::vector<AlignedVector<double>> shapes;  ///< x^T M x = 1, as many [kg^-1/2]
  double residual = 0;                        ///< largest of the wanted, as `tolerance`
  int iterations = 0;
};

/// Of K x = omega^2 M x. `stiffness` is symmetric, positive semidefinite; `mass`: 3 * mesh.slots values, zero
/// where an unknown is not free [kg]. `preconditioner` approximates (K + shift M)^-1. Throws NumericalError
/// without convergence in max_iterations.
LowestModes lowest_modes(const Operator& stiffness, const AlignedVector<double>& mass,
                         const Preconditioner& preconditioner, const LowestModesOptions& options);

}  // namespace tread
