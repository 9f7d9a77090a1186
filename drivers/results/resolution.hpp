#pragma once
// Warnings of a scene whose mesh, samples, way or depths do not show what it asks for.

#include <optional>
#include <string>
#include <vector>

#include "drivers/engine/model/model.hpp"

namespace tread {

/// Elements across the shorter axis of the patch below which F_N ripples as they pass. Measured on a smooth
/// rail at 300 km/h, amplitude over load: 4 % with 1.4 elements, 0.7 % with 2.2, 0.03 % with 2.7.
inline constexpr double kElementsOfForce = 2.5;

/// Elements across the shorter axis of the patch of Hertz if too few for its pressures; none for a sound mesh
/// or without contact.
std::optional<double> too_few_elements_across_patch(const Model& model);

/// A sentence for each part of the scene that the mesh resolves too coarsely, or that the model was not made
/// for, with the value, the bound, the consequence and the way out. Empty for a sound scene.
std::vector<std::string> resolution_warnings(const Model& model);

}  // namespace tread
