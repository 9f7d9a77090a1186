#pragma once
// Dots in planes of two logarithmic axes, drawn as SVG.

#include <string>
#include <vector>

namespace tread {

/// A point in the units of both axes, above zero.
struct ScatterDot {
  double x = 0, y = 0;
  std::string label;    ///< label shown where the reader points; written beside a marked dot
  bool marked = false;  ///< true for a full dot, joined with the other marked ones in their order
};

struct ScatterPanel {
  std::string title;
  std::vector<ScatterDot> dots;
};

/// Panels side by side in two columns over common axes.
struct Scatter {
  std::string title;
  std::string x_label, y_label;  ///< labels with units
  std::vector<ScatterPanel> panels;
  std::string caption;
  std::string name = {};  ///< name of its files; empty: it has none
};

/// A `figure` element: title, SVG, caption. Dots that are not above zero are left out.
std::string scatter_html(const Scatter& scatter);

/// The scatter as a self-contained SVG file, with its title.
std::string scatter_svg(const Scatter& scatter);

}  // namespace tread
