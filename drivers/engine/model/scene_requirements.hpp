#pragma once
// Demands of a model on the values of a scene, whoever filled it. Files meet more checks: io/scene.

#include "core/scene.hpp"

namespace tread {

/// Throws InputError, with the member as the scene's file names it, for a name that no part of the engine
/// knows, a size or density that is not finite and above zero, and values that exclude one another.
void require_scene(const Scene& scene);

}  // namespace tread
