#pragma once
// Orientation of wheel and rail profiles from files.

#include <string>

#include "io/scene/table_reader.hpp"

namespace tread {

/// Sentence on the axes that a wheel's profile mistakes (y to the field side, z towards the flange tip), with
/// the way out; "" for a profile that is right or has no flange. Rows by growing y [m].
std::string wheel_profile_fault(const TwoColumns& profile);

/// The same of a rail's profile (y to the field side, z up). [m]
std::string rail_profile_fault(const TwoColumns& profile);

}  // namespace tread
