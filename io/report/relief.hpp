#pragma once
// A value over two quantities as a surface seen obliquely, drawn as SVG.

#include <string>
#include <vector>

namespace tread {

/// Heights over x and y, both ascending; x runs to the right, y into the picture.
struct Relief {
  std::string title;
  std::string x_label, y_label, value_label;  ///< labels with units
  std::vector<double> x, y;                   ///< two or more values each
  std::vector<double> values;                 ///< values row by row: x runs fastest
};

/// A group of reliefs. One relief fills the width of the page; several stand two in a row.
struct Reliefs {
  std::string title;
  std::vector<Relief> reliefs;
  std::string caption;
};

/// A `figure` element: title, SVG, caption.
std::string reliefs_html(const Reliefs& reliefs);

/// The reliefs as a self-contained SVG file, with its title.
std::string reliefs_svg(const Reliefs& reliefs);

}  // namespace tread
