#include "kernels/harmonics/harmonic_system.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/index.hpp"
#include "kernels/solver/symmetric_modes.hpp"

namespace tread {

HarmonicSystem::HarmonicSystem(const HarmonicMatrices& m, int waves) {
  const double turn = waves == 0 ? m.whole : 0.5 * m.whole;
  mass = turn * m.mass;
  if (waves == 1) mass += m.carried;
  turning = turn * (m.turning[0] + waves * m.turning[1]);
  const double square = static_cast<double>(waves) * waves;
  const HarmonicMatrix stiffness = turn * (m.stiffness[0] + waves * m.stiffness[1] + square * m.stiffness[2]);
  factor.compute(stiffness + kHarmonicShift * mass);
  if (factor.info() != Eigen::Success)
    throw NumericalError("the system of a harmonic of wheelset or rail cannot be factorised");
}

HarmonicRitz::HarmonicRitz(const HarmonicSystem& system, const std::vector<double>& nodal, int vectors) {
  const auto unknowns = static_cast<Eigen::Index>(nodal.size());
  const Eigen::Map<const Eigen::VectorXd> load(nodal.data(), unknowns);
  // Lanczos on A^-1 M in the inner product of M, orthogonalised against all vectors.
  Eigen::MatrixXd basis(unknowns, vectors);
  Eigen::MatrixXd projected = Eigen::MatrixXd::Zero(vectors, vectors);
  Eigen::VectorXd next = system.factor.solve(load);
  const double first = std::sqrt(next.dot(system.mass * next));
  double length = first;
  int count = 0;
  for (; count < vectors; ++count) {
    if (length <= 1e-14 * first) break;
    basis.col(count) = next / length;
    next = system.factor.solve(system.mass * basis.col(count));
    for (int pass = 0; pass < 2; ++pass) {
      const Eigen::VectorXd weighted = system.mass * next;
      const Eigen::VectorXd along = basis.leftCols(count + 1).transpose() * weighted;
      next -= basis.leftCols(count + 1) * along;
      projected.col(count).head(count + 1) += along;
    }
    length = std::sqrt(std::max(0.0, next.dot(system.mass * next)));
  }
  const Eigen::MatrixXd square = projected.topLeftCorner(count, count).selfadjointView<Eigen::Upper>();
  const SymmetricModes modes = symmetric_modes({square.data(), square.data() + square.size()}, index(count));
  decay = Eigen::Map<const Eigen::VectorXd>(modes.values.data(), count);
  const Eigen::Map<const Eigen::MatrixXd> turned(modes.vectors.data(), count, count);
  const Eigen::VectorXd excited = first * turned.row(0).transpose();
  shapes = basis.leftCols(count) * turned;
  weight = (shapes.transpose() * load).cwiseProduct(excited);
}

}  // namespace tread
