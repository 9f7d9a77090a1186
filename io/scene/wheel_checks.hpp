#pragma once
// Checks of the wheel. Private to the checks of a scene.

#include "core/scene.hpp"
#include "io/scene/require.hpp"

namespace tread {

/// [wheel], if there is one, beside the rest of the scene.
void check_wheel(const Scene& scene, Require require);

}  // namespace tread
