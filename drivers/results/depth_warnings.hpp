#pragma once
// Warnings of depths on the running surfaces, [corrugation] and [surface.NAME], that have no effect, end in
// steps, are too steep or too fine for the mesh.

#include <string>
#include <vector>

#include "drivers/engine/model/model.hpp"

namespace tread {

/// Appends sentences on the depths of a model with contact; "" where one is sound.
void add_depth_warnings(const Model& model, std::vector<std::string>& warnings);

/// Sentences on lengths of the depths with too few elements; empty where the mesh resolves all.
std::vector<std::string> coarse_depth_warnings(const Model& model);

}  // namespace tread
