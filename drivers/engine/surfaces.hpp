#pragma once
// The depths that a scene states on the running surfaces of rail and wheel, [surface.NAME].

#include "core/running_surface.hpp"
#include "core/scene.hpp"

namespace tread {

/// Depths on the rail besides the corrugation; x as in the scene.
RunningSurface rail_surface(const Scene& scene);

/// Depths on the wheel; x is where a place meets the rail in free rolling.
RunningSurface wheel_surface(const Scene& scene);

}  // namespace tread
