#pragma once
// The inner variable of Maxwell branches: by node, for the elasticity of a block is linear and its branches
// have one time of relaxation. [theory.md, Maxwell branch]

#include <cstdint>
#include <optional>
#include <vector>

#include "core/inline.hpp"
#include "core/material.hpp"
#include "core/mesh/swept_block.hpp"
#include "core/page_vector.hpp"

namespace tread {

/// Over a step a block's lag is kept q + gained v.
template <class Real>
struct LagAdvance {
  Real kept;
  Real gained;  ///< [s]
  TREAD_INLINE Real of(Real q, Real v) const { return kept * q + gained * v; }
};

/// Lag: the way of a node beyond the dashpots of its branches, dq/dt = v - q / tau [m]; zero in blocks
/// without branches. Precision as that of velocities.
template <class Real>
class BranchLag {
 public:
  /// Keeps a reference to the mesh. `branches`: by block; `of_bodies`: by body. At rest.
  BranchLag(const Mesh& mesh, std::vector<std::optional<MaxwellBranch>> branches,
            std::vector<std::optional<MaxwellBranch>> of_bodies = {});

  /// Exact over a step of dt [s] with the velocity v [m/s], a vector field.
  void advance(const Real* v, double dt) { advance(v, dt, 0, mesh_.slots); }
  /// The same for the slots [first, last) alone.
  void advance(const Real* v, double dt, std::int64_t first, std::int64_t last);

  /// For a block that has a branch.
  LagAdvance<Real> advance_of(int block, double dt) const {
    return advance_of(*branches_[static_cast<std::size_t>(block)], dt);
  }

  /// Vector field of 3 * mesh.slots values [m].
  const Real* data() const { return q_.data(); }
  PageVector<Real>& values() { return q_; }
  const std::optional<MaxwellBranch>& branch(int block) const {
    return branches_[static_cast<std::size_t>(block)];
  }

 private:
  static LagAdvance<Real> advance_of(const MaxwellBranch& branch, double dt);
  /// The same for those of the slots that are a part's.
  template <class Part>
  void advance(const Part& part, const std::optional<MaxwellBranch>& branch, const Real* v, double dt,
               std::int64_t first, std::int64_t last);

  const Mesh& mesh_;
  std::vector<std::optional<MaxwellBranch>> branches_, of_bodies_;
  PageVector<Real> q_;
};

extern template class BranchLag<double>;
extern template class BranchLag<float>;

}  // namespace tread
