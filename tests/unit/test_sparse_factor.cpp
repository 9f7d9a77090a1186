// L D L^T solved by subtrees.

#include <gtest/gtest.h>

#include <vector>

#include "core/index.hpp"
#include "core/parallel/parallel.hpp"
#include "kernels/solver/sparse_factor.hpp"

namespace tread {
namespace {

using Matrix = SparseFactor::Matrix;

/// Springs between neighbours of a grid, to ground at each node; `far`: of one between opposite corners.
Matrix grid(int columns, int rows, double far) {
  std::vector<Eigen::Triplet<double>> entries;
  const auto join = [&](int a, int b, double stiffness) {
    entries.emplace_back(a, a, stiffness);
    entries.emplace_back(b, b, stiffness);
    entries.emplace_back(std::max(a, b), std::min(a, b), -stiffness);
  };
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const int node = row * columns + column;
      entries.emplace_back(node, node, 0.01);
      if (column > 0) join(node - 1, node, 1 + 0.1 * row);
      if (row > 0) join(node - columns, node, 2 + 0.1 * column);
    }
  if (far > 0) join(0, rows * columns - 1, far);
  Matrix matrix(rows * columns, rows * columns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

/// Largest difference of what is found from what is wanted.
double error_of(const SparseFactor& factor, const Matrix& matrix) {
  const Eigen::VectorXd wanted = Eigen::VectorXd::LinSpaced(matrix.rows(), -1, 2).array().sin();
  Eigen::VectorXd x = matrix.selfadjointView<Eigen::Lower>() * wanted;
  factor.solve(x.data(), x.data());
  return (x - wanted).cwiseAbs().maxCoeff();
}

TEST(SparseFactor, SolvesFromOneRowToManySubtrees) {
  for (const auto& [columns, rows] : {std::pair(1, 1), {2, 1}, {7, 3}, {60, 45}, {3000, 2}}) {
    const Matrix matrix = grid(columns, rows, 0);
    SparseFactor factor;
    ASSERT_TRUE(factor.compute(matrix));
    EXPECT_LT(error_of(factor, matrix), 1e-8) << columns << " x " << rows;
  }
}

/// Bodies that nothing couples have trees of their own.
TEST(SparseFactor, SolvesSeparateParts) {
  Matrix matrix(5000, 5000);
  matrix.setIdentity();
  matrix.coeffRef(4999, 0) = 0.5;
  SparseFactor factor;
  ASSERT_TRUE(factor.compute(matrix));
  EXPECT_LT(error_of(factor, matrix), 1e-12);
}

TEST(SparseFactor, KeepsItsOrderForOtherValuesAndCouplings) {
  SparseFactor factor;
  ASSERT_TRUE(factor.compute(grid(60, 45, 0)));
  for (const double far : {5.0, 0.0, 2.0}) {
    ASSERT_TRUE(factor.compute(grid(60, 45, far)));
    EXPECT_LT(error_of(factor, grid(60, 45, far)), 1e-8) << far;
  }
  ASSERT_TRUE(factor.compute(grid(9, 9, 1)));
  EXPECT_LT(error_of(factor, grid(9, 9, 1)), 1e-8);
}

TEST(SparseFactor, HasTheSameBitsForAnyNumberOfThreads) {
  const Matrix matrix = grid(60, 45, 1);
  std::vector<std::vector<double>> found;
  for (const int count : {1, 2, 5}) {
    set_threads(count);
    SparseFactor factor;
    ASSERT_TRUE(factor.compute(matrix));
    std::vector<double>& x = found.emplace_back(index(matrix.rows()), 1.0);
    factor.solve(x.data(), x.data());
  }
  set_threads(1);
  EXPECT_EQ(found[0], found[1]);
  EXPECT_EQ(found[0], found[2]);
}

TEST(SparseFactor, RefusesAMatrixWithoutStiffness) {
  Matrix matrix(3, 3);
  matrix.insert(0, 0) = 1;
  matrix.insert(1, 1) = 0;
  matrix.insert(2, 2) = 1;
  EXPECT_FALSE(SparseFactor().compute(matrix));
}

}  // namespace
}  // namespace tread
