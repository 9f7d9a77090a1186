#pragma once
// Groups of kLanes slots and their motion, packed to pass between host and device by one copy.

#include <cstddef>
#include <cstdint>

#include "drivers/engine/fields/featured_nodes.hpp"
#include "kernels/device/device.hpp"
#include "kernels/device/host_array.hpp"

namespace tread {

template <class Real, class U>
class PackedGroups {
 public:
  PackedGroups() = default;
  PackedGroups(Device& device, std::size_t room)
      : device_(&device),
        groups_(device, room),
        here_(device, room * kGroupBytes),
        there_(device, room * kGroupBytes) {}

  std::size_t room() const { return groups_.size(); }
  /// The groups [first, last) of a list.
  void list(const std::int64_t* groups, std::size_t first, std::size_t last) {
    if (last > first)
      device_->upload(groups_.data() + first, groups + first, (last - first) * sizeof(std::int64_t));
  }

  /// Values of `count` groups, on the host and on the device.
  GroupValues<Real, U> here(std::size_t count) { return packed(here_.data(), count); }
  GroupValues<Real, U> there(std::size_t count) { return packed(there_.data(), count); }
  void start_upload(std::size_t count) {
    device_->start_upload(there_.data(), here_.data(), count * kGroupBytes);
  }
  void download(std::size_t count) { there_.download(here_.data(), count * kGroupBytes); }

 private:
  static constexpr std::size_t kGroupBytes = kGroupValues * (sizeof(U) + sizeof(Real));

  GroupValues<Real, U> packed(std::byte* values, std::size_t count) const {
    auto* const u = reinterpret_cast<U*>(values);
    return {groups_.data(), static_cast<std::int64_t>(count), u,
            reinterpret_cast<Real*>(u + kGroupValues * count)};
  }

  Device* device_ = nullptr;
  DeviceArray<std::int64_t> groups_;
  HostArray<std::byte> here_;  ///< displacements [group][component][lane], then velocities
  DeviceArray<std::byte> there_;
};

}  // namespace tread
