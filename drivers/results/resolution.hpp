#pragma once
// Whether a scene's mesh resolves its contact patch and its corrugation.

#include <string>
#include <vector>

#include "drivers/engine/model.hpp"

namespace tread {

/// A sentence for each part of the scene that the mesh resolves too coarsely, or that the model was not made
/// for, with the value, the bound, the consequence and the way out. Empty for a sound scene.
std::vector<std::string> resolution_warnings(const Model& model);

}  // namespace tread
