#pragma once
// Division of a run's nodes between device and host, and the memory that the device needs.
// [docs/records/device.md]

#include <cstdint>
#include <vector>

#include "drivers/engine/model/model.hpp"

namespace tread {

/// Movers of the groups of kLanes slots, and unknowns that stay zero by who holds them.
struct Movers {
  std::vector<int> marks;            ///< MarchFields::group_mark
  std::vector<std::int64_t> hosted;  ///< the host's groups, ascending
  bool contact = false;              ///< contact runs on the device

  std::vector<unsigned char> held;       ///< MarchFields::held
  std::vector<std::int64_t> held_ties;   ///< unknowns of tied nodes
  std::vector<std::int64_t> held_hosts;  ///< unknowns of the host's nodes
};

/// Ties between nodes on which connectors act, or contact, are the host's, and contact with surfaces on which
/// the host moves a node.
Movers movers_of(const Model& model);

/// Marks an unknown that stays zero. `held`: MarchFields::held, by slot.
void mark_held(std::int64_t unknown, std::vector<unsigned char>& held);

/// Needs of a model on a device.
struct DeviceNeed {
  std::int64_t bytes = 0;       ///< memory, within the rounding of its pieces
  std::int64_t host_nodes = 0;  ///< places of nodes that the host moves, whole groups of kLanes
};
DeviceNeed device_need(const Model& model);

}  // namespace tread
