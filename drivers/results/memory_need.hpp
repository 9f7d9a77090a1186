#pragma once
// Memory that a scene needs at least, known before anything large is made.

#include <cstdint>

#include "core/scene.hpp"
#include "drivers/engine/model.hpp"

namespace tread {

/// Fields that every run of a mesh of this size has in its preload [B].
std::int64_t least_bytes(const MeshCount& count);

/// Throws ResourceError where the scene's mesh needs more memory than the machine has; the message states
/// both, the number of elements, and the keys that lower it. InputError where the scene cannot be meshed.
void require_memory(const Scene& scene);

}  // namespace tread
