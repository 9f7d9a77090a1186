#pragma once
// Points of a model's blocks to which connectors and loads attach; those of the rail's foot: rail_foot.hpp.

#include <string>
#include <vector>

#include "core/mesh/swept_block.hpp"
#include "core/scene.hpp"
#include "kernels/connectors/connectors.hpp"

namespace tread {

/// Attachment at (x, y) [m] on the line `path` of an extruded block's section. InputError if it lies beyond
/// the block.
Attachment attach(const SweptBlock& block, const std::string& path, double x, double y);

/// Attachment at (x, y) [m] on the running surface. InputError if it lies beyond the block.
Attachment attach_to_surface(const SweptBlock& block, double x, double y);

/// Vertical spring-dampers of a bed, spread evenly under the block of a half sleeper, to the ground; `share`
/// of the stated stiffness and damping.
std::vector<SpringDampers::Element> bed_elements(const SleeperSpec& spec, double share,
                                                 const SweptBlock& sleeper);

}  // namespace tread
