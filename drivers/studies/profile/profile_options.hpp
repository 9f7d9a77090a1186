#pragma once
// Options of `tread profile`.

#include <filesystem>
#include <string>

namespace tread {

struct ProfileOptions {
  std::string file;                  ///< a file, or the name of a built-in profile
  bool wheel = false;                ///< the file holds a wheel; neither: by name, suffix or content
  bool rail = false;                 ///< the file holds a rail
  std::string against;               ///< the other body's file or built-in profile; empty: none
  std::string smoothing = "0 mm";    ///< largest deviation of a smoothing spline
  std::string shift = "0 mm";        ///< added to y
  bool mirrored = false;             ///< a rail's y counts to the gauge side
  std::string section = "CN60";      ///< rail that a head from a file belongs to
  std::string inclination = "1:40";  ///< of the rail, for the contact
  std::filesystem::path output;      ///< clean two columns; empty: none
  std::filesystem::path svg;         ///< picture; empty: none
  bool json = false;
};

}  // namespace tread
