#pragma once
// Text of reports: escaping, subscripts, readable numbers.

#include <string>
#include <string_view>

namespace tread {

/// Text for HTML with special characters escaped, and U+FFFD in place of bytes that are not UTF-8.
std::string html_escaped(std::string_view text);

/// The same with subscripts of one or two characters after a single letter ("F_N", "d_m"). Other underscores
/// ("vertical_force", "c_1.toml", "runs/c_1") stay.
std::string html_text(std::string_view text);

/// Text for the content of an SVG text element, set as html_text() does.
std::string svg_text(std::string_view text);

/// An SVG line from (x1, y1) to (x2, y2) [px].
std::string svg_line(const char* style, double x1, double y1, double x2, double y2);

/// An SVG text element at (x, y) [px].
std::string svg_label(const char* style, double x, double y, std::string_view text);

/// A self-contained SVG file, `width` by `height` [px], from its shapes.
std::string svg_file(double width, double height, std::string_view shapes);

/// Paragraph under a figure; empty if the text is empty.
std::string caption_html(std::string_view text);

/// A number for reading, to the given significant digits and without zeros at the end: "193.2", "0.276", and
/// "8.9×10⁻⁸" outside 10⁻³ ... 10⁷. An en dash if the value is not finite.
std::string readable(double value, int digits = 4);

/// Powers of ten in superscript digits: "10⁻⁸".
std::string power_of_ten(int exponent);

}  // namespace tread
