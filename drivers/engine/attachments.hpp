#pragma once
// Points of a model's blocks to which connectors and loads attach.

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

/// Spring-dampers of the scene's fastenings under the block `rail`, on `slab` or, if that is null, on rigid
/// ground.
std::vector<SpringDampers::Element> fastening_elements(const Scene& scene, const SweptBlock& rail,
                                                       const SweptBlock* slab);

}  // namespace tread
