#pragma once
// Sums over all nodes in the energy balance, at the speed of memory.

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/mesh/node_field.hpp"
#include "core/mesh/tile_sums.hpp"
#include "drivers/engine/model/model.hpp"

namespace tread {

/// `share`: the tiles whose values this process has; null: all.
class EnergySums {
 public:
  /// Keeps a reference. `unforced`: unknowns that forces do not move, but for those that a vertical-only
  /// block lacks.
  EnergySums(const Model& model, std::vector<std::int64_t> unforced)
      : model_(&model),
        all_(blocks_where(model.mesh, [](const SweptBlock& /*block*/) { return true; })),
        fixed_(blocks_where(model.mesh, [](const SweptBlock& b) { return b.sweep == Sweep::extruded; })),
        unforced_(std::move(unforced)) {
    std::sort(unforced_.begin(), unforced_.end());
  }

  const std::vector<int>& all_blocks() const { return all_; }
  const std::vector<std::int64_t>& unforced() const { return unforced_; }

  /// Kinetic energy of the bodies that do not travel: v^T M v / 2. `v`: vector field [m/s]; result [J].
  double fixed_kinetic_energy(ConstNodeField v, const TileShare* share) const;

  /// Gravity potential of the bodies that do not travel: g sum(m u_z). `u`: vector field [m]; result [J].
  double fixed_gravity_potential(ConstNodeField u, const TileShare* share) const;

  /// The mean of both half steps' kinetic energies exceeds v- . M v+ / 2, which central difference conserves
  /// together with the strain energy, by dt^2 / 4 F . M^-1 F [J]. `force`: vector field [N].
  double half_step_excess(ConstNodeField force, double dt, const TileShare* share) const;

 private:
  /// Mass times `term` of the components from the first on, over all that does not travel.
  template <class Term>
  double sum_of_fixed(int first_component, ConstNodeField field, const TileShare* share,
                      const Term& term) const;
  const SweptBlock& swept(int block) const { return model_->mesh.blocks[static_cast<std::size_t>(block)]; }

  const Model* model_;
  std::vector<int> all_, fixed_;
  std::vector<std::int64_t> unforced_;  ///< ascending
};

}  // namespace tread
