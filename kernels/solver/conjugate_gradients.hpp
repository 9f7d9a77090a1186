#pragma once
// Preconditioned conjugate gradients, with optional motions that are held in the mean.

#include <cstdint>
#include <vector>

#include "core/aligned.hpp"
#include "kernels/solver/linear_operator.hpp"

namespace tread {

/// A symmetric positive definite approximation of the operator's inverse on the free unknowns.
class Preconditioner {
 public:
  virtual ~Preconditioner() = default;
  /// z = B r; r and z do not overlap.
  virtual void apply(const double* r, double* z) const = 0;
};

/// Division by the diagonal; zero where it is not positive (unknowns that are not free).
class JacobiPreconditioner : public Preconditioner {
 public:
  explicit JacobiPreconditioner(const AlignedVector<double>& diagonal);
  void apply(const double* r, double* z) const override;

 private:
  AlignedVector<double> inverse_;
};

/// Motions R_i along which the mean <W_j, x> of the solution is zero, and the forces W_j lambda_j that hold
/// them: A x = b - W lambda with W^T x = 0. For the mass-weighted mean pass W = M R, for the plain mean W =
/// R.
class HeldMotions {
 public:
  /// Both lists hold as many fields of 3 * mesh.slots values, zero outside the free unknowns. Throws
  /// NumericalError if some mean does not see its motion (W^T R singular).
  HeldMotions(std::vector<AlignedVector<double>> motions, std::vector<AlignedVector<double>> means);

  std::size_t count() const { return motions_.size(); }

  /// r -= W (R^T W)^-1 R^T r: what is left does no work on the motions.
  void balance(double* r) const;
  /// x -= R (W^T R)^-1 W^T x: what is left has zero means.
  void remove_mean(double* x) const;
  /// Work of r on each unit motion R_i; for r = b - A x the holding forces [N or N m, as R is scaled].
  std::vector<double> work(const double* r) const;

 private:
  std::vector<AlignedVector<double>> motions_;
  std::vector<AlignedVector<double>> means_;  ///< combined so that <motions_[i], means_[j]> = delta_ij
};

struct CgOptions {
  double relative_tolerance = 1e-9;  ///< of the balanced residual's 2-norm against the balanced right side's
  int max_iterations = 2000;
};

struct CgResult {
  bool converged = false;  ///< by the recurrence's residual, which rounding may leave below the true
  int iterations = 0;
  double relative_residual = 0;          ///< recomputed from the solution
  std::vector<double> residual_history;  ///< relative, entry k after k iterations
  std::vector<double> reactions;         ///< HeldMotions::work(b - A x)
};

/// Solves A x = b from the given x. `a` must be positive definite on the free unknowns less the held motions.
/// `preconditioner` and `held` may be null. Without convergence in max_iterations (an unrestrained body, for
/// example) it returns what it has: the caller judges. Throws NumericalError where a search direction has no
/// stiffness.
CgResult conjugate_gradients(const Operator& a, const Preconditioner* preconditioner, const HeldMotions* held,
                             const AlignedVector<double>& b, AlignedVector<double>& x,
                             const CgOptions& options);

}  // namespace tread
