#include "kernels/material/branch_lag.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/parallel/chunks.hpp"

namespace tread {

template <class Real>
BranchLag<Real>::BranchLag(const Mesh& mesh, std::vector<std::optional<MaxwellBranch>> branches,
                           std::vector<std::optional<MaxwellBranch>> of_bodies)
    : mesh_(mesh),
      branches_(std::move(branches)),
      of_bodies_(std::move(of_bodies)),
      q_(static_cast<std::size_t>(3 * mesh.slots)) {}

template <class Real>
LagAdvance<Real> BranchLag<Real>::advance_of(const MaxwellBranch& branch, double dt) {
  return {static_cast<Real>(std::exp(-dt / branch.time)),
          static_cast<Real>(-branch.time * std::expm1(-dt / branch.time))};
}

template <class Real>
template <class Part>
void BranchLag<Real>::advance(const Part& part, const std::optional<MaxwellBranch>& branch, const Real* v,
                              double dt, std::int64_t first, std::int64_t last) {
  const std::int64_t from = std::max(first, part.base);
  const std::int64_t to = std::min(last, part.base + part.slots());
  if (!branch || from >= to) return;
  const LagAdvance<Real> advance = advance_of(*branch, dt);
  Real* const q = q_.data() + dof(from, 0);
  const Real* const of = v + dof(from, 0);
  for_chunks(3 * (to - from), [=](std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i) q[i] = advance.of(q[i], of[i]);
  });
}

template <class Real>
void BranchLag<Real>::advance(const Real* v, double dt, std::int64_t first, std::int64_t last) {
  for (std::size_t b = 0; b < branches_.size(); ++b)
    advance(mesh_.blocks[b], branches_[b], v, dt, first, last);
  for (std::size_t b = 0; b < of_bodies_.size(); ++b)
    advance(mesh_.bodies[b], of_bodies_[b], v, dt, first, last);
}

template class BranchLag<double>;
template class BranchLag<float>;

}  // namespace tread
