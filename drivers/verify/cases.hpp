#pragma once
// The verification cases, one function each; a file holds cases that share a set-up.

#include "drivers/verify/verify_case.hpp"

namespace tread {

VerifyCase hertz_sphere_case();   // hertz.cpp
VerifyCase hertz_ellipse_case();  // hertz.cpp

VerifyCase contact_filter_case();  // contact_filter.cpp
VerifyCase carter_case();          // carter.cpp
VerifyCase sliding_case();         // sliding.cpp
VerifyCase steady_rolling_case();  // steady_rolling.cpp

VerifyCase extremes_penalty_case();      // extremes_penalty.cpp
VerifyCase extremes_traction_case();     // extremes_traction.cpp
VerifyCase extremes_speed_case();        // extremes_speed.cpp
VerifyCase extremes_corrugation_case();  // extremes_corrugation.cpp
VerifyCase extremes_endurance_case();    // extremes_endurance.cpp

}  // namespace tread
