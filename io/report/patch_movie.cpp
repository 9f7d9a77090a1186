#include "io/report/patch_movie.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <span>
#include <stdexcept>
#include <string_view>

#include "io/report/heatmap.hpp"
#include "io/report/markup.hpp"
#include "io/report/picture.hpp"
#include "io/report/shades.hpp"
#include "io/text/json.hpp"

namespace tread {

namespace {

std::string base64(const std::vector<std::uint8_t>& bytes) {
  constexpr const char* kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t left = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k) word = word << 8U | (k < left ? bytes[i + k] : 0U);
    for (std::size_t k = 0; k < 4; ++k) out += k <= left ? kDigits[word >> (18 - 6 * k) & 63U] : '=';
  }
  return out;
}

/// Rows with contact, and one row beside them.
struct Rows {
  std::size_t first = 0, last = 0;  ///< range [first, last)
};

Rows rows_in_contact(const PatchMovie& movie) {
  const std::size_t count = movie.y.size();
  Rows rows{count, 0};
  for (const MovieFrame& frame : movie.frames)
    for (std::size_t i = 0; i < frame.state.size(); ++i)
      if (frame.state[i] != 0) {
        rows.first = std::min(rows.first, i % count);
        rows.last = std::max(rows.last, i % count + 1);
      }
  if (rows.first >= rows.last) return {0, count};
  return {rows.first > 0 ? rows.first - 1 : 0, std::min(rows.last + 1, count)};
}

void check(const PatchMovie& movie) {
  for (const MovieFrame& frame : movie.frames) {
    const std::size_t nodes = frame.x.size() * movie.y.size();
    bool fits = frame.x.size() == movie.frames.front().x.size() && frame.state.size() == nodes &&
                frame.fields.size() == movie.labels.size();
    for (const std::vector<float>& field : frame.fields) fits = fits && field.size() == nodes;
    if (!fits) throw std::logic_error("movie '" + movie.title + "': every frame needs a value per node");
  }
}

std::vector<double> largest_values(const PatchMovie& movie) {
  std::vector<double> largest(movie.labels.size(), 0.0);
  for (const MovieFrame& frame : movie.frames)
    for (std::size_t f = 0; f < frame.fields.size(); ++f)
      for (const float value : frame.fields[f])
        if (std::isfinite(value)) largest[f] = std::max(largest[f], static_cast<double>(value));
  return largest;
}

/// Bytes of the fields as fractions of their largest value, then of the states, frame by frame;
/// [station][row].
std::vector<std::uint8_t> packed(const PatchMovie& movie, const Rows& rows,
                                 const std::vector<double>& largest) {
  std::vector<std::uint8_t> bytes;
  const auto each_node = [&](const MovieFrame& frame, const auto& value) {
    for (std::size_t i = 0; i < frame.x.size(); ++i)
      for (std::size_t row = rows.first; row < rows.last; ++row)
        bytes.push_back(value(i * movie.y.size() + row));
  };
  for (const MovieFrame& frame : movie.frames) {
    for (std::size_t f = 0; f < frame.fields.size(); ++f)
      each_node(frame, [&](std::size_t node) -> std::uint8_t {
        const double value = frame.fields[f][node];
        if (!(value > 0) || largest[f] <= 0) return 0;
        return static_cast<std::uint8_t>(std::lround(255 * value / largest[f]));
      });
    each_node(frame, [&](std::size_t node) { return frame.state[node]; });
  }
  return bytes;
}

/// Value [mm] rounded to a tenth of a micrometre, so that its text is short.
double rounded(double millimetres) {
  return std::round(1e4 * millimetres) * 1e-4;
}

