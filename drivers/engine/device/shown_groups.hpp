#pragma once
// Groups of kLanes slots on their way from a device to the host's copies.

#include <algorithm>
#include <vector>

#include "core/page_vector.hpp"
#include "drivers/engine/device/packed_groups.hpp"

namespace tread {

template <class Real, class U>
class ShownGroups {
 public:
  ShownGroups() = default;
  /// With room for `groups`; more is made where more are wanted.
  ShownGroups(Device& device, std::size_t groups) : device_(&device), packed_(device, groups) {}

  /// Copies groups of fields of the device to fields of the host.
  void fetch(const std::vector<std::int64_t>& groups, const U* u, const Real* v, PageVector<U>& to_u,
             PageVector<Real>& to_v) {
    if (groups.empty()) return;
    if (groups.size() > packed_.room()) packed_ = PackedGroups<Real, U>(*device_, 2 * groups.size());
    packed_.list(groups.data(), 0, groups.size());
    device_->template kernels<Real, U>().take(packed_.there(groups.size()), u, v);
    packed_.download(groups.size());
    const GroupValues<Real, U> values = packed_.here(groups.size());
    for_groups(groups, 0, std::ssize(groups), [&](std::int64_t at, std::int64_t place) {
      std::copy_n(values.u + at, kGroupValues, to_u.data() + place);
      std::copy_n(values.v + at, kGroupValues, to_v.data() + place);
    });
  }

 private:
  Device* device_ = nullptr;
  PackedGroups<Real, U> packed_;
};

}  // namespace tread
