#pragma once
// A block of the mesh in the memory of a device, cut for its teams.

#include <memory>
#include <span>
#include <vector>

#include "kernels/blocks/block_elements.hpp"
#include "kernels/blocks/time_update.hpp"
#include "kernels/device/device.hpp"

namespace tread {

/// Choice of a tile for a march: with its run where all others of that are chosen so, or by itself.
enum class ChosenTile : unsigned char { no, yes, apart };

template <class Real>
class BlockMarch {
 public:
  /// Copies everything. `damping`: factor of the velocity [s] or of the lag [-]. `marks`: those of all groups
  /// of kLanes slots [MarchFields::group_mark], or none; teams that read a node of the host await it.
  BlockMarch(Device& device, const BlockElements<Real>& elements, double damping, std::span<const int> marks);

  /// Data of a march in a step with these loads, over all runs.
  const MarchBlock<Real>& at(const StepLoads& loads);
  /// Runs that read or write a stretch of tiles, which may pass the end of a full turn.
  MarchRuns near(TileSpan tiles) const;
  /// By runs of one tile: more teams, which end sooner but do more work.
  MarchBlock<Real> in_tiles(const StepLoads& loads, MarchRuns runs);
  /// Over other runs, by teams that await the host, run by run of one tile, and by all others.
  MarchBlock<Real> awaiting(const StepLoads& loads, MarchRuns near);
  MarchBlock<Real> beyond(const StepLoads& loads, MarchRuns near);
  /// Over the tiles that were chosen alone: whole runs of them, and the others, tile by tile.
  void choose(Device& device, std::span<const ChosenTile> tiles);
  MarchBlock<Real> chosen_runs(const StepLoads& loads);
  MarchBlock<Real> chosen_tiles(const StepLoads& loads);
  bool awaits_host() const { return awaiting_.size() > 0; }
  bool awaits_host(MarchRuns runs) const;

 private:
  /// Copies values to the device.
  template <class T, class Allocator>
  const T* keep(Device& device, const std::vector<T, Allocator>& values);
  /// Cuts the section for the teams of the device, and sets the sizes of `block_` by it.
  SectionCut choose_cut(const Device& device, const BlockElements<Real>& elements);
  void build_tiles(Device& device);
  void build_coefficients(Device& device, const BlockElements<Real>& elements);
  void find_awaiting(Device& device, const SectionCut& cut, std::span<const int> marks);
  bool touches_host(const SectionCut& cut, const MarchPart& part, int run, std::span<const int> marks) const;
  MarchRuns as_tiles(MarchRuns runs) const;
  static MarchBlock<Real> listed(MarchBlock<Real> block, const DeviceArray<int>& teams) {
    block.marched = {};
    block.list = teams.data();
    block.listed = static_cast<int>(teams.size());
    return block;
  }

  const SweptBlock* swept_;
  MarchBlock<Real> block_;
  DeviceArray<int> awaiting_;                ///< teams of one tile each
  DeviceArray<int> others_;                  ///< teams of whole runs
  DeviceArray<int> chosen_runs_;             ///< likewise
  DeviceArray<int> chosen_tiles_;            ///< teams of one tile each
  std::vector<unsigned char> awaits_host_;   ///< by run
  std::vector<std::shared_ptr<void>> kept_;  ///< arrays that block_ points to
};

extern template class BlockMarch<double>;
extern template class BlockMarch<float>;

}  // namespace tread
