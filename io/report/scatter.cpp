#include "io/report/scatter.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "io/report/markup.hpp"
#include "io/report/picture.hpp"

namespace tread {

namespace {

// Page geometry [px].
constexpr double kLeft = 58;  // space left of a panel for tick labels
constexpr double kRight = 30;
constexpr double kLabel = 60;    // space at the plot's right end, where labels stand left of their dots
constexpr double kTop = 24;      // space for a panel's title
constexpr double kBottom = 26;   // space for tick labels
constexpr double kHeight = 190;  // height of a plot
constexpr double kFoot = 24;     // space for the label of the abscissa
constexpr double kPlotWidth = kPageWidth / 2 - kLeft - kRight;

bool drawn(const ScatterDot& dot) {
  return std::isfinite(dot.x) && std::isfinite(dot.y) && dot.x > 0 && dot.y > 0;
}

/// A logarithmic axis from a value to a pixel.
struct LogAxis {
  double low = std::numeric_limits<double>::infinity(), high = 0;
  double first = 0, last = 0;  ///< pixels of low and high

  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  /// Widens the range by a little room, or to a decade about 1 if nothing was added.
  void widen() {
    if (low > high) low = high = 1;
    constexpr double kRoom = 1.25;
    low /= kRoom, high *= kRoom;
    constexpr double kLeast = 4;
    if (high < kLeast * low) low /= 2, high *= 2;
  }
  double operator()(double value) const {
    return first + (last - first) * std::log(value / low) / std::log(high / low);
  }
  /// Ticks at 1, 2 and 5 times powers of ten, or at powers alone over many decades.
  std::vector<double> ticks() const {
    std::vector<double> values;
    constexpr double kMany = 1e3;
    for (double decade = std::pow(10.0, std::floor(std::log10(low))); decade <= high; decade *= 10)
      for (const double factor : {1.0, 2.0, 5.0})
        if ((factor == 1 || high < kMany * low) && factor * decade >= low && factor * decade <= high)
          values.push_back(factor * decade);
    return values;
  }
};

struct Axes {
  LogAxis x, y;
};

Axes axes_of(const Scatter& scatter) {
  Axes axes;
  for (const ScatterPanel& panel : scatter.panels)
    for (const ScatterDot& dot : panel.dots)
      if (drawn(dot)) axes.x.add(dot.x), axes.y.add(dot.y);
  axes.x.widen();
  axes.y.widen();
  return axes;
}

std::string frame_svg(const Axes& at) {
  std::string svg;
  for (const double value : at.y.ticks()) {
    svg += svg_line("grid", at.x.first, at.y(value), at.x.last, at.y(value));
    svg += svg_label("tick right", at.x.first - 8, at.y(value) + 4, readable(value));
  }
  for (const double value : at.x.ticks()) {
    svg += svg_line("grid", at.x(value), at.y.first, at.x(value), at.y.last);
    svg += svg_label("tick middle", at.x(value), at.y.first + 18, readable(value));
  }
  return svg + svg_line("axis", at.x.first, at.y.first, at.x.last, at.y.first) +
         svg_line("axis", at.x.first, at.y.first, at.x.first, at.y.last);
}

std::string dots_svg(const ScatterPanel& panel, const Axes& at) {
  std::string path;
  std::string dots;
  bool above = false;
  for (const ScatterDot& dot : panel.dots) {
    if (!drawn(dot)) continue;
    const double x = at.x(dot.x);
    const double y = at.y(dot.y);
    if (dot.marked) path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", x, y);
    dots += fmt::format(
        "<circle class=\"mark {}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.5\"><title>{}</title>"
        "</circle>\n",
        dot.marked ? "full" : "hollow", x, y, html_text(dot.label));
    if (!dot.marked) continue;
    above = !above;  // labels of neighbours stand on either side of the line
    dots += x > at.x.last - kLabel ? svg_label("note right", x - 6, y + 15, dot.label)
                                   : svg_label("note", x + 6, y + (above ? -5 : 15), dot.label);
  }
  return fmt::format("<path class=\"curve c0\" d=\"{}\"/>\n{}", path, dots);
}

/// All panels from the top on.
Picture picture(const Scatter& scatter) {
  Axes axes = axes_of(scatter);
  std::string svg;
  double bottom = 0;
  for (std::size_t i = 0; i < scatter.panels.size(); ++i) {
    const double left = kLeft + (i % 2 == 0 ? 0 : kPageWidth / 2);
    const std::size_t row = i / 2;
    const double top = kTop + static_cast<double>(row) * (kTop + kHeight + kBottom);
    bottom = top + kHeight;
    axes.x.first = left, axes.x.last = left + kPlotWidth;
    axes.y.first = bottom, axes.y.last = top;
    svg += svg_label("name", left, top - 7, scatter.panels[i].title);
    svg += frame_svg(axes) + dots_svg(scatter.panels[i], axes);
  }
  svg += fmt::format("<text class=\"name middle\" transform=\"translate(13 {:.1f}) rotate(-90)\">{}</text>\n",
                     (kTop + bottom) / 2, svg_text(scatter.y_label));
  svg += svg_label("name middle", kPageWidth / 2, bottom + kBottom + 16, scatter.x_label);
  return {svg, bottom + kBottom + kFoot};
}

}  // namespace

std::string scatter_html(const Scatter& scatter) {
  return picture_html(picture(scatter), scatter.title, scatter.caption);
}

std::string scatter_svg(const Scatter& scatter) {
  return picture_svg(picture(scatter), scatter.title, kLeft);
}

}  // namespace tread
