#pragma once
// The model of a scene that was read from files.

#include <optional>

#include "drivers/engine/model/model.hpp"
#include "drivers/results/memory_need.hpp"
#include "io/scene/scene_reader.hpp"

namespace tread {

/// Model of `scene`, which may differ from `origin.scene`. Throws as Model does, what `accept` throws, by
/// default ResourceError where the machine lacks memory for the mesh, and InputError that names the line of
/// `origin` which sets the element size if no mesh has such elements.
Model scene_model(const Scene& scene, const ResolvedScene& origin,
                  std::optional<double> corrugation_centre = {}, const AcceptMesh& accept = require_memory);

}  // namespace tread
