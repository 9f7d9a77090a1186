#pragma once
// The form of a check. Private to the checks of a scene.

#include <string>
#include <vector>

#include "core/function_ref.hpp"

namespace tread {

inline constexpr double kLengthTolerance = 1e-9;  ///< lengths that differ by less are equal [m]

/// Adds a problem of these keys with this message unless the condition holds.
using Require = FunctionRef<void(bool condition, std::vector<std::string> keys, std::string message)>;

}  // namespace tread
