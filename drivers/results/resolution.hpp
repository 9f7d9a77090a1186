#pragma once
// Warnings of a scene whose mesh, samples, way or depths do not show what it asks for.

#include <optional>
#include <string>
#include <vector>

#include "drivers/engine/model/model.hpp"

namespace tread {

/// Elements across the shorter axis of the patch of Hertz if too few for its pressures; none for a sound mesh
/// or without contact.
std::optional<double> too_few_elements_across_patch(const Model& model);

/// A sentence for each part of the scene that the mesh resolves too coarsely, or that the model was not made
/// for, with the value, the bound, the consequence and the way out. Empty for a sound scene.
std::vector<std::string> resolution_warnings(const Model& model);

}  // namespace tread
