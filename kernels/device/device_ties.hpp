#pragma once
// Ties in the memory of a device.

#include <vector>

#include "kernels/device/device.hpp"
#include "kernels/ties/tie.hpp"

namespace tread {

class DeviceTies {
 public:
  /// Copies everything.
  DeviceTies(Device& device, const Mesh& mesh, const Ties& ties);

  /// Secondary nodes of all blocks.
  TiedNodes secondary() const {
    return {secondary_.data(), static_cast<std::int64_t>(secondary_.size()), secondary_links_.data(),
            secondary_shares_.data()};
  }
  /// Sums that the primary nodes of all blocks take.
  StationSums sums() {
    return {sums_.data(), static_cast<std::int64_t>(sums_.size()), sum_shares_.data(), values_.data()};
  }
  /// Primary nodes of a block, none or more.
  PrimaryNodes primary(int block) const {
    const DeviceArray<PrimaryNode>& nodes = primary_[static_cast<std::size_t>(block)];
    return {nodes.data(), static_cast<std::int64_t>(nodes.size()), primary_links_.data(), values_.data()};
  }

 private:
  DeviceArray<TiedNode> secondary_;
  DeviceArray<NodeLink> secondary_links_;
  DeviceArray<StationLink> secondary_shares_;
  DeviceArray<StationSum> sums_;
  DeviceArray<StationLink> sum_shares_;
  DeviceArray<double> values_;                     ///< of the sums: [sum][component][lane]
  std::vector<DeviceArray<PrimaryNode>> primary_;  ///< by block
  DeviceArray<NodeLink> primary_links_;
};

}  // namespace tread
