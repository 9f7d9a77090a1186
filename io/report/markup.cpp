#include "io/report/markup.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "io/report/assets.hpp"
#include "io/text/text.hpp"

namespace tread {

namespace {

bool alphanumeric(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0;
}

/// Returns true for characters that join words to a name, a path or a key of a scene.
bool joining(char c) {
  return c == '_' || c == '-' || c == '.' || c == '/' || c == '\\';
}

/// Length of the subscript that follows text[i] = letter and text[i + 1] = '_'; 0 if there is none.
std::size_t subscript_length(std::string_view text, std::size_t i) {
  const auto at = [&](std::size_t k) { return k < text.size() ? text[k] : ' '; };
  const bool starts_word = i == 0 || (!alphanumeric(text[i - 1]) && !joining(text[i - 1]));
  if (!starts_word || std::isalpha(static_cast<unsigned char>(text[i])) == 0 || at(i + 1) != '_') return 0;
  std::size_t length = 0;
  while (alphanumeric(at(i + 2 + length))) ++length;
  const std::size_t end = i + 2 + length;
  const bool ends_sentence = at(end) == '.' && !alphanumeric(at(end + 1));
  return length <= 2 && (ends_sentence || !joining(at(end))) ? length : 0;
}

std::string escaped(char c) {
  switch (c) {
    case '&':
      return "&amp;";
    case '<':
      return "&lt;";
    case '>':
      return "&gt;";
    case '"':
      return "&quot;";
    default:
      return {c};
  }
}

std::string marked_up(std::string_view stated, std::string_view open, std::string_view close) {
  const std::string valid = in_utf8(stated);
  const std::string_view text = valid;
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    out += escaped(text[i]);
    if (const std::size_t length = subscript_length(text, i)) {
      out += fmt::format("{}{}{}", open, text.substr(i + 2, length), close);
      i += 1 + length;
    }
  }
  return out;
}

/// Decimal without zeros at the end: "3.020" becomes "3.02", "12.00" becomes "12".
std::string without_end_zeros(std::string decimal) {
  if (decimal.find('.') == std::string::npos) return decimal;
  decimal.erase(decimal.find_last_not_of('0') + 1);
  if (decimal.back() == '.') decimal.pop_back();
  return decimal;
}

}  // namespace

std::string html_escaped(std::string_view text) {
  std::string out;
  for (const char c : in_utf8(text)) out += escaped(c);
  return out;
}

std::string html_text(std::string_view text) {
  return marked_up(text, "<sub>", "</sub>");
}

std::string svg_text(std::string_view text) {
  // The zero-width space carries the baseline back: SVG has no other method that all browsers know.
  return marked_up(text, "<tspan dy=\".25em\" font-size=\"75%\">",
                   "</tspan><tspan dy=\"-.19em\">&#8203;</tspan>");
}

std::string power_of_ten(int exponent) {
  static constexpr std::array<const char*, 10> kDigits = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string out = exponent < 0 ? "10⁻" : "10";
  for (const char digit : std::to_string(std::abs(exponent)))
    out += kDigits[static_cast<std::size_t>(digit - '0')];
  return out;
}

std::string svg_line(const char* style, double x1, double y1, double x2, double y2) {
  return fmt::format("<line class=\"{}\" x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\"/>\n", style,
                     x1, y1, x2, y2);
}

std::string svg_label(const char* style, double x, double y, std::string_view text) {
  return fmt::format("<text class=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", style, x, y, svg_text(text));
}

std::string svg_file(double width, double height, std::string_view shapes) {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\"><style>{2}</style>\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n{3}</svg>\n",
      width, height, kFigureStyle, shapes);
}

std::string caption_html(std::string_view text) {
  return text.empty() ? "" : fmt::format("<p class=\"caption\">{}</p>\n", html_text(text));
}

std::string readable(double value, int digits) {
  if (!std::isfinite(value)) return "–";
  const std::string sign = value < 0 ? "−" : "";
  // The value is rounded first, so that 999.96 counts as 1000.
  const std::string scientific = fmt::format("{:.{}e}", std::abs(value), digits - 1);
  const std::size_t e = scientific.find('e');
  const int exponent = std::stoi(scientific.substr(e + 1));
  if (exponent < -3 || exponent > 6)
    return sign + without_end_zeros(scientific.substr(0, e)) + "×" + power_of_ten(exponent);
  return sign +
         without_end_zeros(fmt::format("{:.{}f}", std::abs(value), std::max(0, digits - 1 - exponent)));
}

}  // namespace tread
