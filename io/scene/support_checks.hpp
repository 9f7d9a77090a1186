#pragma once
// Checks of fastenings and sleepers. Private to the checks of a scene.

#include "core/scene.hpp"
#include "io/scene/require.hpp"

namespace tread {

/// [fastenings], [sleepers] and [support.NAME] beside one another and on the rail.
void check_supports(const Scene& scene, Require require);

}  // namespace tread
