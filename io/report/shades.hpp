#pragma once
// Colours of values, from low to high: even steps of lightness, readable in grey.

#include <array>
#include <string>

namespace tread {

inline constexpr std::array<std::array<int, 3>, 5> kShadeStops = {
    {{247, 244, 232}, {190, 214, 206}, {94, 156, 175}, {38, 84, 132}, {32, 25, 66}}};

/// Colour of a share in [0, 1], such as "#5e9caf". Shares beyond the ends get the colours of the ends.
std::string shade(double share);

}  // namespace tread
