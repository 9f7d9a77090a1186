#include "io/report/chart.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "io/report/markup.hpp"
#include "io/report/picture.hpp"
#include "io/report/thinning.hpp"

namespace tread {

namespace {

// Page geometry [px].
constexpr double kLeft = 72;
constexpr double kRight = 14;
constexpr double kTop = 18;     // space for the labels of bands and positions
constexpr double kGap = 16;     // space between panels
constexpr double kBottom = 46;  // space for tick labels and the label of the abscissa
constexpr double kLine = 20;    // height of a line of the legend
constexpr std::size_t kGroups = 1000;
constexpr int kColours = 6;

/// Returns true if the values differ by more than rounding.
bool is_range(double low, double high) {
  constexpr double kSameValue = 1e-12;  // difference by size
  return high - low > kSameValue * std::max(std::abs(low), std::abs(high));
}

/// A linear map from values to pixels.
struct Scale {
  Range value;
  Range pixel;
  double operator()(double v) const {
    return pixel[0] + (v - value[0]) / (value[1] - value[0]) * (pixel[1] - pixel[0]);
  }
};

struct Extent {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  void add(double v) {
    if (!std::isfinite(v)) return;
    low = std::min(low, v);
    high = std::max(high, v);
  }
  /// Range of positive length, for any added values.
  Range range() const {
    if (low > high) return {0, 1};
    if (is_range(low, high)) return {low, high};
    const double room = low == 0 ? 1 : std::abs(low) / 10;
    return {low - room, high + room};
  }
};

double tick_step(double low, double high, int count) {
  const double rough = (high - low) / count;
  const double decade = std::pow(10.0, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * decade >= rough * 0.999) return factor * decade;
  return 10 * decade;
}

int tick_count(double height) {
  return std::max(3, static_cast<int>(height / 45));
}

Range x_range(const Figure& figure) {
  Extent extent;
  if (figure.x_range) {  // a wheel that rolls back ends before its start
    for (const double x : *figure.x_range) extent.add(x);
    return extent.range();
  }
  for (const Panel& panel : figure.panels)
    for (const Series& series : panel.series)
      for (const double x : series.x) extent.add(x);
  return extent.range();
}

/// Range of the visible values and levels, widened to whole ticks.
Range y_range(const Panel& panel, const Range& x) {
  if (panel.y_range) return *panel.y_range;
  Extent extent;
  for (const Series& series : panel.series)
    for (std::size_t i = 0; i < series.x.size(); ++i)
      if (series.x[i] >= x[0] && series.x[i] <= x[1]) extent.add(series.y[i]);
  for (const Marker& level : panel.levels) extent.add(level.at);
  const Range range = extent.range();
  Range whole = range;
  double step = 0;  // a wider range may need larger steps
  for (double next = 0; (next = tick_step(whole[0], whole[1], tick_count(panel.height))) > step;) {
    step = next;
    whole = {std::floor(range[0] / step + 1e-9) * step, std::ceil(range[1] / step - 1e-9) * step};
  }
  return whole;
}

/// Writes tick values with the digits that their spacing needs, over a common power of ten.
class TickFormat {
 public:
  explicit TickFormat(const std::vector<double>& values) {
    double largest = 0;
    for (const double v : values) largest = std::max(largest, std::abs(v));
    if (largest >= 1e5 || (largest > 0 && largest < 1e-2))
      exponent_ = 3 * static_cast<int>(std::floor(std::log10(largest) / 3));
    const double step = values.size() < 2 ? largest : (values[1] - values[0]) * std::pow(10.0, -exponent_);
    if (step > 0) decimals_ = std::max(0, -static_cast<int>(std::floor(std::log10(step) + 1e-9)));
  }
  std::string operator()(double v) const {
    const double scaled = v * std::pow(10.0, -exponent_);
    return (v < 0 ? "−" : "") + fmt::format("{:.{}f}", std::abs(scaled), decimals_);
  }
  /// Factor for the axis label: " × 10⁶", or an empty text.
  std::string factor_text() const { return exponent_ == 0 ? "" : " × " + power_of_ten(exponent_); }
  double factor() const { return std::pow(10.0, exponent_); }

