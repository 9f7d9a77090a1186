#pragma once
// Groups of kLanes slots on their way from a device to the host's copies, by one copy.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/page_vector.hpp"
#include "drivers/engine/featured_nodes.hpp"
#include "kernels/device/device.hpp"
#include "kernels/device/host_array.hpp"

namespace tread {

template <class Real, class U>
class ShownGroups {
 public:
  ShownGroups() = default;
  /// With room for `groups`; more is made where more are wanted.
  ShownGroups(Device& device, std::size_t groups) : device_(&device) { make_room(groups); }

  /// Copies groups of fields of the device to fields of the host.
  void fetch(const std::vector<std::int64_t>& groups, const U* u, const Real* v, PageVector<U>& to_u,
             PageVector<Real>& to_v) {
    if (groups.empty()) return;
    if (groups.size() > groups_.size()) make_room(2 * groups.size());
    groups_.upload(groups.data(), groups.size());
    const GroupValues<Real, U> values = packed(device_packed_.data(), groups.size());
    device_->template kernels<Real, U>().take(values, u, v);
    device_packed_.download(packed_.data(), groups.size() * kGroupBytes);
    const GroupValues<Real, U> here = packed(packed_.data(), groups.size());
    for_groups(groups, 0, std::ssize(groups), [&](std::int64_t at, std::int64_t place) {
      std::copy_n(here.u + at, kGroupValues, to_u.data() + place);
      std::copy_n(here.v + at, kGroupValues, to_v.data() + place);
    });
  }

 private:
  static constexpr std::size_t kGroupBytes = kGroupValues * (sizeof(U) + sizeof(Real));

  void make_room(std::size_t groups) {
    groups_ = DeviceArray<std::int64_t>(*device_, groups);
    packed_ = HostArray<std::byte>(*device_, groups * kGroupBytes);
    device_packed_ = DeviceArray<std::byte>(*device_, packed_.size());
  }
  GroupValues<Real, U> packed(std::byte* values, std::size_t groups) const {
    auto* const u = reinterpret_cast<U*>(values);
    return {groups_.data(), static_cast<std::int64_t>(groups), u,
            reinterpret_cast<Real*>(u + kGroupValues * groups)};
  }

  Device* device_ = nullptr;
  DeviceArray<std::int64_t> groups_;
  HostArray<std::byte> packed_;  ///< displacements [group][component][lane], then velocities
  DeviceArray<std::byte> device_packed_;
};

}  // namespace tread
