#pragma once
// Torque of a scene's traction, and the state of a wheelset that has long been rolling under it. [theory.md,
// Start]

#include "drivers/engine/model/model.hpp"

namespace tread {

/// Torque of which MotionSpec::torque_share() is the share; 0 without traction [N m].
double full_torque(const Model& model);

/// F_L over the static wheel load under the full torque, spin and speed growing together [-]; 0 without
/// traction or load.
double full_traction(const Model& model);

/// Throws InputError if the patch of a wheelset that rolls steadily under F_L / F_N = `traction` would slide.
void require_grip(const Model& model, double traction);

/// F_L over the static wheel load at the start [-]: of a wheelset that has been rolling under its full torque
/// where MotionSpec::ramp is 0 and the start is not rigid, else 0. InputError if its patch would slide.
double steady_traction(const Model& model);

/// Creepage at the start [-]: the scene's; or, under a traction, that of steady rolling on half-spaces under
/// the static load. InputError if none is found there.
double start_creepage(const Model& model, double traction);

}  // namespace tread
