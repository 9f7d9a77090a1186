#include "io/report/relief.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <stdexcept>

#include "io/report/chart.hpp"
#include "io/report/markup.hpp"
#include "io/report/picture.hpp"
#include "io/report/shades.hpp"

namespace tread {

namespace {

// Page geometry [px].
constexpr double kHeight = 330;  // height of a row of reliefs
constexpr double kLeft = 62, kRight = 62, kTop = 34, kBottom = 48;
constexpr int kShades = 24;

struct Pixel {
  double x, y;
};

/// One relief within `width`, its upper left corner at (left, top).
class Plot {
 public:
  Plot(const Relief& relief, double left, double top, double width)
      : relief_(relief), left_(left + kLeft), base_(top + kHeight - kBottom) {
    if (relief.x.size() < 2 || relief.y.size() < 2 ||
        relief.values.size() != relief.x.size() * relief.y.size())
      throw std::logic_error("relief '" + relief.title + "': a value per crossing is needed");
    const double drawn_width = width - kLeft - kRight;
    const double drawn_height = kHeight - kTop - kBottom;
    along_ = 0.8 * drawn_width;
    into_ = {drawn_width - along_, -0.42 * drawn_height};
    up_ = -0.58 * drawn_height;
    low_ = std::min(0.0, *std::min_element(relief.values.begin(), relief.values.end()));
    high_ = *std::max_element(relief.values.begin(), relief.values.end());
    if (high_ <= low_) high_ = low_ + 1;
  }

  std::string shapes() const {
    std::string out = svg_label("name", left_ - 44, base_ + up_ + into_.y - 14, relief_.title);
    out += floor();
    // Rows are drawn from the back to the front: the front ones hide those behind.
    for (std::size_t row = relief_.y.size() - 1; row > 0; --row) out += strip(row - 1);
    return out + axes();
  }

 private:
  double share(double value) const { return (value - low_) / (high_ - low_); }
  double height(std::size_t i, std::size_t row) const { return relief_.values[row * relief_.x.size() + i]; }
  Pixel place(double x, double y, double value) const {
    const auto part = [](const std::vector<double>& all, double v) {
      return (v - all.front()) / (all.back() - all.front());
    };
    const double depth = part(relief_.y, y);
    return {left_ + along_ * part(relief_.x, x) + into_.x * depth,
            base_ + into_.y * depth + up_ * share(value)};
  }
  Pixel node(std::size_t i, std::size_t row) const {
    return place(relief_.x[i], relief_.y[row], height(i, row));
  }

  std::string floor() const {
    std::string path;
    for (const auto& [x, y] :
         {std::array{relief_.x.front(), relief_.y.front()}, std::array{relief_.x.back(), relief_.y.front()},
          std::array{relief_.x.back(), relief_.y.back()}, std::array{relief_.x.front(), relief_.y.back()}}) {
      const Pixel corner = place(x, y, low_);
      path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", corner.x, corner.y);
    }
    return "<path class=\"grid\" fill=\"none\" d=\"" + path + "z\"/>\n";
  }

  /// Quads between a row of crossings and the next; quads of one shade share a path.
  std::string strip(std::size_t row) const {
    std::array<std::string, kShades> paths;
    for (std::size_t i = 0; i + 1 < relief_.x.size(); ++i) {
      const double mean =
          0.25 * (height(i, row) + height(i + 1, row) + height(i + 1, row + 1) + height(i, row + 1));
      std::string& path = paths[std::min(static_cast<std::size_t>(share(mean) * kShades), paths.size() - 1)];
      const char* step = "M";
      for (const Pixel& corner : {node(i, row), node(i + 1, row), node(i + 1, row + 1), node(i, row + 1)}) {
        path += fmt::format("{}{:.1f} {:.1f}", step, corner.x, corner.y);
        step = "L";
      }
      path += "z";
    }
    std::string out;
    for (std::size_t k = 0; k < paths.size(); ++k)
      if (!paths[k].empty())
        out += fmt::format("<path class=\"quads\" fill=\"{}\" d=\"{}\"/>\n",
                           shade((static_cast<double>(k) + 0.5) / kShades), paths[k]);
    return out;
  }

  std::string axes() const {
    const double x0 = relief_.x.front(), x1 = relief_.x.back();
    const double y0 = relief_.y.front(), y1 = relief_.y.back();
    const Pixel front = place(x0, y0, low_), right = place(x1, y0, low_), back = place(x1, y1, low_),
                top = place(x0, y0, high_);
    std::string out = svg_line("axis", front.x, front.y, right.x, right.y) +
                      svg_line("axis", right.x, right.y, back.x, back.y) +
                      svg_line("axis", front.x, front.y, top.x, top.y);
    for (const double v : ticks(x0, x1, along_ > 450 ? 10 : 5)) {
      const Pixel at = place(v, y0, low_);
      out += svg_line("axis", at.x, at.y, at.x, at.y + 5) +
             svg_label("tick middle", at.x, at.y + 18, readable(v));
    }
    for (const double v : ticks(y0, y1, 5)) {
      const Pixel at = place(x1, v, low_);
      out +=
          svg_line("axis", at.x, at.y, at.x + 5, at.y) + svg_label("tick", at.x + 8, at.y + 4, readable(v));
    }
    for (const double v : ticks(low_, high_, 5)) {
      const Pixel at = place(x0, y0, v);
      out += svg_line("axis", at.x, at.y, at.x - 5, at.y) +
             svg_label("tick right", at.x - 8, at.y + 4, readable(v));
    }
    out += svg_label("name middle", 0.5 * (front.x + right.x), front.y + 38, relief_.x_label);
    out += svg_label("name right", back.x + kRight, right.y + 38, relief_.y_label);
    return out + svg_label("note", front.x - 44, top.y - 10, relief_.value_label);
  }

  const Relief& relief_;
  double left_, base_;  ///< front left corner at the lowest value [px]
  double along_ = 0;    ///< length from the first x to the last [px]
  Pixel into_ = {};     ///< offset from the first y to the last [px]
  double up_ = 0;       ///< height from the lowest value to the highest [px]
  double low_ = 0, high_ = 1;
};

Picture picture(const Reliefs& reliefs) {
  const std::size_t columns = reliefs.reliefs.size() > 1 ? 2 : 1;
  const double width = kPageWidth / static_cast<double>(columns);
  Picture made;
  for (std::size_t i = 0; i < reliefs.reliefs.size(); ++i) {
    const std::size_t row = i / columns, column = i % columns;
    const double top = static_cast<double>(row) * kHeight;
    made.shapes += Plot(reliefs.reliefs[i], static_cast<double>(column) * width, top, width).shapes();
    made.height = top + kHeight;
  }
  return made;
}

}  // namespace

std::string reliefs_html(const Reliefs& reliefs) {
  return picture_html(picture(reliefs), reliefs.title, reliefs.caption);
}

std::string reliefs_svg(const Reliefs& reliefs) {
  return picture_svg(picture(reliefs), reliefs.title, 18);
}

}  // namespace tread
