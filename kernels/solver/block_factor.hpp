#pragma once
// A sparse symmetric matrix of 6 x 6 blocks and its factor: a library's factor by single entries takes four
// times as long to solve with.

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace tread {

inline constexpr int kBlockSize = 6;
using MatrixBlock = Eigen::Matrix<double, kBlockSize, kBlockSize>;

/// The lower triangle of a symmetric matrix, by columns of blocks.
class BlockMatrix {
 public:
  struct Entry {
    int row = 0;
    MatrixBlock value = MatrixBlock::Zero();
  };

  explicit BlockMatrix(std::size_t columns);

  int size() const { return static_cast<int>(columns_.size()); }
  /// A block with row >= column, zero where it is new; all of a diagonal block counts.
  MatrixBlock& at(int row, int column);
  /// Blocks in ascending order of their rows, the diagonal's first.
  const std::vector<Entry>& column(int column) const { return columns_[static_cast<std::size_t>(column)]; }

  /// Product with `x`, size() * kBlockSize values.
  Eigen::VectorXd times(const Eigen::VectorXd& x) const;

 private:
  std::vector<std::vector<Entry>> columns_;
};

/// P A P^T = L D L^T with the diagonal blocks D; P reduces the blocks of L. [Davis, Direct Methods for Sparse
/// Linear Systems, 4 and 7.1]
class BlockFactor {
 public:
  /// Returns false where a diagonal block of D has no finite inverse.
  bool compute(const BlockMatrix& matrix);

  /// Solves in place. One object serves one caller at a time: solving uses a buffer of its own.
  void solve(Eigen::VectorXd& x) const;

 private:
  using Columns = std::vector<std::vector<int>>;
  void choose_order(const BlockMatrix& matrix);
  void find_blocks(const BlockMatrix& matrix);
  /// Rows of a column's blocks below the diagonal, by number in `rows_`.
  std::size_t end(std::size_t column) const { return first_[column + 1]; }

  std::vector<int> place_;                ///< of a block of A in the order of elimination
  std::vector<std::size_t> first_;        ///< of a column's blocks in `rows_` and `below_`
  std::vector<int> rows_;                 ///< ascending in a column
  std::vector<MatrixBlock> below_;        ///< of L
  std::vector<MatrixBlock> inverse_;      ///< of D
  mutable std::vector<double> permuted_;  ///< P x
};

}  // namespace tread
