#pragma once
// Warnings of a mesh that resolves the contact patch or the corrugation too coarsely.

#include <string>
#include <vector>

#include "drivers/engine/model.hpp"

namespace tread {

/// A sentence for each part of the scene that the mesh resolves too coarsely, or that the model was not made
/// for, with the value, the bound, the consequence and the way out. Empty for a sound scene.
std::vector<std::string> resolution_warnings(const Model& model);

}  // namespace tread
