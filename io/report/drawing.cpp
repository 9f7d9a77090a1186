#include "io/report/drawing.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "io/report/chart.hpp"
#include "io/report/markup.hpp"
#include "io/report/picture.hpp"

namespace tread {

namespace {

constexpr int kColours = 4;
constexpr double kMargin = 8;  ///< [px]
constexpr double kKey = 17;    ///< height of a key of the legend in an SVG file [px]
constexpr double kBar = 26;    ///< height of the strip that holds the scale bar [px]

Window bounds(const std::vector<Layer>& layers) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  Window window{{kFar, kFar}, {-kFar, -kFar}};
  for (const Layer& layer : layers)
    for (const auto* polygons : {&layer.cells, &layer.lines})
      for (const Polygon& polygon : *polygons)
        for (const auto& point : polygon)
          for (std::size_t i = 0; i < 2; ++i) {
            window.low[i] = std::min(window.low[i], point[i]);
            window.high[i] = std::max(window.high[i], point[i]);
          }
  if (window.low[0] > window.high[0]) return {{0, 0}, {1, 1}};
  return window;
}

/// Map from metres to pixels, y upwards.
struct View {
  Window window;
  double scale;
  std::string point(const std::array<double, 2>& p) const {
    return fmt::format("{:.1f} {:.1f}", kMargin + (p[0] - window.low[0]) * scale,
                       kMargin + (window.high[1] - p[1]) * scale);
  }
};

std::string path_data(const std::vector<Polygon>& polygons, const View& view, const char* end) {
  std::string data;
  for (const Polygon& polygon : polygons) {
    if (polygon.empty() || !touches(polygon, view.window)) continue;
    char pen = 'M';
    for (const auto& point : polygon) {
      data += pen + view.point(point);
      pen = 'L';
    }
    data += end;
  }
  return data;
}

std::string length_text(double metres) {
  return metres < 1 ? fmt::format("{:g} mm", metres * 1000) : fmt::format("{:g} m", metres);
}

std::string scale_bar(const View& view, double bottom) {
  const std::vector<double> marks = ticks(0, view.window.high[0] - view.window.low[0], 6);
  if (marks.size() < 2) return {};  // a window without width
  const double length = marks[1];
  const double right = kMargin + length * view.scale;
  return fmt::format(
      "<path class=\"bar\" d=\"M{0:.1f} {1:.1f}v6h{2:.1f}v-6\"/><text class=\"tick\" x=\"{3:.1f}\" "
      "y=\"{4:.1f}\">{5}</text>\n",
      kMargin, bottom - 12, length * view.scale, right + 6, bottom - 5, length_text(length));
}

std::string legend_html(const std::vector<Layer>& layers) {
  std::string html;
  int colour = 0;
  for (const Layer& layer : layers)
    html += fmt::format(
        "<span class=\"key\"><svg width=\"14\" height=\"10\"><rect class=\"cells d{}\" width=\"14\" "
        "height=\"10\"/></svg>{}</span>\n",
        colour++ % kColours, html_text(layer.label));
  return "<div class=\"legend\">" + html + "</div>\n";
}

/// A drawing as an `svg` element with its scale bar.
struct DrawnMesh {
  std::string svg;
  double width, height;  ///< [px]
};

DrawnMesh drawn(const Drawing& drawing) {
  const Window window = drawing.window ? *drawing.window : bounds(drawing.layers);
  const double width = std::max(window.high[0] - window.low[0], 1e-9);
  const View view{window, (drawing.width - 2 * kMargin) / width};
  const double height = 2 * kMargin + (window.high[1] - window.low[1]) * view.scale;
  std::string shapes;
  int colour = 0;
  for (const Layer& layer : drawing.layers) {
    shapes += fmt::format("<path class=\"cells d{}\" d=\"{}\"/>\n", colour % kColours,
                          path_data(layer.cells, view, "Z"));
    shapes += fmt::format("<path class=\"lines d{}\" d=\"{}\"/>\n", colour++ % kColours,
                          path_data(layer.lines, view, ""));
  }
  return {
      fmt::format("<svg viewBox=\"0 0 {0:.0f} {1:.1f}\"><svg width=\"{0:.0f}\" height=\"{2:.1f}\">\n{3}</svg>"
                  "{4}</svg>\n",
                  drawing.width, height + kBar, height, shapes, scale_bar(view, height + kBar)),
      drawing.width, height + kBar};
}

/// Legend of a drawing in an SVG file, one key below another from `top` on.
std::string legend_svg(const std::vector<Layer>& layers, double left, double top) {
  std::string svg;
  int colour = 0;
  for (const Layer& layer : layers) {
    svg += fmt::format(
        "<rect class=\"cells d{}\" x=\"{:.0f}\" y=\"{:.1f}\" width=\"14\" height=\"10\"/>"
        "<text x=\"{:.0f}\" y=\"{:.1f}\">{}</text>\n",
        colour % kColours, left, top + kKey * colour, left + 20, top + kKey * colour + 9,
        svg_text(layer.label));
    ++colour;
  }
  return svg;
}

}  // namespace

