#pragma once
// Arrays of marches in the memory of a device: motion, lag and states of laws before and after a
// step, masses and forces.

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/index.hpp"
#include "kernels/blocks/internal_force.hpp"
#include "kernels/device/march_fan.hpp"
#include "kernels/material/branch_lag.hpp"
#include "kernels/material/laws.hpp"

namespace tread {

template <class Real, class U>
class MarchArrays {
 public:
  /// Fields that a step reads, and where it writes those that elements of several teams read.
  struct Motion {
    DeviceArray<U> u;
    DeviceArray<Real> v;
    std::vector<DeviceArray<Real>> state;  ///< by block; empty where its law has none
  };

  /// Keeps references. `branch_lag`: the host's, if any. `inverse_mass`: by slot [1/kg].
  MarchArrays(Device& device, const Mesh& mesh, const BasicInternalForce<Real, U>& internal,
              const std::optional<BranchLag<Real>>& branch_lag, const Real* inverse_mass)
      : kernels_(&device.kernels<Real, U>()),
        internal_(&internal),
        branch_lag_(&branch_lag),
        blocks_(&mesh.blocks),
        force_(device, index(3 * mesh.slots)),
        inverse_mass_(device, std::span(inverse_mass, index(mesh.slots))) {
    for (Motion* motion : {&now, &next}) {
      motion->u = DeviceArray<U>(device, force_.size());
      motion->v = DeviceArray<Real>(device, force_.size());
      for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
        const SweptBlock& block = mesh.blocks[b];
        const int values = state_values(internal.law(static_cast<int>(b)));
        motion->state.emplace_back(device,
                                   block.tiles.size() * block.section.quads.size() * kLanes * index(values));
      }
    }
    if (branch_lag) lag = DeviceArray<Real>(device, force_.size());
  }

  /// The march over a block. `marks`: by group of kLanes slots; teams that read a node of the host await it.
  std::unique_ptr<BlockMarch<Real>> march(Device& device, int block, std::span<const int> marks) const {
    return std::make_unique<BlockMarch<Real>>(device, internal_->elements(block), internal_->damping(block),
                                              marks);
  }
  TileVariant variant(int block) const {
    const SweptBlock& of = (*blocks_)[index(block)];
    return {of.sweep, internal_->damping(block) != 0, internal_->finite_rotation(block), of.vertical_only,
            internal_->law(block)};
  }

  /// Arrays of a step from `now` to `next`. `marks`, `held`, `host_force`: as in MarchFields.
  MarchFields<Real, U> fields(int block, const int* marks, const unsigned char* held, Real* host_force) {
    MarchFields<Real, U> fields;
    fields.u = now.u.data();
    fields.v = now.v.data();
    if (internal_->damping(block) != 0)
      fields.added = internal_->branch(block) != 0 ? lag.data() : now.v.data();
    fields.inverse_mass = inverse_mass_.data();
    fields.moved_u = next.u.data();
    fields.moved_v = next.v.data();
    fields.force = force_.data();
    fields.group_mark = marks;
    fields.held = held;
    fields.host_force = host_force;
    fields.state = now.state[index(block)].data();
    fields.moved_state = next.state[index(block)].data();
    return fields;
  }

  /// The lag of the slots [first, last), whole groups, follows the velocity of a step of dt [s].
  void advance_lag(double dt, std::int64_t first, std::int64_t last) {
    for (std::size_t b = 0; b < blocks_->size(); ++b) {
      if (!(*branch_lag_)->branch(static_cast<int>(b))) continue;
      const SweptBlock& block = (*blocks_)[b];
      const std::int64_t from = std::max(first, block.base);
      const std::int64_t to = std::min(last, block.base + block.slots());
      if (from >= to) continue;
      const auto [kept, gained] = (*branch_lag_)->advance_of(static_cast<int>(b), dt);
      kernels_->advance_lag(3 * (to - from), kept, gained, now.v.data() + 3 * from, lag.data() + 3 * from);
    }
  }

  Motion now, next;
  DeviceArray<Real> lag;

  DeviceArray<Real>& force() { return force_; }
  const Real* inverse_mass() const { return inverse_mass_.data(); }

 private:
  FieldKernels<Real, U>* kernels_;
  const BasicInternalForce<Real, U>* internal_;
  const std::optional<BranchLag<Real>>* branch_lag_;
  const std::vector<SweptBlock>* blocks_;
  DeviceArray<Real> force_, inverse_mass_;
};

}  // namespace tread
