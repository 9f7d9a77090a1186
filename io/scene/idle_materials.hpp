#pragma once
// Materials of a scene that no part is of.

#include <string>
#include <vector>

#include "core/scene.hpp"

namespace tread {

/// Names of the materials that no part is of; none where a part names a material that the scene lacks: one of
/// them may be meant.
std::vector<std::string> idle_materials(const Scene& scene);

/// Why a material without a part has no effect, and what would give it one.
std::string why_idle(const Scene& scene, const std::string& material);

}  // namespace tread
