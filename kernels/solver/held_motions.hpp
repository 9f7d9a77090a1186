#pragma once
// Rigid motions of free bodies that a static solution leaves out, held in the mass-weighted mean.

#include <cstdint>
#include <vector>

#include "core/mesh/swept_block.hpp"
#include "kernels/solver/rigid_motion.hpp"

namespace tread {

/// Motions R_i along which the mean <M R_j, x> of the solution is zero, and the forces M R_j lambda_j that
/// hold them: A x = b - M R lambda with R^T M x = 0. R is the body's motion where it has mass and zero
/// elsewhere.
class HeldMotions {
 public:
  /// Held motions of a mesh's `blocks` and spinning bodies together, about the origin; references to both are
  /// kept. `mass`: lumped, scalar node field, zero at nodes that are not free [kg]. The motions move no
  /// restrained unknown. Throws NumericalError if some mean does not see its motion (R^T M R singular).
  HeldMotions(const Mesh& mesh, const std::vector<int>& blocks, const double* mass,
              std::vector<RigidMotion> motions);

  std::size_t count() const { return motions_.size(); }

  /// Computes r -= M R (R^T M R)^-1 R^T r. The remainder does no work on the motions.
  void balance(double* r) const;
  /// Computes x -= R (R^T M R)^-1 R^T M x. The remainder has zero means.
  void remove_mean(double* x) const;
  /// Work of r on each unit motion R_i. For r = b - A x these are the holding forces [N or N m].
  std::vector<double> work(const double* r) const;

 private:
  struct Item {
    const SweptBlock* block;
    int tile;
    std::size_t first_station;  ///< index in stations_
  };
  RigidMotion resultant(const double* field, bool weighted) const;
  void add(const RigidMotion& motion, bool weighted, double* field) const;
  RigidMotion combined(const std::vector<double>& work) const;

  const Mesh* mesh_;
  const double* mass_;
  std::vector<RigidMotion> motions_;
  std::vector<double> inverse_;  ///< inverse of R^T M R: [i][j]
  std::vector<Item> items_;
  std::vector<StationPlace> stations_;
  mutable std::vector<RigidMotion> partial_;  ///< buffer by item
};

}  // namespace tread
