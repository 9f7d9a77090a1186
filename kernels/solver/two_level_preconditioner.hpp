#pragma once
// The preconditioner of the static solver: aggregates' rigid motions below, a Chebyshev polynomial above.

#include <vector>

#include "core/aligned.hpp"
#include "core/mesh/swept_block.hpp"
#include "kernels/solver/aggregates.hpp"
#include "kernels/solver/coarse_solver.hpp"
#include "kernels/solver/conjugate_gradients.hpp"
#include "kernels/solver/linear_operator.hpp"

namespace tread {

enum class Cycle { additive, adef2, symmetric };
struct TwoLevelOptions {
  AggregateOptions aggregates;
  int degree = 3;            ///< of the Chebyshev polynomial
  double spread = 30;  ///< the polynomial damps [lambda_max / spread, lambda_max]
  Cycle cycle = Cycle::symmetric;
};

class TwoLevelPreconditioner : public Preconditioner {
 public:
  TwoLevelPreconditioner(const Mesh& mesh, Operator a, const AlignedVector<double>& diagonal,
                         const std::vector<TiedSlot>& ties, const TwoLevelOptions& options);

  void update(Operator a_with_springs, const std::vector<Spring>& springs);
  void apply(const double* r, double* z) const override;
  const Aggregates& aggregates() const { return aggregates_; }
  const CoarseSolver& coarse() const { return coarse_; }
  void set(Cycle c, int d, double s) { options_.cycle = c; options_.degree = d; options_.spread = s; }
  double largest_eigenvalue() const { return lambda_max_; }
  void start(const double* r, double* x) const;
  mutable double t_coarse = 0;

 private:
  void correct(const double* r, double* z) const;
  void smooth(double* r, double* z, bool want_residual) const;
  TwoLevelOptions options_;
  AlignedVector<double> diagonal_;
  Aggregates aggregates_;
  CoarseSolver coarse_;
  Operator a_;
  AlignedVector<double> inverse_;
  double lambda_max_ = 0;
  mutable AlignedVector<double> res_, p_, q_;
  mutable std::vector<double> rc_;
};

}  // namespace tread
