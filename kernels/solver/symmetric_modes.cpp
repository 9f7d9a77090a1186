#include "kernels/solver/symmetric_modes.hpp"

#include <Eigen/Dense>

namespace tread {

namespace {

using ReadColumns = Eigen::Map<const Eigen::MatrixXd>;

}  // namespace

std::vector<double> SymmetricModes::components(const std::vector<double>& all) const {
  const auto n = static_cast<Eigen::Index>(size());
  const auto count = static_cast<Eigen::Index>(all.size()) / n;
  std::vector<double> out(all.size());
  Eigen::Map<Eigen::MatrixXd>(out.data(), n, count).noalias() =
      ReadColumns(vectors.data(), n, n).transpose() * ReadColumns(all.data(), n, count);
  return out;
}

SymmetricModes symmetric_modes(const std::vector<double>& matrix, std::size_t n) {
  const auto size = static_cast<Eigen::Index>(n);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(ReadColumns(matrix.data(), size, size));
  const Eigen::MatrixXd& vectors = solver.eigenvectors();
  return {{solver.eigenvalues().begin(), solver.eigenvalues().end()},
          {vectors.data(), vectors.data() + vectors.size()}};
}

}  // namespace tread
