#pragma once
// Pictures and tables of `tread profile`.

#include <vector>

#include "core/geometry/touching.hpp"
#include "drivers/studies/profile/shown_profile.hpp"
#include "io/report/chart.hpp"

namespace tread {

/// Surface, points of the file, curvature and deviation of the smoothing over y.
Figure profile_figure(const ShownProfile& profile);

/// A place of contact and the rail's middle in wheel coordinates that leads to it [m].
struct TouchingAt {
  double lateral_offset = 0;
  Touching place;
};

/// First contact of wheel and rail for lateral offsets from -10 to 15 mm, every `step` [m].
std::vector<TouchingAt> touching_over_offset(const ShownProfile& rail, double inclination,
                                             const ShownProfile& wheel, double step);

/// Places on rail and wheel and the slope over the lateral offset.
Figure touching_figure(const std::vector<TouchingAt>& places, const ShownProfile& rail,
                       const ShownProfile& wheel);

}  // namespace tread
