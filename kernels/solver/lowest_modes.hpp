#pragma once
// Lowest natural modes of a body by the preconditioned block method LOBPCG.
// [Knyazev, Toward the optimal preconditioned eigensolver, SIAM J. Sci. Comput. 23 (2001)]

#include <vector>

#include "core/aligned.hpp"
#include "kernels/solver/conjugate_gradients.hpp"
#include "kernels/solver/linear_operator.hpp"

namespace tread {

struct LowestModesOptions {
  int count = 10;           ///< number of wanted modes
  int guard = 4;            ///< further iterates, so that the wanted modes converge
  double shift = 0;         ///< shift of the preconditioner, added to eigenvalues in the tolerance [rad2/s2]
  double tolerance = 3e-3;  ///< bound on the residual in the norm of M^-1 against eigenvalue + shift: no
                            ///< eigenvalue is farther off; an error that is smooth leaves its square
  int max_iterations = 200;
};

struct LowestModes {
  std::vector<double> omega;                  ///< natural angular frequencies, ascending; rigid motions come
                                              ///< out near 0 [rad/s]
  std::vector<AlignedVector<double>> shapes;  ///< mode shapes, x^T M x = 1, as many [kg^-1/2]
  double residual = 0;                        ///< largest residual of the wanted modes, as `tolerance`
  int iterations = 0;
};

/// Lowest modes of K x = omega^2 M x. `stiffness` is symmetric, positive semidefinite; `mass`: 3 * mesh.slots
/// values, zero where an unknown is not free [kg]. `preconditioner` approximates (K + shift M)^-1. Throws
/// NumericalError without convergence in max_iterations.
LowestModes lowest_modes(const Operator& stiffness, const AlignedVector<double>& mass,
                         const Preconditioner& preconditioner, const LowestModesOptions& options);

}  // namespace tread
