#include "io/report/heatmap.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <stdexcept>

#include "io/report/chart.hpp"
#include "io/report/markup.hpp"
#include "io/report/shades.hpp"

namespace tread {

namespace {

// Page geometry [px].
constexpr double kLeft = 72;
constexpr double kTop = 18;
constexpr double kPlotWidth = 700;
constexpr double kPlotHeight = 420;
constexpr double kBottom = 46;
constexpr double kScaleLeft = kLeft + kPlotWidth + 52;  // left border of the colour scale
constexpr double kScaleWidth = 18;
constexpr int kShades = 48;  // number of shades of the colour scale

class Plot {
 public:
  explicit Plot(const Heatmap& map) : map_(map), along_(cell_borders(map.x)), up_(cell_borders(map.y)) {
    if (map.values.size() != map.x.size() * map.y.size() ||
        (!map.marked.empty() && map.marked.size() != map.values.size()))
      throw std::logic_error("heatmap '" + map.title + "': a value per cell is needed");
    low_ = high_ = map.values.front();
    const auto add = [this](double v) {
      low_ = std::min(low_, v);
      high_ = std::max(high_, v);
    };
    for (const double v : map.values) add(v);
    for (const HeatDot& dot : map.dots) add(dot.value);
    if (high_ == low_) high_ = low_ + 1;
  }

  std::string shapes() const {
    return "<g shape-rendering=\"crispEdges\">\n" + drawn_cells() + "</g>\n" + outline() + lines() + axes() +
           scale() + dots();
  }

 private:
  double x(double v) const {
    return kLeft + kPlotWidth * (v - along_.front()) / (along_.back() - along_.front());
  }
  double y(double v) const {
    return kTop + kPlotHeight * (1 - (v - up_.front()) / (up_.back() - up_.front()));
  }
  double share(double value) const { return (value - low_) / (high_ - low_); }

  std::string drawn_cells() const {
    std::string out;
    for (std::size_t j = 0; j < map_.y.size(); ++j)
      for (std::size_t i = 0; i < map_.x.size(); ++i) {
        const double left = x(along_[i]);
        const double top = y(up_[j + 1]);
        out +=
            fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"{}\"/>\n",
                        left, top, x(along_[i + 1]) - left, y(up_[j]) - top, shade(share(map_.at(i, j))));
      }
    return out;
  }

  /// Outline between marked and unmarked cells.
  std::string outline() const {
    if (map_.marked.empty()) return {};
    const std::size_t nx = map_.x.size();
    const auto marked = [&](std::size_t i, std::size_t j) { return map_.marked[j * nx + i]; };
    std::string path;
    for (std::size_t j = 0; j < map_.y.size(); ++j)
      for (std::size_t i = 0; i < nx; ++i) {
        if (i + 1 < nx && marked(i, j) != marked(i + 1, j))
          path += fmt::format("M{:.1f} {:.1f}V{:.1f}", x(along_[i + 1]), y(up_[j]), y(up_[j + 1]));
        if (j + 1 < map_.y.size() && marked(i, j) != marked(i, j + 1))
          path += fmt::format("M{:.1f} {:.1f}H{:.1f}", x(along_[i]), y(up_[j + 1]), x(along_[i + 1]));
      }
    return "<path class=\"outline\" d=\"" + path + "\"/>\n";
  }

  std::string lines() const {
    std::string out;
    for (const HeatLine& line : map_.lines) {
      std::string path;
      double end_x = 0, end_y = 0;
      for (std::size_t i = 0; i < line.x.size(); ++i) {
        const double px = x(line.x[i]);
        const double py = y(line.y[i]);
        if (px < kLeft - 0.01 || px > kLeft + kPlotWidth + 0.01 || py < kTop - 0.01 ||
            py > kTop + kPlotHeight + 0.01)
          continue;
        path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", px, py);
        end_x = px;
        end_y = py;
      }
      if (path.empty()) continue;
      // The label stands beside the plot if the line leaves near the right border, else above the plot.
      const bool right = end_x > kLeft + kPlotWidth - 20;
      out += "<path class=\"position\" fill=\"none\" d=\"" + path + "\"/>\n";
      out += fmt::format("<text class=\"note{}\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n",
                         right ? "" : " middle", right ? kLeft + kPlotWidth + 3 : end_x,
                         right ? end_y + 4 : kTop - 5, svg_text(line.label));
    }
    return out;
  }

