#pragma once
// Checks of fastenings and sleepers. Private to the checks of a scene.

#include <string>
#include <vector>

#include "core/function_ref.hpp"
#include "core/scene.hpp"

namespace tread {

inline constexpr double kLengthTolerance = 1e-9;  ///< lengths that differ by less are equal [m]

/// Adds a problem of these keys with this message unless the condition holds.
using Require = FunctionRef<void(bool condition, std::vector<std::string> keys, std::string message)>;

/// [fastenings], [sleepers] and [support.NAME] beside one another and on the rail.
void check_supports(const Scene& scene, Require require);

}  // namespace tread
