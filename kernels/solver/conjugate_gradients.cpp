#include "kernels/solver/conjugate_gradients.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "core/contract.hpp"
#include "core/error.hpp"
#include "core/parallel/chunks.hpp"

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

namespace {

/// Computes x += alpha p and r -= alpha q; returns <r, r>.
double advance(double alpha, const PageVector<double>& p, const PageVector<double>& q,
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

/// Computes p = z + beta p; of beta = 0 whatever p held.
void turn(double beta, const PageVector<double>& z, PageVector<double>& p) {
  for_chunks(static_cast<std::int64_t>(z.size()), [&](std::int64_t first, std::int64_t last) {
    for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(last); ++i)
      p[i] = beta == 0 ? z[i] : z[i] + beta * p[i];
  });
}

}  // namespace

CgResult conjugate_gradients(const Operator& a, const Preconditioner* preconditioner, const HeldMotions* held,
                             AlignedVector<double>& r, AlignedVector<double>& x, const CgOptions& options,
                             CgVectors& vectors) {
  TREAD_EXPECT(r.size() == x.size() && r.size() % kLanes == 0);
  const auto n = static_cast<std::int64_t>(r.size());
  auto& [p, w] = vectors;
  p.resize(r.size());
  w.resize(r.size());
  CgResult result;
  if (held) held->balance(r.data());
  double norm = std::sqrt(dot(n, r.data(), r.data()));
  if (!std::isfinite(norm)) throw NumericalError("static solver: the load is not a finite number");
  result.residual_history.push_back(norm);

  double rz = 0;
  while (norm > options.tolerance && result.iterations < options.max_iterations) {
    if (preconditioner)
      preconditioner->apply(r.data(), w.data());
    else
      std::copy(r.begin(), r.end(), w.begin());
    if (held) held->remove_mean(w.data());
    const double rz_before = rz;
    rz = dot(n, r.data(), w.data());
    turn(result.iterations == 0 ? 0 : rz / rz_before, w, p);
    a(p.data(), w.data());
    if (held) held->balance(w.data());
    const double curvature = dot(n, p.data(), w.data());
    constexpr double kNoStiffness = 1e-14;  // relative rounding: the preconditioner scales A to order one
    if (!(rz > 0) || !(curvature > kNoStiffness * rz))
      throw NumericalError(
          fmt::format("static solver: iteration {} met a motion without stiffness (energy {:.1e} against "
                      "{:.1e}); a body is "
                      "unrestrained: fix some of its nodes or hold its mean motion",
                      result.iterations, curvature, rz));
    norm = std::sqrt(advance(rz / curvature, p, w, x, r));
    result.residual_history.push_back(norm);
    ++result.iterations;
  }
  result.converged = norm <= options.tolerance;
  return result;
}

}  // namespace tread
