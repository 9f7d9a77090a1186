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

VerifyCase cattaneo_mindlin_case();   // cattaneo_mindlin.cpp
VerifyCase transient_rolling_case();  // transient_rolling.cpp
VerifyCase von_mises_case();          // von_mises.cpp

}  // namespace tread
