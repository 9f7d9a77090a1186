#pragma once
// Checks of [surface.NAME] beside wheel and rail.

#include "core/scene.hpp"
#include "io/scene/require.hpp"

namespace tread {

void check_surfaces(const Scene& scene, Require require);

}  // namespace tread
