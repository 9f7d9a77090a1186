#pragma once
// Groups of kLanes slots that the host moves, and their way to the device by one copy.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/index.hpp"
#include "core/page_vector.hpp"
#include "drivers/engine/featured_nodes.hpp"
#include "kernels/device/device.hpp"
#include "kernels/device/host_array.hpp"

namespace tread {

template <class Real, class U>
class SentGroups {
 public:
  SentGroups() = default;
  /// The host's groups, always sent, and room for `more`. `all`: number of groups.
  SentGroups(Device& device, const std::vector<std::int64_t>& hosts, std::size_t more, std::size_t all)
      : device_(&device),
        groups_(hosts),
        hosts_(hosts.size()),
        sent_(all, 0),
        device_groups_(device, hosts.size() + more),
        packed_(device, (hosts.size() + more) * kGroupBytes),
        device_packed_(device, packed_.size()) {
    groups_.reserve(hosts.size() + more);
    for (const std::int64_t group : hosts) sent_[index(group)] = 1;
    device_groups_.upload(groups_.data(), hosts_);
  }

  /// Leaves out all but the host's.
  void reset() {
    for (std::size_t i = hosts_; i < groups_.size(); ++i) sent_[index(groups_[i])] = 0;
    groups_.resize(hosts_);
  }
  bool has(std::int64_t group) const { return sent_[index(group)] != 0; }
  void add(std::int64_t group) {
    sent_[index(group)] = 1;
    groups_.push_back(group);
  }

  /// Sends their values in fields of the host to fields of the device. The host sends again after it has
  /// waited for a later kernel.
  void send(const PageVector<U>& u, const PageVector<Real>& v, U* to_u, Real* to_v) {
    if (groups_.empty()) return;
    if (groups_.size() > hosts_)
      device_->upload(device_groups_.data() + hosts_, groups_.data() + hosts_,
                      (groups_.size() - hosts_) * sizeof(std::int64_t));
    const GroupValues<Real, U> values = packed(packed_.data());
    for_groups(groups_, 0, std::ssize(groups_), [&](std::int64_t at, std::int64_t place) {
      std::copy_n(u.data() + place, kGroupValues, values.u + at);
      std::copy_n(v.data() + place, kGroupValues, values.v + at);
    });
    device_->start_upload(device_packed_.data(), packed_.data(), groups_.size() * kGroupBytes);
    device_->template kernels<Real, U>().place(packed(device_packed_.data()), to_u, to_v);
  }

 private:
  /// Displacements and velocities of a group [B].
  static constexpr std::size_t kGroupBytes = 3 * kLanes * (sizeof(U) + sizeof(Real));

  GroupValues<Real, U> packed(std::byte* values) const {
    auto* const u = reinterpret_cast<U*>(values);
    auto* const v = reinterpret_cast<Real*>(u + 3 * kLanes * groups_.size());
    return {device_groups_.data(), std::ssize(groups_), u, v};
  }

  Device* device_ = nullptr;
  std::vector<std::int64_t> groups_;  ///< the host's, then others
  std::size_t hosts_ = 0;             ///< number of the host's
  std::vector<unsigned char> sent_;   ///< by group: in groups_
  DeviceArray<std::int64_t> device_groups_;
  HostArray<std::byte> packed_;  ///< displacements [group][component][lane], then velocities
  DeviceArray<std::byte> device_packed_;
};

}  // namespace tread
