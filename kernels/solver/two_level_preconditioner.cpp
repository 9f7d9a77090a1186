#include "kernels/solver/two_level_preconditioner.hpp"

#include <Eigen/Eigenvalues>
#include <chrono>
#include <cmath>

#include "core/error.hpp"
#include "kernels/solver/chunks.hpp"

namespace tread {

namespace {
AlignedVector<double> mask_of(const AlignedVector<double>& diagonal) {
  AlignedVector<double> free(diagonal.size());
  for (std::size_t i = 0; i < free.size(); ++i) free[i] = diagonal[i] > 0 ? 1 : 0;
  return free;
}

/// Largest eigenvalue of D^-1 A by Lanczos
double estimate(const Operator& a, const AlignedVector<double>& inverse, int steps) {
  const auto n = static_cast<std::int64_t>(inverse.size());
  AlignedVector<double> r(inverse.size()), z(r.size()), p(r.size(), 0.0), q(r.size());
  for (std::size_t i = 0; i < r.size(); ++i)
    r[i] = inverse[i] > 0 ? std::sin(1.0 + 0.7 * static_cast<double>(i % 100003) * static_cast<double>(i % 1009)) / std::sqrt(inverse[i]) : 0;
  std::vector<double> diag, off;
  double rz = 0, alpha = 0;
  for (int k = 0; k < steps; ++k) {
    for (std::size_t i = 0; i < r.size(); ++i) z[i] = inverse[i] * r[i];
    const double before = rz;
    rz = dot(n, r.data(), z.data());
    const double beta = k ? rz / before : 0;
    for (std::size_t i = 0; i < r.size(); ++i) p[i] = z[i] + beta * p[i];
    a(p.data(), q.data());
    const double pq = dot(n, p.data(), q.data());
    if (!(pq > 0)) break;
    const double alpha_before = alpha;
    alpha = rz / pq;
    diag.push_back(1 / alpha + (k ? beta / alpha_before : 0));
    if (k) off.push_back(std::sqrt(beta) / alpha_before);
    add_scaled(n, -alpha, q.data(), r.data());
  }
  Eigen::MatrixXd t = Eigen::MatrixXd::Zero(diag.size(), diag.size());
  for (std::size_t i = 0; i < diag.size(); ++i) {
    t(i, i) = diag[i];
    if (i) t(i, i - 1) = t(i - 1, i) = off[i - 1];
  }
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(t).eigenvalues().maxCoeff();
}
}  // namespace

TwoLevelPreconditioner::TwoLevelPreconditioner(const Mesh& mesh, Operator a, const AlignedVector<double>& diagonal,
                         const std::vector<TiedSlot>& ties, const TwoLevelOptions& options)
  : options_(options), diagonal_(diagonal), aggregates_(mesh, mask_of(diagonal), options.aggregates),
    coarse_(aggregates_, aggregate_graph(mesh, aggregates_, ties), a, diagonal.size()), a_(a), inverse_(diagonal.size()), res_(diagonal.size()),
    p_(diagonal.size()), q_(diagonal.size()), rc_(aggregates_.modes()) {
}

void TwoLevelPreconditioner::update(Operator a, const std::vector<Spring>& springs) {
  a_ = a;
  AlignedVector<double> d = diagonal_;
  for (const auto& s : springs) {
    double sum = 0;
    for (double w : s.weights) sum += std::abs(w);
    for (std::size_t i = 0; i < s.dofs.size(); ++i) d[s.dofs[i]] += s.stiffness * sum * std::abs(s.weights[i]);
  }
  for (std::size_t i = 0; i < d.size(); ++i) inverse_[i] = diagonal_[i] > 0 ? 1 / d[i] : 0;
  coarse_.factorise(aggregates_, springs);
  lambda_max_ = 1.05 * estimate(a_, inverse_, 15);
}

void TwoLevelPreconditioner::correct(const double* r, double* z) const {
  const auto t0 = std::chrono::steady_clock::now();
  aggregates_.restrict_to_modes(r, rc_.data());
  coarse_.solve(rc_.data(), rc_.data());
  aggregates_.prolongate_add(rc_.data(), z);
  t_coarse += std::chrono::duration<double>(std::chrono::steady_clock::now() - t0).count();
}

// z += S r, r -= A S r if wanted
void TwoLevelPreconditioner::smooth(double* r, double* z, bool want) const {
  const double hi = lambda_max_, lo = hi / options_.spread;
  const double theta = (hi + lo) / 2, delta = (hi - lo) / 2, sigma = theta / delta;
  double rho = 1 / sigma;
  const auto n = static_cast<std::int64_t>(inverse_.size());
  for (int k = 0; k < options_.degree; ++k) {
    double c1 = 0, c2 = 1 / theta;
    if (k) {
      const double next = 1 / (2 * sigma - rho);
      c1 = next * rho; c2 = 2 * next / delta;
      rho = next;
    }
    for_chunks(n, [&](std::int64_t first, std::int64_t last) {
      for (std::int64_t i = first; i < last; ++i) {
        if (k) { r[i] -= q_[i]; p_[i] = c1 * p_[i] + c2 * inverse_[i] * r[i]; }
        else p_[i] = c2 * inverse_[i] * r[i];
        z[i] += p_[i];
      }
    });
    if (k + 1 < options_.degree || want) a_(p_.data(), q_.data());
  }
  if (want) add_scaled(n, -1, q_.data(), r);
}

void TwoLevelPreconditioner::apply(const double* r, double* z) const {
  const auto n = static_cast<std::int64_t>(inverse_.size());
  std::copy(r, r + n, res_.begin());
  std::fill(z, z + n, 0.0);
  if (options_.cycle == Cycle::additive) {
    smooth(res_.data(), z, false);
    correct(r, z);
  } else if (options_.cycle == Cycle::adef2) {
    smooth(res_.data(), z, true);
    correct(res_.data(), z);
  } else {
    smooth(res_.data(), z, true);
    std::fill(p_.begin(), p_.end(), 0.0);
    correct(res_.data(), p_.data());
    add_scaled(n, 1, p_.data(), z);
    a_(p_.data(), q_.data());
    add_scaled(n, -1, q_.data(), res_.data());
    smooth(res_.data(), z, false);
  }
}
void TwoLevelPreconditioner::start(const double* r, double* x) const { correct(r, x); }

}  // namespace tread
