#include "kernels/solver/conjugate_gradients.hpp"

#include <fmt/core.h>

#include <Eigen/Dense>
#include <cmath>

#include "core/error.hpp"
#include "kernels/solver/chunks.hpp"

namespace tread {

JacobiPreconditioner::JacobiPreconditioner(const AlignedVector<double>& diagonal)
    : inverse_(diagonal.size()) {
  for (std::size_t i = 0; i < diagonal.size(); ++i) inverse_[i] = diagonal[i] > 0 ? 1 / diagonal[i] : 0;
}

void JacobiPreconditioner::apply(const double* r, double* z) const {
  for_chunks(static_cast<std::int64_t>(inverse_.size()), [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i) z[i] = inverse_[static_cast<std::size_t>(i)] * r[i];
  });
}

HeldMotions::HeldMotions(std::vector<AlignedVector<double>> motions, std::vector<AlignedVector<double>> means)
    : motions_(std::move(motions)) {
  const auto count = static_cast<Eigen::Index>(motions_.size());
  const auto n = static_cast<std::int64_t>(motions_.empty() ? 0 : motions_[0].size());
  Eigen::MatrixXd product(count, count);
  for (Eigen::Index i = 0; i < count; ++i)
    for (Eigen::Index j = 0; j < count; ++j)
      product(i, j) =
          dot(n, motions_[static_cast<std::size_t>(i)].data(), means[static_cast<std::size_t>(j)].data());
  const Eigen::FullPivLU<Eigen::MatrixXd> factor(product);
  if (!factor.isInvertible())
    throw NumericalError("static solver: a held motion has no mean; its nodes are fixed or it is held twice");
  const Eigen::MatrixXd inverse = factor.inverse();
  means_.assign(motions_.size(), AlignedVector<double>(static_cast<std::size_t>(n), 0.0));
  for (Eigen::Index i = 0; i < count; ++i)
    for (Eigen::Index j = 0; j < count; ++j)
      add_scaled(n, inverse(i, j), means[static_cast<std::size_t>(i)].data(),
                 means_[static_cast<std::size_t>(j)].data());
}

void HeldMotions::balance(double* r) const {
  const auto amount = work(r);
  for (std::size_t i = 0; i < count(); ++i)
    add_scaled(static_cast<std::int64_t>(means_[i].size()), -amount[i], means_[i].data(), r);
}

void HeldMotions::remove_mean(double* x) const {
  std::vector<double> amount(count());
  for (std::size_t i = 0; i < count(); ++i)
    amount[i] = dot(static_cast<std::int64_t>(means_[i].size()), means_[i].data(), x);
  for (std::size_t i = 0; i < count(); ++i)
    add_scaled(static_cast<std::int64_t>(motions_[i].size()), -amount[i], motions_[i].data(), x);
}

std::vector<double> HeldMotions::work(const double* r) const {
  std::vector<double> amount(count());
  for (std::size_t i = 0; i < count(); ++i)
    amount[i] = dot(static_cast<std::int64_t>(motions_[i].size()), motions_[i].data(), r);
  return amount;
}

namespace {

/// out = b - A x, not balanced.
void residual(const Operator& a, const AlignedVector<double>& b, const AlignedVector<double>& x,
              AlignedVector<double>& out) {
  a(x.data(), out.data());
  for_chunks(static_cast<std::int64_t>(b.size()), [&](std::int64_t first, std::int64_t last) {
    for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(last); ++i)
      out[i] = b[i] - out[i];
  });
}

/// x += alpha p, r -= alpha q; returns <r, r>.
double advance(double alpha, const AlignedVector<double>& p, const AlignedVector<double>& q,
               AlignedVector<double>& x, AlignedVector<double>& r) {
  return sum_chunks(static_cast<std::int64_t>(p.size()), [&](std::int64_t first, std::int64_t last) {
    double lane[8] = {};
    for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(last); i += 8)
      for (std::size_t l = 0; l < 8; ++l) {
        x[i + l] += alpha * p[i + l];
        r[i + l] -= alpha * q[i + l];
        lane[l] += r[i + l] * r[i + l];
      }
    return ((lane[0] + lane[4]) + (lane[1] + lane[5])) + ((lane[2] + lane[6]) + (lane[3] + lane[7]));
  });
}

/// p = z + beta p
void turn(double beta, const AlignedVector<double>& z, AlignedVector<double>& p) {
  for_chunks(static_cast<std::int64_t>(z.size()), [&](std::int64_t first, std::int64_t last) {
    for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(last); ++i)
      p[i] = z[i] + beta * p[i];
  });
}

}  // namespace

CgResult conjugate_gradients(const Operator& a, const Preconditioner* preconditioner, const HeldMotions* held,
                             const AlignedVector<double>& b, AlignedVector<double>& x,
                             const CgOptions& options) {
  const auto n = static_cast<std::int64_t>(b.size());
  AlignedVector<double> r = b, p(b.size(), 0.0), q(b.size()), z(b.size());
  CgResult result;
  const auto finish = [&](double scale) {
    residual(a, b, x, r);
    if (held) {
      result.reactions = held->work(r.data());
      held->balance(r.data());
    }
    const double norm = std::sqrt(dot(n, r.data(), r.data()));
    result.relative_residual = scale > 0 ? norm / scale : 0;
    return result;
  };

  if (held) held->balance(r.data());
  const double scale = std::sqrt(dot(n, r.data(), r.data()));
  if (!std::isfinite(scale)) throw NumericalError("static solver: the load is not a finite number");
  if (held) held->remove_mean(x.data());
  if (scale == 0) {
    std::fill(x.begin(), x.end(), 0.0);
    result.converged = true;
    return finish(scale);
  }
  residual(a, b, x, r);
  if (held) held->balance(r.data());

  double rz = 0;
  double relative = std::sqrt(dot(n, r.data(), r.data())) / scale;
  result.residual_history.push_back(relative);
  while (relative > options.relative_tolerance && result.iterations < options.max_iterations) {
    if (preconditioner)
      preconditioner->apply(r.data(), z.data());
    else
      z = r;
    if (held) held->remove_mean(z.data());
    const double rz_before = rz;
    rz = dot(n, r.data(), z.data());
    turn(result.iterations == 0 ? 0 : rz / rz_before, z, p);
    a(p.data(), q.data());
    if (held) held->balance(q.data());
    const double curvature = dot(n, p.data(), q.data());
    constexpr double kNoStiffness = 1e-14;  // rounding, seen from a preconditioner that scales A to order one
    if (!(rz > 0) || !(curvature > kNoStiffness * rz))
      throw NumericalError(
          fmt::format("static solver: iteration {} met a motion without stiffness (energy {:.1e} against "
                      "{:.1e}); a body is "
                      "unrestrained: fix some of its nodes or hold its mean motion",
                      result.iterations, curvature, rz));
    relative = std::sqrt(advance(rz / curvature, p, q, x, r)) / scale;
    result.residual_history.push_back(relative);
    ++result.iterations;
  }
  result.converged = relative <= options.relative_tolerance;
  return finish(scale);
}

}  // namespace tread
