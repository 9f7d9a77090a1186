#pragma once
// Largest stable step of the central difference from the assembled operator. [theory.md, Stable step]

#include "core/aligned.hpp"
#include "kernels/solver/linear_operator.hpp"

namespace tread {

struct HighestFrequency {
  double omega = 0;     ///< upper bound of the largest eigenfrequency [rad/s]
  double residual = 0;  ///< relative residual of its square [-]
  int iterations = 0;
};

/// Largest eigenfrequency by Lanczos on M^-1/2 A M^-1/2. The Ritz value bounds the largest eigenvalue from
/// below; its residual norm is added. `inverse_mass`: 3 * mesh.slots values, zero outside the free unknowns
/// [1/kg].
HighestFrequency highest_frequency(const Operator& a, const AlignedVector<double>& inverse_mass,
                                   int max_iterations = 200);

/// Step [s] at which the central difference with forces K (u + beta v) of lagged velocity is just stable: dt
/// = 2 / omega (sqrt(1 + xi^2) - xi), xi = beta omega / 2.
double stable_step(double omega, double beta);

}  // namespace tread
