#include "kernels/solver/block_factor.hpp"

#include <Eigen/LU>
#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cstdint>

#include "core/index.hpp"

namespace tread {

namespace {

using BlockVector = Eigen::Map<Eigen::Matrix<double, kBlockSize, 1>>;

BlockVector block_of(double* values, std::size_t block) {
  return BlockVector(values + block * kBlockSize);
}

}  // namespace

BlockMatrix::BlockMatrix(std::size_t columns) : columns_(columns) {
  for (std::size_t column = 0; column < columns; ++column)
    columns_[column].push_back({static_cast<int>(column)});
}

MatrixBlock& BlockMatrix::at(int row, int column) {
  std::vector<Entry>& entries = columns_[index(column)];
  auto found = std::lower_bound(entries.begin(), entries.end(), row,
                                [](const Entry& entry, int wanted) { return entry.row < wanted; });
  if (found == entries.end() || found->row != row) found = entries.insert(found, {row});
  return found->value;
}

Eigen::VectorXd BlockMatrix::times(const Eigen::VectorXd& x) const {
  Eigen::VectorXd y = Eigen::VectorXd::Zero(x.size());
  for (int c = 0; c < size(); ++c)
    for (const Entry& entry : column(c)) {
      y.segment<kBlockSize>(entry.row * kBlockSize) += entry.value * x.segment<kBlockSize>(c * kBlockSize);
      if (entry.row != c)
        y.segment<kBlockSize>(c * kBlockSize) +=
            entry.value.transpose() * x.segment<kBlockSize>(entry.row * kBlockSize);
    }
  return y;
}

void BlockFactor::choose_order(const BlockMatrix& matrix) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int column = 0; column < matrix.size(); ++column)
    for (const BlockMatrix::Entry& entry : matrix.column(column)) {
      entries.emplace_back(entry.row, column, 1.0);
      entries.emplace_back(column, entry.row, 1.0);
    }
  Eigen::SparseMatrix<double> pattern(matrix.size(), matrix.size());
  pattern.setFromTriplets(entries.begin(), entries.end());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order;
  Eigen::AMDOrdering<int>()(pattern, order);
  place_.resize(index(matrix.size()));
  for (int place = 0; place < matrix.size(); ++place) place_[index(order.indices()[place])] = place;
}

/// A column of L has the rows of A's, and those of each column whose first row below the diagonal is its own.
void BlockFactor::find_blocks(const BlockMatrix& matrix) {
  const std::size_t size = place_.size();
  Columns below(size), children(size);
  for (int column = 0; column < matrix.size(); ++column)
    for (const BlockMatrix::Entry& entry : matrix.column(column)) {
      const auto [first, last] = std::minmax(place_[index(column)], place_[index(entry.row)]);
      if (first != last) below[index(first)].push_back(last);
    }
  first_.assign(1, 0);
  rows_.clear();
  for (std::size_t column = 0; column < size; ++column) {
    std::vector<int>& rows = below[column];
    for (const int child : children[column]) {
      const auto rest = below[index(child)].begin() + 1;  // the first is this column
      rows.insert(rows.end(), rest, below[index(child)].end());
      std::vector<int>().swap(below[index(child)]);
    }
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    rows_.insert(rows_.end(), rows.begin(), rows.end());
    first_.push_back(rows_.size());
    if (!rows.empty()) children[index(rows.front())].push_back(static_cast<int>(column));
  }
}

bool BlockFactor::compute(const BlockMatrix& matrix) {
  choose_order(matrix);
  find_blocks(matrix);
  const std::size_t size = place_.size();
  std::vector<MatrixBlock> pivots(size, MatrixBlock::Zero());
  inverse_.resize(size);
  below_.assign(rows_.size(), MatrixBlock::Zero());
  for (int column = 0; column < matrix.size(); ++column)
    for (const BlockMatrix::Entry& entry : matrix.column(column)) {
      const int row = place_[index(entry.row)];
      const int at = place_[index(column)];
      if (row == at) {
        pivots[index(at)] = entry.value;
        continue;
      }
      const std::size_t in = index(std::min(row, at));
      const auto found =
          std::lower_bound(rows_.begin() + static_cast<std::ptrdiff_t>(first_[in]),
                           rows_.begin() + static_cast<std::ptrdiff_t>(end(in)), std::max(row, at));
      MatrixBlock& value = below_[index(found - rows_.begin())];
      if (row > at)
        value = entry.value;
      else
        value = entry.value.transpose();
    }

  std::vector<std::size_t> next(first_.begin(), first_.end() - 1);  // block of a column that is due
  Columns due(size);                                                // columns with a block in a row
  std::vector<std::size_t> place_of_row(size);
  for (std::size_t column = 0; column < size; ++column) {
    for (std::size_t i = first_[column]; i < end(column); ++i) place_of_row[index(rows_[i])] = i;
    for (const int before : due[column]) {
      const std::size_t k = index(before);
      const MatrixBlock turned = pivots[k] * below_[next[k]].transpose();
      pivots[column].noalias() -= below_[next[k]] * turned;
      for (std::size_t i = next[k] + 1; i < end(k); ++i)
        below_[place_of_row[index(rows_[i])]].noalias() -= below_[i] * turned;
      if (++next[k] < end(k)) due[index(rows_[next[k]])].push_back(before);
    }
    inverse_[column] = pivots[column].inverse();
    if (!inverse_[column].allFinite()) return false;
    for (std::size_t i = first_[column]; i < end(column); ++i) below_[i] = below_[i] * inverse_[column];
    if (first_[column] < end(column)) due[index(rows_[first_[column]])].push_back(static_cast<int>(column));
  }
  permuted_.resize(size * kBlockSize);
  return true;
}

void BlockFactor::solve(Eigen::VectorXd& x) const {
  const std::size_t size = place_.size();
  double* const y = permuted_.data();
  for (std::size_t block = 0; block < size; ++block)
    block_of(y, index(place_[block])) = block_of(x.data(), block);
  for (std::size_t column = 0; column < size; ++column) {
    const Eigen::Matrix<double, kBlockSize, 1> known = block_of(y, column);
    for (std::size_t i = first_[column]; i < end(column); ++i)
      block_of(y, index(rows_[i])).noalias() -= below_[i] * known;
  }
  for (std::size_t column = size; column-- > 0;) {
    Eigen::Matrix<double, kBlockSize, 1> sum = inverse_[column] * block_of(y, column);
    for (std::size_t i = first_[column]; i < end(column); ++i)
      sum.noalias() -= below_[i].transpose() * block_of(y, index(rows_[i]));
    block_of(y, column) = sum;
  }
  for (std::size_t block = 0; block < size; ++block)
    block_of(x.data(), block) = block_of(y, index(place_[block]));
}

}  // namespace tread
