#pragma once
// Memory that a scene needs at least, known before anything large is made.

#include <cstdint>

#include "drivers/engine/model.hpp"

namespace tread {

/// Fields that every run of a mesh of this size has in its preload [B].
std::int64_t least_bytes(const MeshCount& count);

/// Throws ResourceError where the mesh needs more memory than the machine has; the message states both, the
/// number of elements, and the keys that lower it. The AcceptMesh of models that are made for a user.
void require_memory(const MeshCount& count, const MeshSizes& sizes);

}  // namespace tread
