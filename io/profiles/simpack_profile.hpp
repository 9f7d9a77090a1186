#pragma once
// Profiles of SIMPACK: .prr (rail) and .prw (wheel).

#include <string>
#include <vector>

#include "io/profiles/profile_points.hpp"

namespace tread {

/// Points between `point.begin` and `point.end` (y, z and perhaps a weight) with the header's changes:
/// point.dist.min, shift.y, shift.z, bound.y, bound.z, mirror.y, mirror.z, units.len.f. Every bad line is
/// added to `faults`.
FilePoints read_simpack_profile(const std::string& text, std::vector<LineFault>& faults);

}  // namespace tread
