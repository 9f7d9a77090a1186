#pragma once
// Flat-bottomed rails from the dimensions of their drawings: 60E1, 60E2 and 49E1 of EN 13674-1.

#include <array>

#include "core/geometry/profiles.hpp"

namespace tread {

/// Dimensions of a symmetric rail [m, rad]. The head consists of three arcs and side faces 1 in 20 from the
/// vertical. Three arcs join the vertical web to the fishing surfaces of head and foot.
struct VignoleRail {
  double height = 0;
  std::array<double, 3> head_radii = {};  ///< crown, shoulder, corner
  double crown_end = 0;                   ///< half width of the crown's arc
  Point2 side_face;                       ///< a point of the right side face, z from the crown
  double head_corner_radius = 0;          ///< lower corner of the head
  double fishing_slope = 0;               ///< of the fishing surfaces [-]
  double head_depth = 0;     ///< crown to the point on the middle line where the head's fishing surfaces meet
  double foot_height = 0;    ///< bottom to the point on the middle line where those of the foot meet
  double web_thickness = 0;  ///< thickness of the straight web
  std::array<double, 3> web_radii = {};   ///< from the web outwards
  std::array<double, 2> web_angles = {};  ///< inclination of the tangents between these arcs
  double foot_width = 0;
  double foot_edge = 0;                        ///< height of the foot's edge, without its roundings
  double foot_edge_slope = 0;                  ///< of the foot's upper side at its edge [-]
  double foot_break_radius = 0;                ///< between the two slopes of the foot
  std::array<double, 2> foot_edge_radii = {};  ///< upper and lower corner of the edge
};

RailProfile vignole_rail(const VignoleRail& rail);

/// 60E1 (UIC 60). Section constants within 0.05 % of the standard's. [EN 13674-1:2011]
RailProfile rail_60e1();

/// 60E2: 60E1 with a head for an inclination of 1:40, radii not confirmed. Constants within 0.05 % of
/// published. [EN 13674-1:2011]
RailProfile rail_60e2();

/// 49E1 (S 49), foot and web fitted, dimensions not confirmed. Section constants within 0.2 % of published.
RailProfile rail_49e1();

}  // namespace tread
