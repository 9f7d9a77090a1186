#pragma once
// Checks of [corrugation] beside rail and solution zone.

#include "core/scene.hpp"
#include "io/scene/require.hpp"

namespace tread {

void check_corrugation(const Scene& scene, Require require);

}  // namespace tread
