#include "io/report/patch_movie.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>
#include <string_view>

#include "io/report/markup.hpp"
#include "io/report/shades.hpp"
#include "io/text/json_writer.hpp"

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
  JsonWriter json(JsonWriter::Layout::line);
  const auto numbers = [&json](const char* key, const auto& values, const auto& shown) {
    json.key(key).begin_array();
    for (const auto& value : values) json.value(shown(value));
    json.end_array();
  };
  json.begin_object().member("xLabel", movie.x_label).member("yLabel", movie.y_label);
  numbers("labels", movie.labels, [](const std::string& label) { return std::string_view(label); });
  numbers("largest", largest, [](double value) { return value; });
  json.key("stops").begin_array();
  for (const auto& stop : kShadeStops) {
    json.begin_array();
    for (const int part : stop) json.value(part);
    json.end_array();
  }
  json.end_array();
  numbers("y", std::span(movie.y).subspan(rows.first, rows.last - rows.first), rounded);
  json.key("frames").begin_array();
  for (const MovieFrame& frame : movie.frames) {
    json.begin_object().member("centre", rounded(frame.centre)).member("note", frame.note);
    numbers("x", frame.x, rounded);
    json.end_object();
  }
  json.end_array().member("values", base64(packed(movie, rows, largest))).end_object();
  std::string text;
  for (const char c : json.text()) text += c == '<' ? "\\u003c" : std::string(1, c);
  return text;
}

}  // namespace

std::string movie_html(const PatchMovie& movie) {
  if (movie.frames.empty()) return "";
  check(movie);
  return fmt::format(
      "<figure class=\"movie\">\n<figcaption>{}</figcaption>\n"
      "<div class=\"controls\"><button type=\"button\">Play</button>"
      "<input type=\"range\" min=\"0\" max=\"{}\" value=\"0\" aria-label=\"instant\">"
      "<select aria-label=\"field\"></select></div>\n"
      "<p class=\"caption note\"></p>\n"
      "<div class=\"views\"><canvas class=\"plan\"></canvas><canvas class=\"relief\"></canvas></div>\n"
      "<script type=\"application/json\">{}</script>\n<p class=\"caption\">{}</p>\n</figure>\n",
      html_text(movie.title), movie.frames.size() - 1, data(movie), html_text(movie.caption));
}

}  // namespace tread
