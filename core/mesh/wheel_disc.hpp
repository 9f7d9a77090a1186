#pragma once
// Section of a wheel's disc: inner rim, web, brake rings, hub.

#include <vector>

#include "core/mesh/section.hpp"
#include "core/mesh/structured.hpp"
#include "core/mesh/wheel_shape.hpp"

namespace tread {

inline constexpr double kTreadTieDepth = 23e-3;  ///< of the tread's tie below the nominal rolling circle [m]
inline constexpr double kHubTieRadius = 127e-3, kHubLength = 178e-3;  ///< [m]
inline constexpr double kAxleRatio = 2.3;  ///< of the axle's elements to the disc's

/// The web between hub and rim, across the disc's middle plane.
class Web {
 public:
  /// `middle`: y of the middle plane in wheel coordinates [m]. Keeps a reference to the shape.
  Web(const WheelShape& shape, double middle);

  double hub() const { return hub_; }  ///< radius [m]
  double rim() const { return rim_; }  ///< radius [m]

  struct Faces {
    double middle, half;  ///< middle between both, half of their distance [m]
  };
  /// Faces at a radius [m].
  Faces at(double r) const;

 private:
  const WheelShape* shape_;
  double middle_, hub_, rim_;
};

/// Axial lines of the disc, relative to its middle plane.
struct DiscLines {
  std::vector<double> rim, hub;  ///< tie nodes, left to right [m]
  std::vector<double> axle_hub;  ///< tie nodes of the axle [m]
  int web = 0;                   ///< number of columns through the web
};

/// Lines of a disc under a rim of this width [m]. InputError for a web from a file that does not fit between
/// hub and rim.
DiscLines disc_lines(double rim_width, const WheelShape& shape, const Web& web, const SectionSize& size);

/// Disc in (y relative to its middle plane, r), with the paths "tie_outer" and "tie_inner".
Section make_disc(const DiscLines& lines, const WheelShape& shape, const Web& web, const SectionSize& size);

}  // namespace tread
