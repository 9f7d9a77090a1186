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
  TiedNodes secondary() const { return secondary_.view(); }
  /// Primary nodes of a block, none or more.
  TiedNodes primary(int block) const { return primary_[static_cast<std::size_t>(block)].view(); }

 private:
  struct Nodes {
    DeviceArray<TiedNode> node;
    DeviceArray<NodeLink> links;
    DeviceArray<StationLink> shares;

    TiedNodes view() const {
      return {node.data(), static_cast<std::int64_t>(node.size()), links.data(), shares.data()};
    }
  };

  Nodes secondary_;
  std::vector<Nodes> primary_;  ///< by block
};

}  // namespace tread
