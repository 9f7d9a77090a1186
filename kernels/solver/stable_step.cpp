#include "kernels/solver/stable_step.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "core/page_vector.hpp"
#include "core/parallel/chunks.hpp"

namespace tread {

namespace {

/// Fills p with a vector of unit mass without structure. Any vector will do that is not orthogonal to the
/// wanted one.
void fill_without_structure(const AlignedVector<double>& inverse_mass, PageVector<double>& p) {
  const auto n = static_cast<std::int64_t>(p.size());
  const double size = std::sqrt(sum_chunks(n, [&](std::int64_t first, std::int64_t last) {
    double sum = 0;
    for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(last); ++i) {
      const auto hash = (static_cast<std::uint64_t>(i) + 1) * 0x9E3779B97F4A7C15ULL;
      const double q = inverse_mass[i] > 0 ? static_cast<double>(hash >> 11) / 9007199254740992.0 - 0.5 : 0.0;
      p[i] = std::sqrt(inverse_mass[i]) * q;
      sum += q * q;
    }
    return sum;
  }));
  if (size == 0) return;
  for_chunks(n, [&](std::int64_t first, std::int64_t last) {
    for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(last); ++i) p[i] /= size;
  });
}

}  // namespace

HighestFrequency highest_frequency(const Operator& a, const AlignedVector<double>& inverse_mass,
                                   int max_iterations) {
  const auto n = static_cast<std::int64_t>(inverse_mass.size());
  // In place of Lanczos' vectors q on M^-1/2 A M^-1/2 the loop keeps p = M^-1/2 q, which A takes unchanged.
  PageVector<double> p(inverse_mass.size());
  PageVector<double> previous(inverse_mass.size());
  PageVector<double> y(inverse_mass.size());
  fill_without_structure(inverse_mass, p);

  HighestFrequency best;
  Eigen::VectorXd diagonal(max_iterations);
  Eigen::VectorXd beside(max_iterations);
  double beta = 0;
  for (int k = 0; k < max_iterations; ++k) {
    a(p.data(), y.data());
    diagonal[k] = dot(n, p.data(), y.data());
    if (diagonal[k] == 0) return best;
    const double alpha = diagonal[k];
    const double before = beta;
    // The next p, not yet of unit mass, replaces the previous p.
    beta = std::sqrt(sum_chunks(n, [&](std::int64_t first, std::int64_t last) {
      double sum = 0;
      for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(last); ++i) {
        previous[i] = inverse_mass[i] * y[i] - alpha * p[i] - before * previous[i];
        if (inverse_mass[i] > 0) sum += previous[i] * previous[i] / inverse_mass[i];
      }
      return sum;
    }));
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
    p.swap(previous);
    for_chunks(n, [&](std::int64_t first, std::int64_t last) {
      for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(last); ++i) p[i] /= beta;
    });
  }
  return best;
}

double stable_step(double omega, double beta) {
  const double xi = 0.5 * beta * omega;
  return 2 / omega * (std::sqrt(1 + xi * xi) - xi);
}

}  // namespace tread
