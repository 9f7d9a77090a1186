#pragma once
// The march over all blocks at once, each in a queue of its own; beyond the contact patch it may begin before
// the step does. [docs/records/device.md]

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "core/index.hpp"
#include "kernels/device/block_march.hpp"

namespace tread {

/// Tiles of a block that the tractions of a step reach.
struct ReachedTiles {
  int block;
  TileSpan tiles;
};

template <class Real, class U>
class MarchFan {
 public:
  explicit MarchFan(Device& device) : device_(&device), kernels_(&device.kernels<Real, U>()) {}

  void add(std::unique_ptr<BlockMarch<Real>> block, TileVariant variant) {
    blocks_.push_back(std::move(block));
    variants_.push_back(variant);
    reached_.emplace_back();
  }

  int blocks() const { return static_cast<int>(blocks_.size()); }
  BlockMarch<Real>& block(int number) { return *blocks_[index(number)]; }
  TileVariant variant(int block) const { return variants_[index(block)]; }

  /// Marches over all blocks, with fields(block); what follows in the main queue begins after it. Nothing
  /// moves, or what has begun ahead counts if it was begun with these loads; else all is done anew.
  template <class Fields>
  void march(const StepLoads& loads, bool moves, const Fields& fields) {
    const bool begun = moves && ahead_ == loads;
    if (!begun) join();
    for (int b = 0; b < blocks(); ++b)
      if (begun)
        launch(b, block(b).in_tiles(loads, reached_[index(b)]), fields);
      else
        launch(b, block(b).at(loads), fields);
    join();
    ahead_.reset();
  }

  /// Begins a step with these loads beyond tiles that still change.
  template <class Fields>
  void begin_ahead(const StepLoads& loads, const std::array<ReachedTiles, 2>& reached, const Fields& fields) {
    for (const ReachedTiles& of : reached) reached_[index(of.block)] = block(of.block).near(of.tiles);
    for (int b = 0; b < blocks(); ++b)
      launch(b, block(b).at(loads, block(b).beyond(reached_[index(b)])), fields);
    ahead_ = loads;
  }
  /// Fields have changed: what has begun ahead does not count.
  void forget() { ahead_.reset(); }

 private:
  template <class Fields>
  void launch(int number, const MarchBlock<Real>& marched, const Fields& fields) {
    if (marched.marched.count == 0) return;
    const Beside beside(*device_, kFanQueue + number % (kQueues - kFanQueue));
    kernels_->march(variant(number), marched, fields(number));
  }

  void join() {
    for (int queue = kFanQueue; queue < kQueues; ++queue) device_->after(queue);
  }

  Device* device_;
  FieldKernels<Real, U>* kernels_;
  std::vector<std::unique_ptr<BlockMarch<Real>>> blocks_;
  std::vector<TileVariant> variants_;
  std::vector<MarchRuns> reached_;  ///< by block; none: the tractions do not reach it
  std::optional<StepLoads> ahead_;  ///< of the step that has begun
};

}  // namespace tread