  std::string axes() const {
    const double bottom = kTop + kPlotHeight;
    std::string out =
        fmt::format("<path class=\"axis\" fill=\"none\" d=\"M{0:.0f} {1:.0f}V{2:.0f}H{3:.0f}\"/>\n", kLeft,
                    kTop, bottom, kLeft + kPlotWidth);
    for (const double v : ticks(map_.x.front(), map_.x.back(), 10))
      out += fmt::format(
          "<path class=\"axis\" d=\"M{0:.1f} {1:.0f}v5\"/><text class=\"tick middle\" "
          "x=\"{0:.1f}\" y=\"{2:.0f}\">{3}</text>\n",
          x(v), bottom, bottom + 18, readable(v));
    for (const double v : ticks(map_.y.front(), map_.y.back(), 8))
      out += fmt::format(
          "<path class=\"axis\" d=\"M{0:.0f} {1:.1f}h-5\"/><text class=\"tick right\" "
          "x=\"{2:.0f}\" y=\"{3:.1f}\">{4}</text>\n",
          kLeft, y(v), kLeft - 8, y(v) + 4, readable(v));
    out += fmt::format("<text class=\"name middle\" x=\"{:.0f}\" y=\"{:.0f}\">{}</text>\n",
                       kLeft + kPlotWidth / 2, bottom + 38, svg_text(map_.x_label));
    out +=
        fmt::format("<text class=\"name middle\" transform=\"translate(16 {:.0f}) rotate(-90)\">{}</text>\n",
                    kTop + kPlotHeight / 2, svg_text(map_.y_label));
    return out;
  }

  std::string scale() const {
    std::string out = "<g shape-rendering=\"crispEdges\">\n";
    const double height = kPlotHeight / kShades;
    for (int i = 0; i < kShades; ++i)
      out += fmt::format("<rect x=\"{:.0f}\" y=\"{:.2f}\" width=\"{:.0f}\" height=\"{:.2f}\" fill=\"{}\"/>\n",
                         kScaleLeft, kTop + kPlotHeight - (i + 1) * height, kScaleWidth, height,
                         shade((i + 0.5) / kShades));
    out += "</g>\n";
    for (const double v : ticks(low_, high_, 8))
      out += fmt::format("<text class=\"tick\" x=\"{:.0f}\" y=\"{:.1f}\">{}</text>\n",
                         kScaleLeft + kScaleWidth + 5, kTop + kPlotHeight * (1 - share(v)) + 4, readable(v));
    out += fmt::format(
        "<text class=\"name middle\" transform=\"translate({:.0f} {:.0f}) rotate(-90)\">{}</text>\n",
        kScaleLeft + kScaleWidth + 48, kTop + kPlotHeight / 2, svg_text(map_.value_label));
    return out;
  }

  std::string dots() const {
    std::string out;
    for (const HeatDot& dot : map_.dots)
      out += fmt::format(
          "<circle class=\"dot\" cx=\"{0:.1f}\" cy=\"{1:.1f}\" r=\"7\" fill=\"{2}\"/><text class=\"dot\" "
          "x=\"{3:.1f}\" y=\"{4:.1f}\">{5}</text>\n",
          x(dot.x), y(dot.y), shade(share(dot.value)), x(dot.x) + 11, y(dot.y) + 4, svg_text(dot.label));
    return out;
  }

  const Heatmap& map_;
  std::vector<double> along_, up_;  ///< borders of the cells, in the units of the labels
  double low_ = 0, high_ = 1;
};

}  // namespace

std::vector<double> cell_borders(const std::vector<double>& values) {
  if (values.size() == 1) return {values.front() - 0.5, values.front() + 0.5};
  std::vector<double> borders = {1.5 * values[0] - 0.5 * values[1]};
  for (std::size_t i = 1; i < values.size(); ++i) borders.push_back(0.5 * (values[i - 1] + values[i]));
  borders.push_back(2 * values.back() - borders.back());
  return borders;
}

Picture heatmap_picture(const Heatmap& map) {
  return {Plot(map).shapes(), kTop + kPlotHeight + kBottom};
}

std::string heatmap_html(const Heatmap& map) {
  const std::string legend = map.marked_label.empty() ? ""
                                                      : "<div class=\"legend\"><span class=\"key\"><svg "
                                                        "width=\"26\" height=\"8\"><path class=\"outline\" "
                                                        "d=\"M0 4H26\"/></svg>" +
                                                            html_text(map.marked_label) + "</span></div>\n";
  return picture_html(heatmap_picture(map), map.title, map.caption, legend);
}

std::string heatmap_svg(const Heatmap& map) {
  std::string legend;
  if (!map.marked_label.empty())
    legend =
        fmt::format("<path class=\"outline\" d=\"M{0:.0f} 14h26\"/><text x=\"{1:.0f}\" y=\"18\">{2}</text>\n",
                    kLeft + kPlotWidth - 210, kLeft + kPlotWidth - 178, svg_text(map.marked_label));
  return picture_svg(heatmap_picture(map), map.title, kLeft, legend);
}

}  // namespace tread
