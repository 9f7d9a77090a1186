#pragma once
// Points of a model's blocks to which connectors and loads attach.

#include <string>
#include <vector>

#include "core/mesh/swept_block.hpp"
#include "core/scene.hpp"
#include "drivers/engine/rail_foot.hpp"
#include "kernels/connectors/connectors.hpp"

namespace tread {

/// Attachment at (x, y) [m] on the line `path` of an extruded block's section. InputError if it lies beyond
/// the block.
Attachment attach(const SweptBlock& block, const std::string& path, double x, double y);

/// Attachment at (x, y) [m] on the running surface. InputError if it lies beyond the block.
Attachment attach_to_surface(const SweptBlock& block, double x, double y);

/// Spring-dampers of the scene's fastenings under the rail's foot, fastening by fastening: vertical ones on
/// the block `below` of each or, if that is null, on rigid ground; along and across where they are elastic,
/// to the ground.
std::vector<SpringDampers::Element> fastening_elements(const Scene& scene, const RailFoot& rail,
                                                       const std::vector<const SweptBlock*>& below);

/// Number of spring-dampers of a fastening.
std::size_t elements_of_fastening(const FasteningSpec& fastening);

/// Vertical spring-dampers of a bed, spread evenly under the block of a half sleeper, to the ground; `share`
/// of the stated stiffness and damping.
std::vector<SpringDampers::Element> bed_elements(const SleeperSpec& spec, double share,
                                                 const SweptBlock& sleeper);

/// Nodes of the rail's foot that the fastenings hold (FasteningSpec::held_at); of each fastening at least
/// one.
std::vector<FootNode> held_foot_nodes(const Scene& scene, const RailFoot& foot);

}  // namespace tread
