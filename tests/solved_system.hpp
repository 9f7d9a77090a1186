#pragma once
// A linear system solved by conjugate gradients, and the residual of its solution.

#include <cmath>
#include <vector>

#include "core/parallel/chunks.hpp"
#include "kernels/solver/conjugate_gradients.hpp"

namespace tread::samples {

struct SolvedSystem {
  CgResult result;
  int iterations = 0;
  double relative_residual = 0;   ///< residual of the solution, balanced, against the balanced right side
  std::vector<double> reactions;  ///< HeldMotions::work(b - A x)
};

/// Residual b - A x.
inline AlignedVector<double> residual_of(const Operator& a, const AlignedVector<double>& b,
                                         AlignedVector<double> x) {
  AlignedVector<double> r(b.size());
  a(x.data(), r.data());
  for (std::size_t i = 0; i < b.size(); ++i) r[i] = b[i] - r[i];
  return r;
}

/// Solves A x = b from the given x to a tolerance relative to the balanced b.
inline SolvedSystem solve_system(const Operator& a, const Preconditioner* preconditioner,
                                 const HeldMotions* held, const AlignedVector<double>& b,
                                 AlignedVector<double>& x, const CgOptions& relative) {
  const auto size = [&](AlignedVector<double>& r) {
    if (held) held->balance(r.data());
    return std::sqrt(dot(static_cast<std::int64_t>(r.size()), r.data(), r.data()));
  };
  AlignedVector<double> right = b;
  const double scale = size(right);
  SolvedSystem solved;
  CgVectors vectors;
  AlignedVector<double> r = residual_of(a, b, x);
  solved.result = conjugate_gradients(a, preconditioner, held, r, x,
                                      {relative.tolerance * scale, relative.max_iterations}, vectors);
  solved.iterations = solved.result.iterations;
  r = residual_of(a, b, x);
  if (held) solved.reactions = held->work(r.data());
  solved.relative_residual = size(r) / scale;
  return solved;
}

}  // namespace tread::samples
