#pragma once
// Checks that a scene makes sense as a whole.

#include <string>
#include <vector>

#include "core/scene.hpp"

namespace tread {

struct SceneProblem {
  std::vector<std::string> keys;  ///< keys or tables concerned; the first is the one to blame by default
  std::string message;
};

/// Every value outside its range, every component that lacks what it needs, every part that does not fit into
/// another. Checks across keys leave out those whose own value is already wrong.
std::vector<SceneProblem> validate(const Scene& scene);

}  // namespace tread
