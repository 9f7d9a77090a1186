#pragma once
// Curves over a common abscissa, drawn as SVG.

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace tread {

enum class Stroke { solid, dashed, dotted };

/// A curve. Values that are not finite leave a gap.
struct Series {
  std::string label;
  std::vector<double> x;  ///< abscissae in the unit of the figure's x label
  std::vector<double> y;  ///< as many ordinates, in the unit of the panel's label
  Stroke stroke = Stroke::solid;
  std::optional<int> colour = {};  ///< colour of a quantity in several panels; absent: a colour of its own
};

/// A line across a panel at a value, or across all panels at an abscissa.
struct Marker {
  double at = 0;
  std::string label;
};

/// A shaded range of the abscissa.
struct Band {
  double from = 0;
  double to = 0;
  std::string label;
};

using Range = std::array<double, 2>;

struct Panel {
  std::string y_label;  ///< label with unit: "Force [kN]"
  std::vector<Series> series;
  std::vector<Marker> levels;
  double height = 260;           ///< height of the plot [px of a page 920 px wide]
  std::optional<Range> y_range;  ///< range of the ordinate; absent: the range of curves and levels
};

/// Panels above one another over one abscissa.
struct Figure {
  std::string title;
  std::string x_label;  ///< label with unit
  std::vector<Panel> panels;
  std::vector<Marker> positions;
  std::vector<Band> bands;
  std::optional<Range> x_range;  ///< range of the abscissa; absent: the range of the curves
  std::string caption;
  std::string name = {};  ///< name of its files; empty: it has none
};

/// A `figure` element: title, legend, SVG, caption. chart.js adds reading and zooming.
std::string figure_html(const Figure& figure);

/// The figure as a self-contained SVG file, with title and legend.
std::string figure_svg(const Figure& figure);

/// About `count` values within [low, high], 1, 2 or 5 times a power of ten apart.
std::vector<double> ticks(double low, double high, int count);

}  // namespace tread
