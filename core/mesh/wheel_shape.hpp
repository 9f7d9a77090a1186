#pragma once
// Dimensions of a half wheelset.

#include <optional>
#include <string>
#include <vector>

#include "core/mesh/web_outline.hpp"

namespace tread {

/// Diameters that leave room for rim, brake ring and hub [m].
inline constexpr double kSmallestDiameter = 0.66, kLargestDiameter = 1.4;
/// Bores that leave axle and journal a wall [m].
inline constexpr double kNarrowestBore = 0.02, kWidestBore = 0.11;
/// Largest lateral offset with which the rail lies under the tread [m].
inline constexpr double kMostAside = 0.03;
/// Webs that fit between rim and hub [m].
inline constexpr double kThinnestWeb = 0.01, kThickestWeb = 0.1;
/// Largest offset and wave of a web between them [m].
inline constexpr double kMostOffset = 0.04, kMostWave = 0.03;

/// Place across and slope of the web's middle line at a share of its height, from hub to rim.
struct WebLine {
  double p;      ///< from the disc's middle plane, to the field side [m]
  double slope;  ///< dp / d(share) [m]
};

/// A dimension that does not fit.
struct ShapeFault {
  std::string key;      ///< "wheel.diameter"
  std::string message;  ///< value, range and reason
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
  std::optional<WebOutline> web_outline;  ///< in place of thickness, offset and wave
  double brake_ring_thickness = 0;  ///< thickness of each of the two rings bolted to the web; 0: none [m]

  /// Middle line of the web: it leaves hub and rim radially; offset (3 s^2 - 2 s^3 - 1/2) and the S
  /// sin(2 pi s) sin(pi s), `web_wave` at its largest.
  WebLine web_line(double share) const;
  /// Least thickness of the web [m].
  double thinnest_web() const { return web_outline ? web_outline->least_thickness() : web_thickness; }
  /// Dimensions outside their ranges.
  std::vector<ShapeFault> faults() const;
  /// InputError for the first of the faults.
  void check() const;
};

}  // namespace tread
