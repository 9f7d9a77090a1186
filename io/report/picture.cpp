#include "io/report/picture.hpp"

#include <fmt/core.h>

#include "io/report/markup.hpp"

namespace tread {

std::string picture_html(const Picture& picture, std::string_view title, std::string_view caption,
                         std::string_view legend) {
  return fmt::format(
      "<figure>\n<figcaption>{}</figcaption>\n{}<svg viewBox=\"0 0 {:.0f} {:.0f}\">\n{}</svg>\n{}</figure>\n",
      html_text(title), legend, kPageWidth, picture.height, picture.shapes, caption_html(caption));
}

std::string picture_svg(const Picture& picture, std::string_view title, double left,
                        std::string_view beside_title) {
  constexpr double kHead = 26;
  return svg_file(kPageWidth, kHead + picture.height,
                  fmt::format("<text x=\"{:.0f}\" y=\"18\" font-weight=\"bold\">{}</text>\n{}<g "
                              "transform=\"translate(0 {:.0f})\">\n{}</g>\n",
                              left, svg_text(title), beside_title, kHead, picture.shapes));
}

}  // namespace tread
