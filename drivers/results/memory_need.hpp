#pragma once
// Memory that a scene needs at least, known before anything large is made.

#include <cstdint>

#include "drivers/engine/model/model.hpp"

namespace tread {

/// Fields that every run of a mesh of this size has in its preload [B].
std::int64_t least_bytes(const MeshCount& count);

/// Masses of all nodes [B].
std::int64_t mass_bytes(const MeshCount& count);

/// Throws ResourceError where the mesh needs more memory than the machine has, for all ranks on it together;
/// the message states both, the number of elements, and the keys that lower it. The AcceptMesh of models that
/// are made for a user.
void require_memory(const MeshCount& count, const MeshSizes& sizes);
/// The same for a model without a preload and without steps of all nodes.
void require_memory_of_mesh(const MeshCount& count, const MeshSizes& sizes);

}  // namespace tread
