#pragma once
// The depths that a scene states on the running surfaces of rail and wheel, [surface.NAME].

#include <vector>

#include "core/running_surface.hpp"
#include "core/scene.hpp"
#include "drivers/engine/model/station_plan.hpp"

namespace tread {

/// The shape that a table states, about its own zero.
DepthShapePointer shape_of(const Scene& scene, const SurfaceSpec& spec);

/// Depths on the rail besides the corrugation; x as in the scene.
RunningSurface rail_surface(const Scene& scene);

/// Depths on the wheel; x is where a place meets the rail in free rolling.
RunningSurface wheel_surface(const Scene& scene);

/// Places along the rail, within `way`, where the shape of that name lies, or where a wheel's shape meets the
/// rail; a wheel's once a turn.
std::vector<Span> places_of(const Scene& scene, const SurfaceSpec& spec, const Span& way);

}  // namespace tread
