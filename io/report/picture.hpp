#pragma once
// Common parts of pictures in reports and in SVG files.

#include <string>
#include <string_view>

namespace tread {

inline constexpr double kPageWidth = 920;  ///< width of a report's page [px]

/// SVG shapes as wide as the page.
struct Picture {
  std::string shapes;
  double height = 0;  ///< [px]
};

/// A `figure` element: title, legend (HTML), picture, caption.
std::string picture_html(const Picture& picture, std::string_view title, std::string_view caption,
                         std::string_view legend = {});

/// A self-contained SVG file: the picture under its title, which begins at `left` [px], and further shapes in
/// the title's line.
std::string picture_svg(const Picture& picture, std::string_view title, double left,
                        std::string_view beside_title = {});

}  // namespace tread
