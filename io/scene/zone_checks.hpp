#pragma once
// Checks of the finely divided parts of the rail. Private to the checks of a scene.

#include "core/scene.hpp"
#include "io/scene/require.hpp"

namespace tread {

/// [solution_zone] and [zone.NAME] on the rail and around the wheel.
void check_zones(const Scene& scene, Require require);

}  // namespace tread
