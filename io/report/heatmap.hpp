#pragma once
// A value over two quantities as coloured cells, drawn as SVG.

#include <cstddef>
#include <string>
#include <vector>

#include "io/report/picture.hpp"

namespace tread {

/// A value from another source, drawn over the cells in their colours.
struct HeatDot {
  double x = 0, y = 0;  ///< place in the units of the labels
  double value = 0;
  std::string label;
};

/// A line over the cells.
struct HeatLine {
  std::vector<double> x, y;  ///< points in the units of the labels
  std::string label;         ///< label written at the line's end
};

/// Cells about x and y in order, with borders halfway between neighbours.
struct Heatmap {
  std::string title;
  std::string x_label, y_label, value_label;  ///< labels with units
  std::vector<double> x, y;
  std::vector<double> values;  ///< values row by row: x runs fastest
  std::vector<bool> marked;    ///< as many flags, or none: true for the cells that the outline encloses
  std::string marked_label;    ///< meaning of the outline
  std::vector<HeatLine> lines;
  std::vector<HeatDot> dots;
  std::string caption;
  std::string name = {};  ///< name of its files; empty: it has none

  double at(std::size_t ix, std::size_t iy) const { return values[iy * x.size() + ix]; }
};

/// Borders of the cells about values in order; the outer cells reach as far out as in.
std::vector<double> cell_borders(const std::vector<double>& values);

/// The cells with axes and colour scale, without title and caption.
Picture heatmap_picture(const Heatmap& map);

/// A `figure` element: title, SVG with a colour scale, caption.
std::string heatmap_html(const Heatmap& map);

/// The map as a self-contained SVG file, with its title.
std::string heatmap_svg(const Heatmap& map);

}  // namespace tread
