#include "kernels/element/element_frequency.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "core/index.hpp"

namespace tread {

double largest_frequency(const ElementStiffness& stiffness, const std::array<double, 8>& nodal_volume,
                         double density) {
  using Matrix24 = Eigen::Matrix<double, 24, 24>;
  Matrix24 pencil;
  for (int row = 0; row < 24; ++row)
    for (int column = 0; column < 24; ++column)
      pencil(row, column) =
          stiffness[index(row)][index(column)] /
          (density * std::sqrt(nodal_volume[index(row / 3)] * nodal_volume[index(column / 3)]));
  const Eigen::SelfAdjointEigenSolver<Matrix24> solver(pencil, Eigen::EigenvaluesOnly);
  return std::sqrt(solver.eigenvalues()(23));
}

}  // namespace tread
