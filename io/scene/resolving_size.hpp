#pragma once
// The element size that resolves a part of a scene, for messages.

#include <string>

namespace tread {

/// `scene.element_size = "0.3 mm" resolves it`, for elements of `size` [m] and `part` = "it"; that no mesh
/// resolves the part where the size is below the key's range.
std::string resolving_size(double size, const char* part);

}  // namespace tread
