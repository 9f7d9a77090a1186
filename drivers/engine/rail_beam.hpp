#pragma once
// The beam that bends as a scene's rail does.

#include "core/scene.hpp"
#include "drivers/engine/beam/beam_section.hpp"

namespace tread {

/// Beam section of the scene's rail, upright, on a fine section mesh whatever the mesh of the scene.
/// InputError without [rail].
BeamSection rail_beam_section(const Scene& scene);

}  // namespace tread
