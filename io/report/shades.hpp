#pragma once
// Colours of values, from low to high: even steps of lightness, readable in grey.

#include <array>
#include <string>

namespace tread {

inline constexpr std::array<std::array<int, 3>, 5> kShadeStops = {
    {{247, 244, 232}, {190, 214, 206}, {94, 156, 175}, {38, 84, 132}, {32, 25, 66}}};

/// The colour of a share, "#5e9caf"; ends beyond [0, 1].
std::string shade(double share);

}  // namespace tread
