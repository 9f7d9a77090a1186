#include "kernels/material/branch_lag.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/parallel/chunks.hpp"

namespace tread {

template <class Real>
BranchLag<Real>::BranchLag(const Mesh& mesh, std::vector<std::optional<MaxwellBranch>> branches)
    : mesh_(mesh), branches_(std::move(branches)), q_(static_cast<std::size_t>(3 * mesh.slots)) {}

template <class Real>
LagAdvance<Real> BranchLag<Real>::advance_of(int block, double dt) const {
  const double time = branches_[static_cast<std::size_t>(block)]->time;
  return {static_cast<Real>(std::exp(-dt / time)), static_cast<Real>(-time * std::expm1(-dt / time))};
}

template <class Real>
void BranchLag<Real>::advance(const Real* v, double dt, std::int64_t first, std::int64_t last) {
  for (std::size_t b = 0; b < branches_.size(); ++b) {
    const SweptBlock& block = mesh_.blocks[b];
    const std::int64_t from = std::max(first, block.base);
    const std::int64_t to = std::min(last, block.base + block.slots());
    if (!branches_[b] || from >= to) continue;
    const LagAdvance<Real> advance = advance_of(static_cast<int>(b), dt);
    Real* const q = q_.data() + dof(from, 0);
    const Real* const of = v + dof(from, 0);
    for_chunks(3 * (to - from), [=](std::int64_t begin, std::int64_t end) {
      for (std::int64_t i = begin; i < end; ++i) q[i] = advance.of(q[i], of[i]);
    });
  }
}

template class BranchLag<double>;
template class BranchLag<float>;

}  // namespace tread
