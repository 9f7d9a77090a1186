#pragma once
// Sections of the half wheelset: tread ring, disc (inner rim, web, brake rings, hub) and axle, tied along two
// cylinders.

#include "core/geometry/profiles.hpp"
#include "core/mesh/section.hpp"
#include "core/mesh/structured.hpp"
#include "core/mesh/wheel_shape.hpp"

namespace tread {

/// Sections in (p, q) = (y_wheel - lateral_offset, r). Nodes of tread.paths["tie"] lie on the edges of
/// disc.paths["tie_outer"], those of disc.paths["tie_inner"] on the edges of axle.paths["tie"], nested. All
/// paths run along +p except axle.paths["symmetry_end"], which runs along +r. axle.paths["journal"] holds the
/// outer nodes near the journal's centre.
struct WheelSections {
  Section tread;
  Section disc;
  Section axle;
};

/// Sections of a half wheelset. size.coarse: elements of the disc, 10 ... 15 mm; those of the axle are 2.3
/// times as large. Throws InputError for profiles, diameters, bores and sizes that do not fit.
WheelSections make_wheel_sections(const WheelProfile& profile, const WheelShape& shape,
                                  const SectionSize& size);

/// A ring of radial thickness `thickness` [m] under the whole profile; path "bore" is its inner surface.
Section make_tyre_section(const WheelProfile& profile, double diameter, double lateral_offset,
                          double thickness, const SectionSize& size);

}  // namespace tread
