#pragma once
// Checks of bodies from files. Private to the checks of a scene.

#include "core/scene.hpp"
#include "io/scene/require.hpp"

namespace tread {

/// Each [body.NAME] beside wheel and rail, its material and its sets of nodes.
void check_bodies(const Scene& scene, Require require);

}  // namespace tread
