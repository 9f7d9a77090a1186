#include "core/running_surface.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

namespace tread {

namespace {

constexpr double kPi = std::numbers::pi;

class Dip final : public DepthShape {
 public:
  Dip(double depth, double length, bool pointed) : depth_(depth), half_(0.5 * length), pointed_(pointed) {}

  SurfaceDepth at(double x, double /*y*/) const override {
    const double s = x / half_;
    if (std::abs(s) >= 1) return {};
    if (!pointed_)
      return {0.5 * depth_ * (1 + std::cos(kPi * s)), -0.5 * kPi * depth_ / half_ * std::sin(kPi * s), 0};
    const double left = 1 - std::abs(s);
    const double side = s > 0 ? 1 : (s < 0 ? -1 : 0);
    return {depth_ * left * left, -side * 2 * depth_ / half_ * left, 0};
  }
  double first() const override { return -half_; }
  double last() const override { return half_; }
  double highest() const override { return std::max(-depth_, 0.0); }
  double deepest() const override { return std::max(depth_, 0.0); }
  double steepest() const override { return (pointed_ ? 2 : 0.5 * kPi) * std::abs(depth_) / half_; }

 private:
  double depth_, half_;
  bool pointed_;
};

class Dent final : public DepthShape {
 public:
  Dent(double depth, double length, double width, double centre)
      : depth_(depth), half_length_(0.5 * length), half_width_(0.5 * width), centre_(centre) {}

  SurfaceDepth at(double x, double y) const override {
    const double s = x / half_length_;
    const double t = (y - centre_) / half_width_;
    const double r = std::hypot(s, t);
    if (r >= 1) return {};
    const double radial = r > 0 ? -0.5 * kPi * depth_ * std::sin(kPi * r) / r : 0;  // of the depth, over r
    return {0.5 * depth_ * (1 + std::cos(kPi * r)), radial * s / half_length_, radial * t / half_width_};
  }
  double first() const override { return -half_length_; }
  double last() const override { return half_length_; }
  double highest() const override { return std::max(-depth_, 0.0); }
  double deepest() const override { return std::max(depth_, 0.0); }
  double steepest() const override {
    return 0.5 * kPi * std::abs(depth_) / std::min(half_length_, half_width_);
  }

 private:
  double depth_, half_length_, half_width_, centre_;
};

class Waves final : public DepthShape {
 public:
  Waves(double depth, double wavelength, int count) : depth_(depth), wave_(wavelength), count_(count) {}

  SurfaceDepth at(double x, double /*y*/) const override {
    if (x <= 0 || x >= last()) return {};
    const double turn = 2 * kPi / wave_;
    return {0.5 * depth_ * (1 - std::cos(turn * x)), 0.5 * depth_ * turn * std::sin(turn * x), 0};
  }
  double first() const override { return 0; }
  double last() const override { return count_ * wave_; }
  double highest() const override { return std::max(-depth_, 0.0); }
  double deepest() const override { return std::max(depth_, 0.0); }
  double steepest() const override { return kPi * std::abs(depth_) / wave_; }

 private:
  double depth_, wave_;
  int count_;
};

class ChordFlat final : public DepthShape {
 public:
  ChordFlat(double length, double radius) : radius_(radius), edge_(std::asin(0.5 * length / radius)) {}

  SurfaceDepth at(double x, double /*y*/) const override {
    const double angle = x / radius_;
    if (std::abs(angle) >= edge_) return {};
    const double secant = 1 / std::cos(angle);
    return {radius_ * (1 - std::cos(edge_) * secant), -std::cos(edge_) * std::sin(angle) * secant * secant,
            0};
  }
  double first() const override { return -radius_ * edge_; }
  double last() const override { return radius_ * edge_; }
  double highest() const override { return 0; }
  double deepest() const override { return radius_ * (1 - std::cos(edge_)); }
  double steepest() const override { return std::tan(edge_); }

 private:
  double radius_, edge_;
};

/// Depth along a measured line; beyond the ends it stays.
SurfaceDepth on_line(const MonotoneCubic& line, double x) {
  const double inside = std::clamp(x, line.first(), line.last());
  return {line.value(inside), inside == x ? line.slope(x) : 0, 0};
}

class Profile final : public DepthShape {
 public:
  Profile(std::vector<double> x, std::vector<double> depth)
      : highest_(std::max(-*std::min_element(depth.begin(), depth.end()), 0.0)),
        deepest_(std::max(*std::max_element(depth.begin(), depth.end()), 0.0)),
        curve_(std::move(x), std::move(depth)) {}

