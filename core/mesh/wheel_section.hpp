#pragma once
// Sections of the half wheelset: tread ring, disc (inner rim, web, brake rings, hub) and axle, tied along two
// cylinders.

#include "core/geometry/profiles.hpp"
#include "core/mesh/section.hpp"
#include "core/mesh/structured.hpp"

namespace tread {

/// Webs that fit between rim and hub [m].
inline constexpr double kThinnestWeb = 0.01, kThickestWeb = 0.1;
/// Largest offset and wave of a web between them [m].
inline constexpr double kMostOffset = 0.04, kMostWave = 0.03;

/// Place across and slope of the web's middle line at a share of its height, from hub to rim.
struct WebLine {
  double p;      ///< from the disc's middle plane, to the field side [m]
  double slope;  ///< dp / d(share) [m]
};

/// A half wheelset of standard gauge. The track's centre plane lies 746.5 mm from the nominal rolling circle,
/// the journal's centre 1000 mm.
struct WheelShape {
  double diameter = 0.86;          ///< diameter of the nominal rolling circle [m]
  double lateral_offset = 6.5e-3;  ///< rail centre line in wheel coordinates, positive to the field side [m]
  double axle_bore = 0.060;        ///< diameter of the bore [m]
  double web_thickness = 0.030;    ///< normal to its middle line [m]
  double web_offset = 0;           ///< of its middle line at the rim to the field side of that at the hub [m]
  double web_wave = 0;             ///< largest way of its middle line to either side, as an S [m]
  double brake_ring_thickness = 0;  ///< thickness of each of the two rings bolted to the web; 0: none [m]

  /// Middle line of the web: it leaves hub and rim radially; offset (3 s^2 - 2 s^3 - 1/2) and the S
  /// sin(2 pi s) sin(pi s), `web_wave` at its largest.
  WebLine web_line(double share) const;
  /// InputError for a shape that does not fit.
  void check() const;
};

/// Sections in (p, q) = (y_wheel - lateral_offset, r). Nodes of tread.paths["tie"] lie on the edges of
/// disc.paths["tie_outer"], those of disc.paths["tie_inner"] on the edges of axle.paths["tie"], nested. All
/// paths run along +p except axle.paths["symmetry_end"], which runs along +r. axle.paths["journal"] holds the
/// outer nodes near the journal's centre.
struct WheelSections {
  Section tread;
  Section disc;
  Section axle;
  double tread_tie_radius = 0;  ///< [m]
  double axle_tie_radius = 0;   ///< [m]
};

/// Sections of a half wheelset. size.coarse: elements of the disc, 10 ... 15 mm; those of the axle are 2.3
/// times as large. Throws InputError for profiles, diameters, bores and sizes that do not fit.
WheelSections make_wheel_sections(const WheelProfile& profile, const WheelShape& shape,
                                  const SectionSize& size);

/// A ring of radial thickness `thickness` [m] under the whole profile; path "bore" is its inner surface.
Section make_tyre_section(const WheelProfile& profile, double diameter, double lateral_offset,
                          double thickness, const SectionSize& size);

}  // namespace tread