 private:
  int exponent_ = 0;
  int decimals_ = 0;
};

const char* stroke_class(Stroke stroke) {
  switch (stroke) {
    case Stroke::dashed:
      return "dashed";
    case Stroke::dotted:
      return "dotted";
    default:
      return "solid";
  }
}

/// Data of SVG paths: a curve, and dots where a point has no neighbour.
struct CurvePaths {
  std::string line;
  std::string dots;
};

/// Paths of the curve inside the range and of one point beyond on either side, thinned.
CurvePaths curve_paths(const Series& series, const Scale& x, const Scale& y) {
  const auto inside = [&](std::size_t i) {
    return i < series.x.size() && series.x[i] >= x.value[0] && series.x[i] <= x.value[1];
  };
  std::vector<double> xs;
  std::vector<double> ys;
  for (std::size_t i = 0; i < series.x.size(); ++i)
    if (inside(i) || inside(i + 1) || (i > 0 && inside(i - 1))) {
      xs.push_back(series.x[i]);
      ys.push_back(series.y[i]);
    }
  const std::vector<std::size_t> kept = thinned(ys, kGroups);
  const auto drawn = [&](std::size_t k) {
    return k < kept.size() && std::isfinite(xs[kept[k]]) && std::isfinite(ys[kept[k]]);
  };
  CurvePaths paths;
  for (std::size_t k = 0; k < kept.size(); ++k) {
    if (!drawn(k)) continue;
    const bool pen_down = k > 0 && drawn(k - 1);
    const std::string place = fmt::format("{:.2f} {:.2f}", x(xs[kept[k]]), y(ys[kept[k]]));
    paths.line += (pen_down ? "L" : "M") + place;
    if (!pen_down && !drawn(k + 1)) paths.dots += fmt::format("M{}h0", place);
  }
  return paths;
}

struct Layout {
  Scale x;
  double top = 0;     ///< top of the panel [px]
  double bottom = 0;  ///< bottom of the panel [px]
  int first_series = 0;
};

/// Colour of the figure's curve with that number.
std::string curve_colour(const Series& series, int number) {
  return fmt::format("c{}", series.colour.value_or(number) % kColours);
}

/// Style of the figure's curve with that number.
std::string curve_style(const Series& series, int number) {
  return fmt::format("curve {} {}", curve_colour(series, number), stroke_class(series.stroke));
}

/// Clips the content to a window and leaves its coordinates unchanged.
std::string clipped(double top, double bottom, const std::string& content) {
  return fmt::format(
      "<svg x=\"{0:.1f}\" y=\"{1:.1f}\" width=\"{2:.1f}\" height=\"{3:.1f}\" "
      "viewBox=\"{0:.1f} {1:.1f} {2:.1f} {3:.1f}\"><g class=\"moves\">\n{4}</g></svg>\n",
      kLeft, top, kPageWidth - kLeft - kRight, bottom - top, content);
}

std::string curves_svg(const Panel& panel, const Layout& at, const Scale& y) {
  std::string svg;
  int number = at.first_series;
  for (const Series& series : panel.series) {
    const CurvePaths paths = curve_paths(series, at.x, y);
    svg += fmt::format("<path class=\"{}\" data-name=\"{}\" d=\"{}\"/>\n", curve_style(series, number),
                       html_escaped(series.label), paths.line);
    if (!paths.dots.empty())
      svg += fmt::format(
          "<path class=\"{}\" stroke-width=\"6\" stroke-linecap=\"round\" "
          "vector-effect=\"non-scaling-stroke\" d=\"{}\"/>\n",
          curve_colour(series, number), paths.dots);
    ++number;
  }
  return clipped(at.top, at.bottom, svg);
}

std::string panel_svg(const Panel& panel, const Layout& at) {
  const Scale y{y_range(panel, at.x.value), {at.bottom, at.top}};
  std::string svg = fmt::format(
      "<g class=\"panel\" data-label=\"{}\" data-low=\"{:.9g}\" data-high=\"{:.9g}\" data-top=\"{:.1f}\" "
      "data-bottom=\"{:.1f}\">\n",
      html_escaped(panel.y_label), y.value[0], y.value[1], at.top, at.bottom);
  const std::vector<double> values = ticks(y.value[0], y.value[1], tick_count(panel.height));
  const TickFormat format(values);
  for (const double v : values) {
    svg += svg_line("grid", kLeft, y(v), kPageWidth - kRight, y(v));
    svg += svg_label("tick right", kLeft - 8, y(v) + 4, format(v));
  }
  svg += curves_svg(panel, at, y);
  for (const Marker& level : panel.levels)
    svg += svg_line("level", kLeft, y(level.at), kPageWidth - kRight, y(level.at));
  svg += svg_line("axis", kLeft, at.top, kLeft, at.bottom) +
         svg_line("axis", kLeft, at.bottom, kPageWidth - kRight, at.bottom);
  svg += fmt::format("<text class=\"name middle\" transform=\"translate(15 {:.1f}) rotate(-90)\">{}</text>\n",
                     (at.top + at.bottom) / 2, svg_text(panel.y_label + format.factor_text()));
  return svg + "</g>\n";
}

std::string abscissa_svg(const Figure& figure, const Scale& x, double bottom) {
  const std::vector<double> values = ticks(x.value[0], x.value[1], 9);
  const TickFormat format(values);
  std::string svg = fmt::format("<g class=\"abscissa\" data-label=\"{}\" data-factor=\"{:g}\">\n",
                                html_escaped(figure.x_label), format.factor());
  for (const double v : values) {
    svg += svg_line("axis xtick", x(v), bottom, x(v), bottom + 5);
    svg += svg_label("tick middle xtick", x(v), bottom + 18, format(v));
  }
  svg += svg_label("name middle", (kLeft + kPageWidth - kRight) / 2, bottom + 38,
                   figure.x_label + format.factor_text());
  return svg + "</g>\n";
}

std::string bands_svg(const Figure& figure, const Scale& x, double bottom) {
  std::string shapes;
  std::string labels;
  const auto note = [&](double at, const std::string& text) {
    if (at > kLeft && at < kPageWidth - kRight)
      labels += svg_label("note middle follows", at, kTop - 5, text);
  };
  for (const Band& band : figure.bands) {
    shapes +=
        fmt::format("<rect class=\"band\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"/>\n",
                    x(band.from), kTop, x(band.to) - x(band.from), bottom - kTop);
    note((std::max(x(band.from), kLeft) + std::min(x(band.to), kPageWidth - kRight)) / 2, band.label);
  }
  for (const Marker& position : figure.positions) {
    shapes += svg_line("position", x(position.at), kTop, x(position.at), bottom);
    note(x(position.at), position.label);
  }
  return clipped(kTop, bottom, shapes) + labels;
}

/// A line of the legend.
struct Key {
  std::string style;
  std::string label;
  const char* output;  ///< element for the curve's value; empty: a level
};

/// Keys of the curves and of the levels that have labels, by panel.
std::vector<std::vector<Key>> keys(const Figure& figure) {
  std::vector<std::vector<Key>> all;
  int number = 0;
  for (const Panel& panel : figure.panels) {
    std::vector<Key>& keys = all.emplace_back();
    for (const Series& series : panel.series)
      keys.push_back({curve_style(series, number++), series.label, "<output></output>"});
    for (const Marker& level : panel.levels)
      if (!level.label.empty()) keys.push_back({"level", level.label, ""});
  }
  return all;
}

/// Legend. Its first key shows the abscissa while a reader points at the chart; curves have an output for
/// their value.
std::string legend_html(const Figure& figure) {
  std::string html = "<span class=\"key at\"><output></output></span>\n";
  for (const std::vector<Key>& panel : keys(figure))
    for (const Key& key : panel)
      html += fmt::format(
          "<span class=\"key\"><svg width=\"26\" height=\"8\"><path class=\"{}\" d=\"M0 "
          "4H26\"/></svg>{}{}</span>\n",
          key.style, html_text(key.label), key.output);
  return "<div class=\"legend\">\n" + html + "</div>\n";
}

}  // namespace

std::vector<double> ticks(double low, double high, int count) {
  if (!is_range(low, high)) return {low};
  const double step = tick_step(low, high, count);
  std::vector<double> values;
  for (double i = std::ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; ++i)
    values.push_back(i == 0 ? 0.0 : i * step);
  return values;
}

namespace {

/// Panels one below another from y = kTop on, and the bottom of the last one.
struct Plot {
  Scale x;
  double bottom;
  std::string shapes;
};

Plot plot(const Figure& figure) {
  for (const Panel& panel : figure.panels)
    for (const Series& series : panel.series)
      if (series.x.size() != series.y.size())
        throw std::logic_error("figure '" + figure.title + "': x and y of '" + series.label +
                               "' differ in length");

  const Scale x{x_range(figure), {kLeft, kPageWidth - kRight}};
  std::string panels;
  Layout at{x, kTop, kTop, 0};
  for (const Panel& panel : figure.panels) {
    if (at.bottom > kTop) at.top = at.bottom + kGap;
    at.bottom = at.top + panel.height;
    panels += panel_svg(panel, at);
    at.first_series += static_cast<int>(panel.series.size());
  }
  return {x, at.bottom, bands_svg(figure, x, at.bottom) + panels + abscissa_svg(figure, x, at.bottom)};
}

struct Legend {
  std::string svg;
  double bottom;  ///< [px]
};

/// Legend below y. It has as many columns as the longest label allows, and one column per panel if these
/// suffice.
Legend legend_svg(const Figure& figure, double y) {
  constexpr double kLetter = 7;  ///< average width of the widest letters [px]
  constexpr double kLead = 46;
  const std::vector<std::vector<Key>> all = keys(figure);
  std::size_t longest = 1;
  for (const std::vector<Key>& panel : all)
    for (const Key& key : panel) longest = std::max(longest, key.label.size());
  const double room = kPageWidth - kLeft - kRight;
  const int fit = std::max(1, static_cast<int>(room / (kLead + kLetter * static_cast<double>(longest))));
  const bool by_panel = std::ssize(all) <= fit;
  const int columns = by_panel ? std::max(1, static_cast<int>(all.size())) : fit;
  Legend legend{"", y};
  int place = 0;
  for (std::size_t p = 0; p < all.size(); ++p) {
    int row = 0;
    for (const Key& key : all[p]) {
      const double left = kLeft + room / columns * (by_panel ? static_cast<int>(p) : place % columns);
      const double base = y + kLine * (1 + (by_panel ? row++ : place++ / columns));
      legend.bottom = std::max(legend.bottom, base);
      legend.svg += fmt::format(
          "<path class=\"{}\" d=\"M{:.0f} {:.0f}h26\"/><text x=\"{:.0f}\" y=\"{:.0f}\">{}</text>\n",
          key.style, left, base - 4, left + 34, base, svg_text(key.label));
    }
  }
  return legend;
}

}  // namespace

std::string figure_html(const Figure& figure) {
  const Plot drawn = plot(figure);
  return fmt::format(
      "<figure class=\"chart\">\n<figcaption>{}</figcaption>\n{}"
      "<svg viewBox=\"0 0 {:.0f} {:.0f}\" data-low=\"{:.9g}\" data-high=\"{:.9g}\" data-left=\"{:.0f}\" "
      "data-right=\"{:.0f}\">\n{}</svg>\n{}</figure>\n",
      html_text(figure.title), legend_html(figure), kPageWidth, drawn.bottom + kBottom, drawn.x.value[0],
      drawn.x.value[1], kLeft, kPageWidth - kRight, drawn.shapes, caption_html(figure.caption));
}

std::string figure_svg(const Figure& figure) {
  const Plot drawn = plot(figure);
  std::string head = fmt::format("<text x=\"{:.0f}\" y=\"{:.0f}\" font-weight=\"bold\">{}</text>\n", kLeft,
                                 kLine, svg_text(figure.title));
  const Legend legend = legend_svg(figure, kLine);
  head += legend.svg;
  const double height = legend.bottom + drawn.bottom + kBottom;
  return svg_file(
      kPageWidth, height,
      fmt::format("{}<g transform=\"translate(0 {:.0f})\">\n{}</g>\n", head, legend.bottom, drawn.shapes));
}

}  // namespace tread
