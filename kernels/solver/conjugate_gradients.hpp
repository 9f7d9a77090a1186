#pragma once
// Preconditioned conjugate gradients, with optional motions held in the mean.

#include <cstdint>
#include <vector>

#include "core/aligned.hpp"
#include "core/page_vector.hpp"
#include "kernels/solver/held_motions.hpp"
#include "kernels/solver/linear_operator.hpp"

namespace tread {

/// A symmetric positive definite approximation of the operator's inverse on the free unknowns.
class Preconditioner {
 public:
  virtual ~Preconditioner() = default;
  /// Computes z = B r; r and z do not overlap.
  virtual void apply(const double* r, double* z) const = 0;
};

/// Division by the diagonal; zero where the diagonal is not positive (unknowns that are not free).
class JacobiPreconditioner : public Preconditioner {
 public:
  explicit JacobiPreconditioner(const AlignedVector<double>& diagonal);
  void apply(const double* r, double* z) const override;

 private:
  AlignedVector<double> inverse_;
};

struct CgOptions {
  double tolerance = 0;  ///< bound on the 2-norm of the balanced residual [N]
  int max_iterations = 2000;
};

/// Buffers for systems of one size, which are solved one after another: the next begin with memory that is
/// there.
struct CgVectors {
  PageVector<double> direction, image;
};

struct CgResult {
  bool converged = false;  ///< true if the recurrence's residual, which rounding may lower, converged
  int iterations = 0;
  std::vector<double> residual_history;  ///< 2-norm of the balanced residual, entry k after k iterations [N]
};

/// Moves x towards the solution of A x = b. `r`: b - A x on entry; the balanced residual of the recurrence on
/// return. `a` must be positive definite on the free unknowns less the held motions; the means of x stay.
/// `preconditioner` and `held` may be null. Without convergence in max_iterations (an unrestrained body, for
/// example) the last iterate is returned and the caller judges. Throws NumericalError if a search direction
/// has no stiffness.
CgResult conjugate_gradients(const Operator& a, const Preconditioner* preconditioner, const HeldMotions* held,
                             AlignedVector<double>& r, AlignedVector<double>& x, const CgOptions& options,
                             CgVectors& vectors);

}  // namespace tread
