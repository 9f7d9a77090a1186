#pragma once
// A block of the mesh in the memory of a device, cut for its teams.

#include <memory>
#include <vector>

#include "kernels/blocks/block_elements.hpp"
#include "kernels/blocks/time_update.hpp"
#include "kernels/device/device.hpp"

namespace tread {

template <class Real>
class BlockMarch {
 public:
  /// Copies everything. `damping`: factor of the velocity [s] or of the lag [-].
  BlockMarch(Device& device, const BlockElements<Real>& elements, double damping);

  /// Data of a march in a step with these loads, over all runs.
  const MarchBlock<Real>& at(const StepLoads& loads) { return at(loads, runs()); }
  const MarchBlock<Real>& at(const StepLoads& loads, MarchRuns runs);
  /// The same by runs of one tile: more teams, which end sooner but do more work.
  MarchBlock<Real> in_tiles(const StepLoads& loads, MarchRuns runs);
  MarchRuns runs() const { return {0, block_.runs()}; }
  /// Runs that read or write a stretch of tiles, which may pass the end of a full turn, and the others.
  MarchRuns near(TileSpan tiles) const;
  MarchRuns beyond(MarchRuns near) const {
    return {(near.first + near.count) % block_.runs(), block_.runs() - near.count};
  }

 private:
  /// Copies values to the device.
  template <class T, class Allocator>
  const T* keep(Device& device, const std::vector<T, Allocator>& values);
  void build_tiles(Device& device);
  void build_coefficients(Device& device, const BlockElements<Real>& elements);

  const SweptBlock* swept_;
  MarchBlock<Real> block_;
  std::vector<std::shared_ptr<void>> kept_;  ///< arrays that block_ points to
};

extern template class BlockMarch<double>;
extern template class BlockMarch<float>;

}  // namespace tread
