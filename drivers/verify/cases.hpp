#pragma once
// The verification cases, one function each; a file holds cases that share a set-up.

#include <vector>

#include "drivers/verify/verify_case.hpp"

namespace tread {

inline constexpr double kSteelDensity = 7790;  ///< that of the paper's wheel [kg/m3]

VerifyCase hertz_sphere_case();   // hertz.cpp
VerifyCase hertz_ellipse_case();  // hertz.cpp

VerifyCase surface_depths_case();       // surface_depths.cpp
VerifyCase profiles_in_contact_case();  // profiles_in_contact.cpp
VerifyCase contact_filter_case();       // contact_filter.cpp
VerifyCase carter_case();               // carter.cpp
VerifyCase sliding_case();              // sliding.cpp
VerifyCase steady_rolling_case();       // steady_rolling.cpp
VerifyCase moving_frames_case();        // moving_frames.cpp
VerifyCase wheelset_modes_case();
VerifyCase wheel_receptance_case();  // wheelset_modes.cpp
VerifyCase ring_modes_case();        // ring_modes.cpp

VerifyCase rail_on_fastenings_case();  // rail_on_fastenings.cpp
VerifyCase rail_waves_case();          // rail_waves.cpp
VerifyCase fastening_passing_case();   // fastening_passing.cpp
VerifyCase wheelset_settling_case();   // wheelset_settling.cpp

VerifyCase extremes_damping_case();   // extremes_damping.cpp
VerifyCase extremes_elements_case();  // extremes_elements.cpp
VerifyCase extremes_step_case();      // extremes_step.cpp

VerifyCase extremes_penalty_case();      // extremes_penalty.cpp
VerifyCase extremes_traction_case();     // extremes_traction.cpp
VerifyCase extremes_speed_case();        // extremes_speed.cpp
VerifyCase extremes_corrugation_case();  // extremes_corrugation.cpp
VerifyCase extremes_endurance_case();    // extremes_endurance.cpp

VerifyCase cattaneo_mindlin_case();   // cattaneo_mindlin.cpp
VerifyCase transient_rolling_case();  // transient_rolling.cpp
VerifyCase von_mises_case();          // von_mises.cpp

/// All cases, in the order of the documentation.
const std::vector<VerifyCase>& verify_cases();

}  // namespace tread