  SurfaceDepth at(double x, double /*y*/) const override { return on_line(curve_, x); }
  double first() const override { return curve_.first(); }
  double last() const override { return curve_.last(); }
  double highest() const override { return highest_; }
  double deepest() const override { return deepest_; }
  double steepest() const override { return curve_.steepest(); }

 private:
  double highest_, deepest_;
  MonotoneCubic curve_;
};

class Map final : public DepthShape {
 public:
  Map(const std::vector<double>& x, std::vector<double> y, const std::vector<double>& depth, double centre)
      : y_(std::move(y)) {
    for (double& at : y_) at += centre;
    for (std::size_t j = 0; j < y_.size(); ++j) {
      const auto row = depth.begin() + static_cast<std::ptrdiff_t>(j * x.size());
      rows_.emplace_back(x, std::vector<double>(row, row + static_cast<std::ptrdiff_t>(x.size())));
      for (std::size_t i = 0; i < x.size(); ++i) {
        const double here = depth[j * x.size() + i];
        deepest_ = std::max(deepest_, here);
        highest_ = std::max(highest_, -here);
        if (j > 0)
          steepest_ =
              std::max(steepest_, std::abs(here - depth[(j - 1) * x.size() + i]) / (y_[j] - y_[j - 1]));
      }
    }
    for (const MonotoneCubic& row : rows_) steepest_ = std::max(steepest_, row.steepest());
  }

  SurfaceDepth at(double x, double y) const override {
    const double inside = std::clamp(y, y_.front(), y_.back());
    const auto above = static_cast<std::size_t>(std::upper_bound(y_.begin(), y_.end(), inside) - y_.begin());
    const std::size_t j = std::clamp<std::size_t>(above, 1, y_.size() - 1) - 1;
    const SurfaceDepth left = on_line(rows_[j], x);
    const SurfaceDepth right = on_line(rows_[j + 1], x);
    const double t = (inside - y_[j]) / (y_[j + 1] - y_[j]);
    return {(1 - t) * left.depth + t * right.depth, (1 - t) * left.along + t * right.along,
            inside == y ? (right.depth - left.depth) / (y_[j + 1] - y_[j]) : 0};
  }
  double first() const override { return rows_.front().first(); }
  double last() const override { return rows_.front().last(); }
  double highest() const override { return highest_; }
  double deepest() const override { return deepest_; }
  double steepest() const override { return steepest_; }

 private:
  std::vector<double> y_;
  std::vector<MonotoneCubic> rows_;
  double highest_ = 0, deepest_ = 0, steepest_ = 0;
};

}  // namespace

DepthShapePointer dip(double depth, double length, bool pointed) {
  return std::make_shared<Dip>(depth, length, pointed);
}

DepthShapePointer dent(double depth, double length, double width, double centre) {
  return std::make_shared<Dent>(depth, length, width, centre);
}

DepthShapePointer waves(double depth, double wavelength, int count) {
  return std::make_shared<Waves>(depth, wavelength, count);
}

DepthShapePointer chord_flat(double length, double radius) {
  return std::make_shared<ChordFlat>(length, radius);
}

DepthShapePointer measured_profile(std::vector<double> x, std::vector<double> depth) {
  return std::make_shared<Profile>(std::move(x), std::move(depth));
}

DepthShapePointer measured_map(const std::vector<double>& x, std::vector<double> y,
                               const std::vector<double>& depth, double centre) {
  return std::make_shared<Map>(x, std::move(y), depth, centre);
}

void RunningSurface::add(DepthShapePointer shape, double at) {
  steepest_ += shape->steepest();
  shapes_.push_back({std::move(shape), at});
}

double RunningSurface::room(double radius, double gap) const {
  double sum = 0;
  for (const auto& [shape, at] : shapes_) {
    const double rise = radius * shape->steepest();
    const double reach = rise + std::sqrt(rise * rise + 2 * radius * gap);  // where slope and circle part
    sum += std::min(shape->deepest() + shape->highest(), shape->steepest() * reach);
  }
  return sum;
}

SurfaceDepth RunningSurface::at(double x, double y) const {
  SurfaceDepth sum;
  for (const auto& [shape, at] : shapes_) {
    double from_zero = x - at;
    if (radius_ > 0) {
      const double period = 2 * kPi * radius_;
      const double middle = 0.5 * (shape->first() + shape->last());
      from_zero -= period * std::round((from_zero - middle) / period);
    }
    const SurfaceDepth one = shape->at(from_zero, y);
    sum.depth += one.depth;
    sum.along += one.along;
    sum.across += one.across;
  }
  return sum;
}

}  // namespace tread
