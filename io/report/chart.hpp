#pragma once
// Curves over a common abscissa, drawn as SVG.

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace tread {

enum class Stroke { solid, dashed, dotted };

/// One curve. Values that are not finite leave a gap.
struct Series {
  std::string label;
  std::vector<double> x;  ///< in the unit of the figure's x label
  std::vector<double> y;  ///< as many, in the unit of the panel's label
  Stroke stroke = Stroke::solid;
  std::optional<int> colour = {};  ///< for what is the same in several panels; absent: one of its own
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
  std::string y_label;  ///< with unit: "Force [kN]"
  std::vector<Series> series;
  std::vector<Marker> levels;
  double height = 260;           ///< of the plot [px of a page 920 px wide]
  std::optional<Range> y_range;  ///< absent: what the curves and levels need
};

/// Panels above one another over one abscissa.
struct Figure {
  std::string title;
  std::string x_label;  ///< with unit
  std::vector<Panel> panels;
  std::vector<Marker> positions;
  std::vector<Band> bands;
  std::optional<Range> x_range;  ///< absent: what the curves need
  std::string caption;
};

/// A `figure` element: title, legend, SVG, caption. chart.js adds reading and zooming.
std::string figure_html(const Figure& figure);

/// The figure as an SVG file that stands alone, title, legend and caption included.
std::string figure_svg(const Figure& figure);

/// Indices of at most about 2 * groups points that keep the smallest and largest value of each of `groups`
/// runs of equal length, both ends, and one of each run's values that are not finite.
std::vector<std::size_t> thinned(std::span<const double> values, std::size_t groups);

/// Values 1, 2 or 5 times a power of ten apart, about `count` of them, within [low, high].
std::vector<double> ticks(double low, double high, int count);

}  // namespace tread
