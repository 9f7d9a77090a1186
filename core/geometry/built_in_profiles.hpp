#pragma once
// Profiles that a scene names.

#include <array>
#include <string>
#include <string_view>

#include "core/geometry/profiles.hpp"

namespace tread {

inline constexpr std::array<std::string_view, 4> kBuiltInRails = {"CN60", "60E1", "60E2", "49E1"};
inline constexpr std::array<std::string_view, 2> kBuiltInWheels = {"LMA", "S1002"};

/// The rail of that name. Throws std::invalid_argument for another name.
RailProfile built_in_rail(const std::string& name);

/// The wheel profile of that name. Throws std::invalid_argument for another name.
WheelProfile built_in_wheel(const std::string& name);

}  // namespace tread
