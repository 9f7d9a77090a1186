#pragma once
// Shapes of [surface.NAME] as `tread check` tells them.

#include <string>

#include "core/scene.hpp"
#include "io/text/json.hpp"

namespace tread {

/// Depths of a shape, where it meets the rail, its reach across and the deepest measured point: "flat on the
/// wheel, depths of 0 to 0.73 mm, x = 0.875 to 0.925 m".
std::string surface_text(const Scene& scene, const std::string& name, const SurfaceSpec& spec);

/// The figures of surface_text().
Json surface_shape_json(const Scene& scene, const std::string& name, const SurfaceSpec& spec);

}  // namespace tread
