#pragma once
// Groups of kLanes slots that the host moves, on their way to the device.

#include <algorithm>
#include <vector>

#include "core/index.hpp"
#include "core/page_vector.hpp"
#include "drivers/engine/device/packed_groups.hpp"

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
        packed_(device, hosts.size() + more) {
    groups_.reserve(hosts.size() + more);
    for (const std::int64_t group : hosts) sent_[index(group)] = 1;
    packed_.list(groups_.data(), 0, hosts_);
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
    packed_.list(groups_.data(), hosts_, groups_.size());
    const GroupValues<Real, U> values = packed_.here(groups_.size());
    for_groups(groups_, 0, std::ssize(groups_), [&](std::int64_t at, std::int64_t place) {
      std::copy_n(u.data() + place, kGroupValues, values.u + at);
      std::copy_n(v.data() + place, kGroupValues, values.v + at);
    });
    packed_.start_upload(groups_.size());
    device_->template kernels<Real, U>().place(packed_.there(groups_.size()), to_u, to_v);
  }

 private:
  Device* device_ = nullptr;
  std::vector<std::int64_t> groups_;  ///< the host's, then others
  std::size_t hosts_ = 0;             ///< number of the host's
  std::vector<unsigned char> sent_;   ///< by group: in groups_
  PackedGroups<Real, U> packed_;
};

}  // namespace tread
