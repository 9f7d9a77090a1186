#pragma once
// The depths that a scene states on the running surfaces of rail and wheel, [surface.NAME].

#include <vector>

#include "core/running_surface.hpp"
#include "core/scene.hpp"
#include "drivers/engine/station_plan.hpp"

namespace tread {

/// Depths on the rail besides the corrugation; x as in the scene.
RunningSurface rail_surface(const Scene& scene);

/// Depths on the wheel; x is where a place meets the rail in free rolling.
RunningSurface wheel_surface(const Scene& scene);

/// Places along the rail, within `way`, where the shape of that name lies, or where a wheel's shape meets the
/// rail; a wheel's once a turn.
std::vector<Span> places_of(const Scene& scene, const SurfaceSpec& spec, const Span& way);

/// How much lower a rigid round wheel at x runs for the depths of both surfaces but the corrugation: it rolls
/// on the highest places about x, at y across [m].
double traced_depth(const RunningSurface& rail, const RunningSurface& wheel, double wheel_radius, double x,
                    double y);

}  // namespace tread
