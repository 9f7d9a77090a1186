#include "kernels/stable_step.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "kernels/solver/chunks.hpp"

namespace tread {

HighestFrequency highest_frequency(const Operator& a, const AlignedVector<double>& inverse_mass,
                                   int max_iterations) {
  const auto n = static_cast<std::int64_t>(inverse_mass.size());
  AlignedVector<double> root(inverse_mass.size());
  AlignedVector<double> q(inverse_mass.size(), 0.0);
  AlignedVector<double> previous(inverse_mass.size(), 0.0);
  AlignedVector<double> x(inverse_mass.size());
  AlignedVector<double> y(inverse_mass.size());
  for_chunks(n, [&](std::int64_t first, std::int64_t last) {
    for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(last); ++i) {
      root[i] = std::sqrt(inverse_mass[i]);
      // A start without structure; any one that is not orthogonal to the wanted vector will do.
      const auto hash = (static_cast<std::uint64_t>(i) + 1) * 0x9E3779B97F4A7C15ULL;
      q[i] = root[i] > 0 ? static_cast<double>(hash >> 11) / 9007199254740992.0 - 0.5 : 0.0;
    }
  });
  const double start = std::sqrt(dot(n, q.data(), q.data()));
  HighestFrequency best;
  if (start == 0) return best;
  for (double& value : q) value /= start;

  Eigen::VectorXd diagonal(max_iterations);
  Eigen::VectorXd beside(max_iterations);
  double beta = 0;
  for (int k = 0; k < max_iterations; ++k) {
    for_chunks(n, [&](std::int64_t first, std::int64_t last) {
      for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(last); ++i)
        x[i] = root[i] * q[i];
    });
    a(x.data(), y.data());
    for_chunks(n, [&](std::int64_t first, std::int64_t last) {
      for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(last); ++i)
        y[i] = root[i] * y[i] - beta * previous[i];
    });
    diagonal[k] = dot(n, q.data(), y.data());
    add_scaled(n, -diagonal[k], q.data(), y.data());
    beta = std::sqrt(dot(n, y.data(), y.data()));
    beside[k] = beta;

    const bool last_one = k + 1 == max_iterations || beta < 1e-14 * diagonal[0];
    if (k % 10 == 9 || last_one) {
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
      solver.computeFromTridiagonal(diagonal.head(k + 1), beside.head(k));
      const double theta = solver.eigenvalues()[k];
      const double residual = beta * std::abs(solver.eigenvectors()(k, k));
      best = {std::sqrt(theta + residual), residual / theta, k + 1};
      if (best.residual < 1e-3 || last_one) return best;
    }
    for_chunks(n, [&](std::int64_t first, std::int64_t last) {
      for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(last); ++i) {
        previous[i] = q[i];
        q[i] = y[i] / beta;
      }
    });
  }
  return best;
}

double stable_step(double omega, double beta) {
  const double xi = 0.5 * beta * omega;
  return 2 / omega * (std::sqrt(1 + xi * xi) - xi);
}

}  // namespace tread
