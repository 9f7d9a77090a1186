#include "io/report/figure_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <vector>

#include "io/text/text.hpp"

namespace tread {

namespace {

/// A number with as many digits as a float holds; nothing if it is not finite.
std::string number(double value) {
  return std::isfinite(value) ? fmt::format("{:.7g}", value) : "";
}

struct NamedColumn {
  std::string head;
  const std::vector<double>* values;
};

/// Columns of the curves, each group of equal abscissae after the column of these.
std::vector<NamedColumn> columns_of(const Figure& figure) {
  std::vector<NamedColumn> columns;
  const std::vector<double>* x = nullptr;
  for (const Panel& panel : figure.panels)
    for (const Series& series : panel.series) {
      if (!x) columns.push_back({figure.x_label, &series.x});
      if (x && *x != series.x) columns.push_back({series.label + ": " + figure.x_label, &series.x});
      x = &series.x;
      columns.push_back({series.label + ": " + panel.y_label, &series.y});
    }
  return columns;
}

void add_polygons(const std::string& drawing, const std::string& layer, const std::vector<Polygon>& polygons,
                  const std::optional<Window>& window, int& number_of_polygon, fmt::memory_buffer& text) {
  for (const Polygon& polygon : polygons) {
    if (window && !touches(polygon, *window)) continue;
    ++number_of_polygon;
    for (const auto& point : polygon)
      fmt::format_to(std::back_inserter(text), "{},{},{},{},{}\n", drawing, layer, number_of_polygon,
                     number(point[0]), number(point[1]));
  }
}

}  // namespace

std::string curves_csv(const Figure& figure) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  const std::vector<NamedColumn> columns = columns_of(figure);
  std::size_t rows = 0;
  for (const NamedColumn& column : columns) {
    fmt::format_to(out, "{}{}", &column == &columns.front() ? "" : ",", csv_cell(column.head));
    rows = std::max(rows, column.values->size());
  }
  for (std::size_t row = 0; row < rows; ++row)
    for (const NamedColumn& column : columns)
      fmt::format_to(out, "{}{}", &column == &columns.front() ? "\n" : ",",
                     row < column.values->size() ? number((*column.values)[row]) : "");
  fmt::format_to(out, "\n");
  return fmt::to_string(text);
}

std::string heatmap_csv(const Heatmap& map) {
  std::string text = fmt::format("{},{},{},source,{}\n", csv_cell(map.x_label), csv_cell(map.y_label),
                                 csv_cell(map.value_label),
                                 csv_cell(map.marked_label.empty() ? "marked" : map.marked_label));
  for (std::size_t j = 0; j < map.y.size(); ++j)
    for (std::size_t i = 0; i < map.x.size(); ++i)
      text += fmt::format("{},{},{},,{}\n", number(map.x[i]), number(map.y[j]), number(map.at(i, j)),
                          !map.marked.empty() && map.marked[j * map.x.size() + i] ? 1 : 0);
  for (const HeatDot& dot : map.dots)
    text +=
        fmt::format("{},{},{},{},\n", number(dot.x), number(dot.y), number(dot.value), csv_cell(dot.label));
  for (const HeatLine& line : map.lines)
    for (std::size_t i = 0; i < line.x.size(); ++i)
      text += fmt::format("{},{},,{},\n", number(line.x[i]), number(line.y[i]), csv_cell(line.label));
  return text;
}

std::string scatter_csv(const Scatter& scatter) {
  std::string text =
      fmt::format("panel,{},{},label,marked\n", csv_cell(scatter.x_label), csv_cell(scatter.y_label));
  for (const ScatterPanel& panel : scatter.panels)
    for (const ScatterDot& dot : panel.dots)
      text += fmt::format("{},{},{},{},{}\n", csv_cell(panel.title), number(dot.x), number(dot.y),
                          csv_cell(dot.label), dot.marked ? 1 : 0);
  return text;
}

std::string drawings_csv(const Drawings& drawings) {
  fmt::memory_buffer text;
  fmt::format_to(std::back_inserter(text), "drawing,layer,polygon,horizontal [m],vertical [m]\n");
  for (const Drawing& drawing : drawings.drawings) {
    int polygons = 0;
    for (const Layer& layer : drawing.layers)
      for (const auto* shown : {&layer.cells, &layer.lines})
        add_polygons(csv_cell(drawing.title), csv_cell(layer.label), *shown, drawing.window, polygons, text);
  }
  return fmt::to_string(text);
}

std::string movie_csv(const PatchMovie& movie) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "instant,centre [mm],{},{}", csv_cell(movie.x_label), csv_cell(movie.y_label));
  for (const std::string& label : movie.labels) fmt::format_to(out, ",{}", csv_cell(label));
  fmt::format_to(out, ",state\n");
  for (std::size_t k = 0; k < movie.frames.size(); ++k) {
    const MovieFrame& frame = movie.frames[k];
    for (std::size_t node = 0; node < frame.state.size(); ++node) {
      if (frame.state[node] == 0) continue;
      fmt::format_to(out, "{},{},{},{}", k + 1, number(frame.centre),
                     number(frame.x[node / movie.y.size()] - frame.centre),
                     number(movie.y[node % movie.y.size()]));
      for (const std::vector<float>& field : frame.fields) fmt::format_to(out, ",{}", number(field[node]));
      fmt::format_to(out, ",{}\n", int{frame.state[node]});
    }
  }
  return fmt::to_string(text);
}

}  // namespace tread
