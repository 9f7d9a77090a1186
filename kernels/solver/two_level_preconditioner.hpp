#pragma once
// The static solver's preconditioner: the sum of a coarse solution on rigid motions of aggregates and a
// Chebyshev polynomial.

#include <utility>
#include <vector>

#include "core/aligned.hpp"
#include "core/mesh/swept_block.hpp"
#include "core/page_vector.hpp"
#include "kernels/solver/aggregates.hpp"
#include "kernels/solver/coarse_solver.hpp"
#include "kernels/solver/conjugate_gradients.hpp"
#include "kernels/solver/linear_operator.hpp"

namespace tread {

struct TwoLevelOptions {
  AggregateOptions aggregates;
  int degree = 3;      ///< degree of the Chebyshev polynomial, which applies the operator degree - 1 times
  double spread = 60;  ///< the polynomial approximates the inverse on [lambda_max / spread, lambda_max]
};

/// B = S + Z (Z^T A Z)^-1 Z^T with S a Chebyshev polynomial in D^-1 A times D^-1, D the diagonal. Iterations
/// grow with the aggregates' size over the smallest element and do not depend on the bodies' slenderness. One
/// object serves one caller at a time: applying it uses buffers of its own.
class TwoLevelPreconditioner : public Preconditioner {
 public:
  /// `elastic`: elements and eliminated ties without springs, applied some 200 times here and not kept.
  /// `diagonal`: diagonal of `elastic`, 0 where an unknown is not free, unused lanes included [N/m]. Keeps a
  /// reference to the mesh. Not ready before the first update(). Throws NumericalError as CoarseSolver does.
  TwoLevelPreconditioner(const Mesh& mesh, const Operator& elastic, AlignedVector<double> diagonal,
                         const std::vector<TiedSlot>& ties, const TwoLevelOptions& options = {});

  /// Takes over the operator with its springs, which may change from call to call (contact), and refactorises
  /// the coarse matrix.
  void update(Operator a, const std::vector<Spring>& springs);

  void apply(const double* r, double* z) const override;

  const Aggregates& aggregates() const { return aggregates_; }
  const CoarseSolver& coarse() const { return coarse_; }

 private:
  void smooth(const double* r, double* z) const;

  TwoLevelOptions options_;
  Aggregates aggregates_;
  CoarseSolver coarse_;
  Operator a_;
  PageVector<float> inverse_;  ///< inverse diagonal with springs; 0 where an unknown is not free [m/N]
  std::vector<std::pair<std::size_t, float>> changes_;  ///< changes of inverse_ by springs: place, value
                                                        ///< before
  double lambda_max_ = 0;                               ///< largest eigenvalue of D^-1 A
  mutable PageVector<double> a_z_;
  mutable std::vector<double> coarse_values_;
};

}  // namespace tread
