#pragma once
// Depths on a running surface.

#include <string>
#include <vector>

namespace tread {

/// [surface.NAME]: a shape of depth on the running surface of rail or wheel; all of them are added
struct SurfaceSpec {
  std::string kind = "dip";      ///< "dip", "dent", "waves", "polygon", "flat", "profile" or "map"
  std::string on = "rail";       ///< "rail" or "wheel"; waves are on the rail, polygon and flat on the wheel
  double at = 0;                 ///< x of the middle, or of the zero of waves, profile and map [m]
  double depth = 1e-3;           ///< dip, dent; from crest to trough: waves, polygon [m]
  double length = 0.1;           ///< along: dip, dent, chord of the flat, all waves together [m]
  double width = 0.03;           ///< dent: across [m]
  double centre = 0;             ///< dent, map: y of the middle [m]
  std::string shape = "smooth";  ///< dip: "smooth" or "pointed"
  double wavelength = 1;         ///< waves [m]
  int order = 1;                 ///< polygon: waves around the wheel
  std::string file;              ///< profile: x (or angle) and depth; map: x, y and depth
  std::vector<double> file_x;    ///< profile: increasing; map: each value once, increasing [m]
  std::vector<double> file_y;    ///< map: each value once, increasing [m]
  std::vector<double> file_depth;  ///< positive into the body; map: by row of y [m]

  bool on_wheel() const { return kind == "flat" || kind == "polygon" || (kind != "waves" && on == "wheel"); }
};

}  // namespace tread
