#pragma once
// The fields of a run on a device. [docs/records/device.md]
//
// The device moves every node on which elements alone act. Nodes that features touch (contact surfaces, tied,
// fastened, driven and restrained ones) are the host's: the device hands it their forces, the host moves them
// and hands their motion back. The views of NodeFields show the host's copies.

#include <memory>
#include <vector>

#include "drivers/engine/precise_fields.hpp"
#include "kernels/device/block_march.hpp"
#include "kernels/device/device.hpp"

namespace tread {

/// What a model takes on a device.
struct DeviceNeed {
  std::int64_t bytes = 0;       ///< memory, within the rounding of its pieces
  std::int64_t host_nodes = 0;  ///< places of nodes that the host moves, whole groups of kLanes
};
DeviceNeed device_need(const Model& model);

template <class Real, class U>
class DeviceFields final : public PreciseFields<Real, U> {
 public:
  DeviceFields(const Model& model, std::shared_ptr<Device> device);

  void set(const AlignedVector<double>& displacement, const AlignedVector<double>& velocity) override;
  void fetch() override;
  void changed() override;

  void internal_force() override;
  void internal_force_and_move(const StepLoads& loads) override;
  void move_all(const StepLoads& loads) override;
  void move_rest(const StepLoads& loads) override;
  void advance_lag(double dt) override;
  void list_state(StateList& list) override;

 private:
  using Base = PreciseFields<Real, U>;
  /// Fields that a step reads, and where it writes those that elements of several teams read.
  struct Arrays {
    DeviceArray<U> u;
    DeviceArray<Real> v;
    std::vector<DeviceArray<Real>> state;  ///< by block; empty where its law has none
  };

  void choose_host_groups(const Model& model);
  void march(const StepLoads& loads, bool moves);
  void send();
  void send_host_groups();
  void fetch_law_state();
  void advance_device_lag();
  void spoil();

  std::shared_ptr<Device> device_;
  std::vector<std::unique_ptr<BlockMarch<Real>>> blocks_;
  Arrays now_, next_;
  DeviceArray<Real> lag_, force_, inverse_mass_;

  std::vector<std::int64_t> groups_;  ///< the host's groups of kLanes slots, ascending
  std::vector<int> host_group_;       ///< by group: its place in groups_, or -1
  DeviceArray<std::int64_t> device_groups_;
  DeviceArray<int> device_host_group_;
  AlignedVector<U> packed_u_;  ///< [group][component][lane]
  AlignedVector<Real> packed_v_, packed_f_;
  DeviceArray<U> device_u_;
  DeviceArray<Real> device_v_, device_f_;
  std::vector<unsigned char> no_whole_tiles_;

  bool host_whole_ = true;     ///< the host's copies hold all values of the present
  bool device_whole_ = false;  ///< the device holds those of all nodes that are not the host's
  double lag_step_ = 0;        ///< by which the device's lag has still to advance [s]
};

extern template class DeviceFields<double, double>;
extern template class DeviceFields<float, double>;
extern template class DeviceFields<float, float>;

}  // namespace tread