bool touches(const Polygon& polygon, const Window& window) {
  for (std::size_t i = 0; i < 2; ++i) {
    const auto [low, high] = std::minmax_element(polygon.begin(), polygon.end(),
                                                 [i](const auto& a, const auto& b) { return a[i] < b[i]; });
    if ((*high)[i] < window.low[i] || (*low)[i] > window.high[i]) return false;
  }
  return true;
}

Layer section_layer(std::string label, const Section& section, Sweep sweep, std::array<double, 2> origin) {
  Layer layer{std::move(label), {}, {}};
  const double up = sweep == Sweep::extruded ? 1 : -1;
  for (const auto& quad : section.quads) {
    Polygon polygon;
    for (const int node : quad) {
      const auto n = static_cast<std::size_t>(node);
      polygon.push_back({origin[0] + section.p[n], origin[1] + up * section.q[n]});
    }
    layer.cells.push_back(std::move(polygon));
  }
  return layer;
}

Layer side_layer(std::string label, const SweptBlock& block, const Vec3& origin) {
  Layer layer{std::move(label), {}, {}};
  const auto [low, high] = std::minmax_element(block.section.q.begin(), block.section.q.end());
  Polygon along_low;
  Polygon along_high;
  for (const double s : block.stations) {
    const auto at = [&](double q) -> std::array<double, 2> {
      if (block.sweep == Sweep::extruded) return {origin.x + s, origin.z + q};
      return {origin.x - q * std::sin(s), origin.z - q * std::cos(s)};
    };
    along_low.push_back(at(*low));
    along_high.push_back(at(*high));
    layer.lines.push_back({along_low.back(), along_high.back()});
  }
  if (block.closed) {
    along_low.push_back(along_low.front());
    along_high.push_back(along_high.front());
  }
  layer.lines.push_back(std::move(along_low));
  layer.lines.push_back(std::move(along_high));
  return layer;
}

std::string drawing_html(const Drawing& drawing) {
  return fmt::format(
      "<figure class=\"drawing\" "
      "style=\"flex-basis:{:.0f}px\">\n<figcaption>{}</figcaption>\n{}{}</figure>\n",
      drawing.width, html_text(drawing.title), drawn(drawing).svg, legend_html(drawing.layers));
}

std::string drawings_svg(const Drawings& drawings) {
  constexpr double kTitle = 24;
  constexpr double kGap = 24;
  std::string shapes;
  double left = 0, top = 0, bottom = 0, right = kPageWidth;
  for (const Drawing& drawing : drawings.drawings) {
    const DrawnMesh mesh = drawn(drawing);
    if (left > 0 && left + mesh.width > kPageWidth) left = 0, top = bottom;
    shapes += fmt::format(
        "<text x=\"{0:.1f}\" y=\"{1:.1f}\" font-weight=\"bold\">{2}</text>\n"
        "<svg x=\"{3:.1f}\" y=\"{4:.1f}\" width=\"{5:.1f}\" height=\"{6:.1f}\">{7}</svg>\n{8}",
        left + kMargin, top + 17, svg_text(drawing.title), left, top + kTitle, mesh.width, mesh.height,
        mesh.svg, legend_svg(drawing.layers, left + kMargin, top + kTitle + mesh.height + 4));
    const auto keys = static_cast<double>(drawing.layers.size());
    bottom = std::max(bottom, top + kTitle + mesh.height + kKey * keys + kGap);
    right = std::max(right, left + mesh.width);
    left += mesh.width + kGap;
  }
  return svg_file(right, bottom, shapes);
}

}  // namespace tread
