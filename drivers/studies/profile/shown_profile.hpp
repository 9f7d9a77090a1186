#pragma once
// A profile as `tread profile` shows it: from a file or built in.

#include <optional>
#include <string>

#include "core/geometry/plane_curve.hpp"
#include "core/geometry/profiles.hpp"
#include "drivers/studies/profile/profile_options.hpp"
#include "io/profiles/understood_profile.hpp"

namespace tread {

struct ShownProfile {
  std::string name;
  bool wheel = false;
  std::optional<UnderstoodProfile> file;  ///< absent: built in
  PlaneCurve curve{Point2{}};             ///< the surface in the program's axes [m]
  std::optional<RailProfile> section;     ///< the whole rail, where the head fits on one
  std::string misfit;                     ///< the reason why it does not
};

/// The profile of a file or of a built-in name. `wheel`: what it has to be; absent: by the options, the name,
/// the suffix or the content. Throws ProblemsError, InputError.
ShownProfile shown_profile(const std::string& name, std::optional<bool> wheel, const ProfileOptions& options);

/// Sizes that engineers compare [m]; those that a profile lacks are NaN.
struct ProfileMeasures {
  double left = 0, right = 0;   ///< ends of the surface
  double low = 0, high = 0;     ///< of z
  double flange_height = 0;     ///< Sh: tip above the nominal rolling circle [EN 15313]
  double flange_thickness = 0;  ///< Sd: 10 mm above the nominal rolling circle, from the back at y = -70 mm
  double flange_gradient = 0;   ///< qR: across, from 2 mm below the tip to the place of Sd
  double slope = 0;             ///< dz/dy at y = 0 [-]
  double head_width = 0;        ///< 14 mm below the crown
  double head_middle = 0;       ///< y of the middle of that width
};
ProfileMeasures measures_of(const ShownProfile& profile);

/// Curvature about y [1/m], positive where the body is convex: change of the tangent over 1 mm.
double curvature_at(const ShownProfile& profile, double y);

}  // namespace tread
