#pragma once
// Differences of two multi-body models.

#include <string>

#include "drivers/studies/multibody/multibody_model.hpp"

namespace tread {

/// First difference of wheel, vehicle, contact, rail and fastenings, such as "the wheel load is 87560 N here
/// and 70000 N there"; empty if there is none.
std::string track_difference(const MultibodyModel& here, const MultibodyModel& there);

/// First difference of the corrugations under the wheels, as the scenes state them, before any filter; empty
/// if there is none.
std::string corrugation_difference(const MultibodyModel& here, const MultibodyModel& there);

/// Difference of the other surfaces' depths, as the wheel follows them along the passage of `here`; empty if
/// there is none.
std::string surface_difference(const MultibodyModel& here, const MultibodyModel& there);

}  // namespace tread
