#pragma once
// L D L^T of a sparse symmetric matrix. Its triangular systems are solved in parallel, level by level:
// subtrees of the elimination tree beside one another, then those above them.
// [Davis, Direct Methods for Sparse Linear Systems, 4.1]

#include <Eigen/Sparse>
#include <cstdint>
#include <vector>

namespace tread {

/// One object serves one caller at a time: solving uses buffers of its own.
class SparseFactor {
 public:
  using Matrix = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

  /// Factorises the matrix of this lower triangle. The first call chooses the order of elimination by its
  /// pattern; later ones keep it, for a pattern that differs little. Returns false where a pivot is zero or
  /// not a number.
  bool compute(const Matrix& matrix);

  /// Solves A y = r; `r` and `y` may be one array. The bits do not depend on the number of threads.
  void solve(const double* r, double* y) const;

 private:
  using Bundle = std::vector<int>;  ///< ascending columns of subtrees that one thread takes
  /// Bundles that do not need one another, and the number of columns above them.
  struct Level {
    std::vector<Bundle> bundles;
    std::size_t above;
  };
  const Matrix& lower() const { return factor_.matrixL().nestedExpression(); }
  void divide();
  static std::vector<Bundle> bundles_of(const std::vector<int>& columns, const std::vector<int>& parent,
                                        const std::vector<std::int64_t>& work, std::size_t count);
  void solve_forward(const Level& level) const;
  void solve_forward(const Bundle& bundle, std::size_t above, double* sums) const;
  void solve_backward(const Bundle& bundle) const;

  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order_;  ///< place of each row in it
  Eigen::SimplicialLDLT<Matrix, Eigen::Upper, Eigen::NaturalOrdering<int>> factor_;
  std::vector<double> inverse_pivots_;
  std::vector<Level> levels_;         ///< from the leaves to the root
  std::vector<int> by_level_;         ///< columns from the root's level to that of the leaves
  std::vector<std::size_t> number_;   ///< of each column, in by_level_
  mutable std::vector<double> x_;     ///< in the order of elimination
  mutable std::vector<double> sums_;  ///< of bundles for the columns above
};

}  // namespace tread
