#pragma once
// Fields over a window that moves along a surface: a map, a relief and a slider through time.

#include <cstdint>
#include <string>
#include <vector>

namespace tread {

/// The window at one instant; arrays [station][row].
struct MovieFrame {
  double centre = 0;                       ///< abscissa of the picture's centre [mm]
  std::string note;                        ///< note such as "t = 3.2 ms, ..."
  std::vector<double> x;                   ///< abscissae of the window's stations [mm]
  std::vector<std::vector<float>> fields;  ///< one array per label, 0 or more
  std::vector<std::uint8_t> state;         ///< state: 0 out of contact, 1 sticks, 2 slips
};

struct PatchMovie {
  std::string title;
  std::string x_label, y_label;     ///< labels with units; x is shown relative to the frame's centre
  std::vector<std::string> labels;  ///< labels of the fields, with units
  std::vector<double> y;            ///< ordinates of the rows [mm]
  std::vector<MovieFrame> frames;
  std::string caption;
  std::string name = {};  ///< name of its files; empty: it has none
  bool rolls = true;      ///< true: an arrow shows the direction of rolling
};

/// A `figure` element. patch_movie.js draws it and lets the reader choose instant and field, and turn the
/// relief. Values are kept to 1/255 of a field's largest.
std::string movie_html(const PatchMovie& movie);

/// A self-contained SVG file: maps of all fields at the instant at which the first field is largest.
std::string movie_svg(const PatchMovie& movie);

}  // namespace tread
