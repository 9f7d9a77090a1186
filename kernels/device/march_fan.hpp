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
  /// Queue of a block.
  static int queue(int block) { return kFanQueue + block % (kQueues - kFanQueue); }

  /// Marches over all blocks, with fields(block). What has begun ahead counts if it was begun with these
  /// loads; else all is done anew.
  template <class Fields>
  void start(const StepLoads& loads, const Fields& fields) {
    near_alone_ = ahead_ == loads;
    forget();
    if (near_alone_) return;
    join();
    for (int b = 0; b < blocks(); ++b) launch(queue(b), b, block(b).at(loads), fields);
  }
  /// Marches over the chosen tiles of all blocks. [BlockMarch::choose]
  template <class Fields>
  void start_chosen(const StepLoads& loads, const Fields& fields) {
    for (int b = 0; b < blocks(); ++b) {
      launch(queue(b), b, block(b).chosen_runs(loads), fields);
      launch(queue(b), b, block(b).chosen_tiles(loads), fields);
    }
  }
  /// Lets what follows in the queue in use begin after the march about the patch.
  void await_near() {
    for (int queue = kNearQueue; queue < (near_alone_ ? kHostQueue : kQueues); ++queue) device_->after(queue);
  }
  /// Likewise after all that gives forces on the host's nodes.
  void await_forces() {
    for (int b = 0; b < blocks(); ++b) {
      if (!block(b).awaits_host()) continue;
      device_->after(near_alone_ ? host_queue(b) : queue(b));
      if (!near_alone_ || !near_awaits_host(b)) continue;
      for (int queue = kNearQueue; queue < kHostQueue; ++queue) device_->after(queue);
    }
  }
  /// Likewise after all marches.
  void join() {
    for (int queue = kNearQueue; queue < kQueues; ++queue) device_->after(queue);
  }

  /// Begins a step with these loads by the teams that do not await the host: over tiles that the tractions
  /// reach after these, over the others at once.
  template <class Fields>
  void begin_ahead(const StepLoads& loads, const std::array<ReachedTiles, 2>& reached, const Fields& fields) {
    for (const ReachedTiles& of : reached) reached_[index(of.block)] = block(of.block).near(of.tiles);
    for (int b = 0; b < blocks(); ++b)
      launch(queue(b), b, block(b).beyond(loads, reached_[index(b)]), fields);
    launch_near(loads, false, fields);
    begun_ = loads;
  }
  /// Begins it by the others, when the host has moved its nodes.
  template <class Fields>
  void go_on_ahead(const Fields& fields) {
    for (int b = 0; b < blocks(); ++b)
      launch(host_queue(b), b, block(b).awaiting(*begun_, reached_[index(b)]), fields);
    launch_near(*begun_, true, fields);
    ahead_ = begun_;
  }
  bool has_begun() const { return begun_.has_value(); }
  /// Fields have changed: what has begun ahead does not count.
  void forget() {
    begun_.reset();
    ahead_.reset();
  }

 private:
  template <class Fields>
  void launch(int queue, int number, const MarchBlock<Real>& marched, const Fields& fields) {
    if (marched.teams() == 0) return;
    const Beside beside(*device_, queue);
    if (queue < kHostQueue) device_->after(kPatchQueue);
    kernels_->march(variant(number), marched, fields(number));
  }

  bool near_awaits_host(int b) const { return blocks_[index(b)]->awaits_host(reached_[index(b)]); }
  template <class Fields>
  void launch_near(const StepLoads& loads, bool awaits_host, const Fields& fields) {
    int queue = kNearQueue;
    for (int b = 0; b < blocks(); ++b) {
      const MarchRuns near = reached_[index(b)];
      if (near.count == 0) continue;
      if (near_awaits_host(b) == awaits_host) launch(queue, b, block(b).in_tiles(loads, near), fields);
      ++queue;
    }
  }

  static int host_queue(int block) { return kHostQueue + block % (kFanQueue - kHostQueue); }

  Device* device_;
  FieldKernels<Real, U>* kernels_;
  std::vector<std::unique_ptr<BlockMarch<Real>>> blocks_;
  std::vector<TileVariant> variants_;
  std::vector<MarchRuns> reached_;  ///< by block; none: the tractions do not reach it
  std::optional<StepLoads> begun_;  ///< of the step that has begun by teams that do not await the host
  std::optional<StepLoads> ahead_;  ///< of the step that has begun by all
  bool near_alone_ = false;         ///< the march about the patch has queues of its own in this step
};

}  // namespace tread
