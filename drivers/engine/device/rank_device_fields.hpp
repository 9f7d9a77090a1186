#pragma once
// The fields of a run whose steps several processes share, each with a device. [docs/records/ranks.md]
//
// The device computes the elements of the rank's tiles and moves their nodes. Nodes that other ranks need,
// those about the patch and those on which features act are the host's: they go the ways of RankFields. In
// steps that look at the energies, and where the wheel is anchored, the host gets all of its tiles.

#include <cstdint>
#include <memory>
#include <vector>

#include "drivers/engine/device/sent_groups.hpp"
#include "drivers/engine/device/shown_groups.hpp"
#include "drivers/engine/fields/march_arrays.hpp"
#include "drivers/engine/ranks/rank_fields.hpp"
#include "kernels/device/device.hpp"
#include "kernels/device/host_array.hpp"
#include "kernels/device/march_fan.hpp"

namespace tread {

template <class Real, class U>
class RankDeviceFields final : public RankFields<Real, U> {
 public:
  RankDeviceFields(const Model& model, std::shared_ptr<Ranks> ranks, std::shared_ptr<Device> device);
  ~RankDeviceFields() override { device_->let_end(); }

  void set(const AlignedVector<double>& displacement, const AlignedVector<double>& velocity) override {
    Base::set(displacement, velocity);
    changed();
  }
  void fetch() override {
    come_home();
    Base::fetch();
  }
  void spread() override {
    Base::spread();
    changed();
  }
  void changed() override {
    host_whole_ = true;
    device_whole_ = host_moves_ = false;
    lag_step_ = 0;
  }

  /// The contact waits for all elements.
  bool follow_patch(const BodyFrame& wheel, double dt) override {
    Base::follow_patch(wheel, dt);
    return false;
  }
  void internal_force_and_move(const StepLoads& loads, bool measured) override;
  void move_rest(const StepLoads& loads, bool measured) override;
  void advance_lag(double dt) override {
    if (host_whole_)
      Base::advance_lag(dt);
    else if (this->q())
      lag_step_ = dt;
  }
  MeanMotion mean_motion(const SpinningBody& body, const BodyFrame& wheel) override {
    come_home();
    return Base::mean_motion(body, wheel);
  }
  void anchor(const SpinningBody& body, const MeanMotion& mean, BodyFrame& wheel, double dt) override {
    come_home();
    Base::anchor(body, mean, wheel, dt);
    changed();
  }
  /// Whoever lists the state may read or restore it.
  void list_state(StateList& list) override {
    Base::list_state(list);
    changed();
  }

 private:
  using Base = RankFields<Real, U>;
  enum class Way { to_device, to_host };

  void bring(const std::vector<std::int64_t>& groups) override;
  void patch_chosen() override;
  void choose_tiles();
  void march(const StepLoads& loads, const DeviceArray<int>& marks);
  void take_forces();
  void send();
  void come_home();
  void copy(Way way, const std::vector<TileStretch>& stretches, bool with_motion);
  void copy(Way way, void* on_device, void* on_host, std::size_t bytes) const;
  void advance_device_lag();
  void spoil_device();
  void spoil_host();

  std::shared_ptr<Device> device_;
  MarchFan<Real, U> marches_;
  MarchArrays<Real, U> arrays_;

  DeviceArray<unsigned char> held_;  ///< MarchFields::held
  std::vector<int> held_mark_;       ///< by group: kHolds where an unknown of it is held, else kMoves
  std::vector<int> mark_;            ///< MarchFields::group_mark
  DeviceArray<int> device_mark_;
  DeviceArray<int> keep_mark_;  ///< kKeeps everywhere: forces of all nodes, and no motion

  std::vector<std::int64_t> forced_;  ///< own groups whose forces the host gets, ascending
  HostArray<Real> packed_f_;          ///< [group][component][lane]
  DeviceArray<Real> device_f_;
  SentGroups<Real, U> sent_;  ///< groups of own tiles and halo that the device gets from the host
  ShownGroups<Real, U> shown_;
  std::vector<std::int64_t> brought_;  ///< in bring()

  bool host_whole_ = true;     ///< the views hold the present values of the own tiles
  bool device_whole_ = false;  ///< the device holds them, but for those of sent_
  bool host_moves_ = false;    ///< the groups of sent_ since they were sent
  double lag_step_ = 0;        ///< by which the device's lag has still to advance [s]
};

extern template class RankDeviceFields<double, double>;
extern template class RankDeviceFields<float, double>;
extern template class RankDeviceFields<float, float>;

}  // namespace tread