/// JSON for a script element, which a "<" might end.
std::string data(const PatchMovie& movie) {
  const Rows rows = rows_in_contact(movie);
  const std::vector<double> largest = largest_values(movie);
  Json json = {{"xLabel", movie.x_label}, {"yLabel", movie.y_label}, {"labels", movie.labels},
               {"rolls", movie.rolls},    {"largest", largest},      {"stops", kShadeStops},
               {"y", Json::array()},      {"frames", Json::array()}};
  for (std::size_t i = rows.first; i < rows.last; ++i) json["y"].push_back(rounded(movie.y[i]));
  for (const MovieFrame& frame : movie.frames) {
    Json one = {{"centre", rounded(frame.centre)}, {"note", frame.note}, {"x", Json::array()}};
    for (const double x : frame.x) one["x"].push_back(rounded(x));
    json["frames"].push_back(one);
  }
  json["values"] = base64(packed(movie, rows, largest));
  std::string text;
  for (const char c : json_line(json)) text += c == '<' ? "\\u003c" : std::string(1, c);
  return text;
}

/// The frame in which the first field is largest.
const MovieFrame& fullest_frame(const PatchMovie& movie) {
  const auto largest = [](const MovieFrame& frame) {
    float most = 0;
    for (const float value : frame.fields.front()) most = std::max(most, value);
    return most;
  };
  return *std::max_element(movie.frames.begin(), movie.frames.end(),
                           [&](const MovieFrame& a, const MovieFrame& b) { return largest(a) < largest(b); });
}

/// Map of a field about the patch; its outline encloses the places that slip.
Heatmap field_map(const PatchMovie& movie, const MovieFrame& frame, std::size_t field) {
  const std::size_t count = movie.y.size();
  const Rows rows = rows_in_contact(movie);
  std::size_t first = frame.x.size(), last = 0;  // stations in contact
  for (std::size_t node = 0; node < frame.state.size(); ++node)
    if (frame.state[node] != 0) {
      first = std::min(first, node / count);
      last = std::max(last, node / count + 1);
    }
  if (first >= last) first = 0, last = frame.x.size();
  first = first > 0 ? first - 1 : 0;
  last = std::min(last + 1, frame.x.size());
  Heatmap map;
  map.x_label = movie.x_label;
  map.y_label = movie.y_label;
  map.value_label = movie.labels[field];
  for (std::size_t i = first; i < last; ++i) map.x.push_back(frame.x[i] - frame.centre);
  for (std::size_t row = rows.first; row < rows.last; ++row) map.y.push_back(movie.y[row]);
  for (std::size_t row = rows.first; row < rows.last; ++row)
    for (std::size_t i = first; i < last; ++i) {
      const float value = frame.fields[field][i * count + row];
      map.values.push_back(std::isfinite(value) ? value : 0);
      map.marked.push_back(frame.state[i * count + row] == 2);
    }
  return map;
}

}  // namespace

std::string movie_html(const PatchMovie& movie) {
  if (movie.frames.empty()) return "";
  check(movie);
  const char* hidden = movie.frames.size() == 1 ? " hidden" : "";  // a single frame does not play
  return fmt::format(
      "<figure class=\"movie\">\n<figcaption>{0}</figcaption>\n"
      "<div class=\"controls\"><button type=\"button\"{4}>Play</button>"
      "<input type=\"range\" min=\"0\" max=\"{1}\" value=\"0\" aria-label=\"instant\"{4}>"
      "<select aria-label=\"field\"></select></div>\n"
      "<p class=\"caption note\"></p>\n"
      "<div class=\"views\"><canvas class=\"plan\"></canvas><canvas class=\"relief\"></canvas></div>\n"
      "<script type=\"application/json\">{2}</script>\n<p class=\"caption\">{3}</p>\n</figure>\n",
      html_text(movie.title), movie.frames.size() - 1, data(movie), html_text(movie.caption), hidden);
}

std::string movie_svg(const PatchMovie& movie) {
  if (movie.frames.empty()) return svg_file(kPageWidth, 0, "");
  check(movie);
  const MovieFrame& frame = fullest_frame(movie);
  Picture all;
  for (std::size_t field = 0; field < movie.labels.size(); ++field) {
    const Picture map = heatmap_picture(field_map(movie, frame, field));
    all.shapes += fmt::format("<g transform=\"translate(0 {:.0f})\">\n{}</g>\n", all.height, map.shapes);
    all.height += map.height;
  }
  return picture_svg(all, fmt::format("{}: {}; red: slips", movie.title, frame.note), 10);
}

}  // namespace tread
