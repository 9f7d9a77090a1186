#include "core/running_surface.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>

namespace tread {

namespace {

constexpr double kPi = std::numbers::pi;

/// Bounds of a shape of one sign.
DepthBounds bounds_of(double first, double last, double depth, double steepest) {
  return {first, last, std::max(-depth, 0.0), std::max(depth, 0.0), steepest};
}

class Dip final : public DepthShape {
 public:
  Dip(double depth, double length, bool pointed)
      : DepthShape(bounds_of(-0.5 * length, 0.5 * length, depth,
                             (pointed ? 2 : 0.5 * kPi) * std::abs(depth) / (0.5 * length))),
        depth_(depth),
        half_(0.5 * length),
        pointed_(pointed) {}

  SurfaceDepth at(double x, double /*y*/) const override {
    const double s = x / half_;
    if (std::abs(s) >= 1) return {};
    if (!pointed_)
      return {0.5 * depth_ * (1 + std::cos(kPi * s)), -0.5 * kPi * depth_ / half_ * std::sin(kPi * s), 0};
    const double left = 1 - std::abs(s);
    const double side = s > 0 ? 1 : (s < 0 ? -1 : 0);
    return {depth_ * left * left, -side * 2 * depth_ / half_ * left, 0};
  }

 private:
  double depth_, half_;
  bool pointed_;
};

class Dent final : public DepthShape {
 public:
  Dent(double depth, double length, double width, double centre)
      : DepthShape(bounds_of(-0.5 * length, 0.5 * length, depth,
                             0.5 * kPi * std::abs(depth) / (0.5 * std::min(length, width)))),
        depth_(depth),
        half_length_(0.5 * length),
        half_width_(0.5 * width),
        centre_(centre) {}

  SurfaceDepth at(double x, double y) const override {
    const double s = x / half_length_;
    const double t = (y - centre_) / half_width_;
    const double r = std::hypot(s, t);
    if (r >= 1) return {};
    const double radial = r > 0 ? -0.5 * kPi * depth_ * std::sin(kPi * r) / r : 0;  // of the depth, over r
    return {0.5 * depth_ * (1 + std::cos(kPi * r)), radial * s / half_length_, radial * t / half_width_};
  }

 private:
  double depth_, half_length_, half_width_, centre_;
};

class Waves final : public DepthShape {
 public:
  Waves(double depth, double wavelength, int count)
      : DepthShape(bounds_of(0, count * wavelength, depth, kPi * std::abs(depth) / wavelength)),
        depth_(depth),
        turn_(2 * kPi / wavelength) {}

  SurfaceDepth at(double x, double /*y*/) const override {
    if (x <= 0 || x >= bounds().last) return {};
    return {0.5 * depth_ * (1 - std::cos(turn_ * x)), 0.5 * depth_ * turn_ * std::sin(turn_ * x), 0};
  }

 private:
  double depth_, turn_;
};

class ChordFlat final : public DepthShape {
 public:
  ChordFlat(double length, double radius) : ChordFlat(radius, Edge{std::asin(0.5 * length / radius)}) {}

  SurfaceDepth at(double x, double /*y*/) const override {
    const double angle = x / radius_;
    if (std::abs(angle) >= edge_) return {};
    const double secant = 1 / std::cos(angle);
    return {radius_ * (1 - std::cos(edge_) * secant), -std::cos(edge_) * std::sin(angle) * secant * secant,
            0};
  }

 private:
  struct Edge {
    double angle;  ///< [rad]
  };
  ChordFlat(double radius, Edge edge)
      : DepthShape(bounds_of(-radius * edge.angle, radius * edge.angle, radius * (1 - std::cos(edge.angle)),
                             std::tan(edge.angle))),
        radius_(radius),
        edge_(edge.angle) {}

  double radius_, edge_;
};

/// Depth along a measured line; beyond the ends it stays.
SurfaceDepth on_line(const MonotoneCubic& line, double x) {
  const double inside = std::clamp(x, line.first(), line.last());
  return {line.value(inside), inside == x ? line.slope(x) : 0, 0};
}

/// Bounds of measured depths, but for their slope.
DepthBounds bounds_of(const std::vector<double>& x, const std::vector<double>& depth, double steepest) {
  const auto [low, high] = std::minmax_element(depth.begin(), depth.end());
  return {x.front(), x.back(), std::max(-*low, 0.0), std::max(*high, 0.0), steepest};
}

class Profile final : public DepthShape {
 public:
  Profile(const std::vector<double>& x, const std::vector<double>& depth)
      : Profile(x, depth, MonotoneCubic(x, depth)) {}

  SurfaceDepth at(double x, double /*y*/) const override { return on_line(curve_, x); }

 private:
  Profile(const std::vector<double>& x, const std::vector<double>& depth, MonotoneCubic curve)
      : DepthShape(bounds_of(x, depth, curve.steepest())), curve_(std::move(curve)) {}

  MonotoneCubic curve_;
};

/// Monotone cubics along x, by row of y.
std::vector<MonotoneCubic> rows_of(const std::vector<double>& x, const std::vector<double>& depth) {
  std::vector<MonotoneCubic> rows;
  for (auto row = depth.begin(); row != depth.end(); row += static_cast<std::ptrdiff_t>(x.size()))
    rows.emplace_back(x, std::vector<double>(row, row + static_cast<std::ptrdiff_t>(x.size())));
  return rows;
}

double steepest_of(const std::vector<MonotoneCubic>& rows, const std::vector<double>& x,
                   const std::vector<double>& y, const std::vector<double>& depth) {
  double steepest = 0;
  for (const MonotoneCubic& row : rows) steepest = std::max(steepest, row.steepest());
  for (std::size_t i = x.size(); i < depth.size(); ++i) {
    const std::size_t j = i / x.size();
    steepest = std::max(steepest, std::abs(depth[i] - depth[i - x.size()]) / (y[j] - y[j - 1]));
  }
  return steepest;
}

class Map final : public DepthShape {
 public:
  Map(const std::vector<double>& x, std::vector<double> y, const std::vector<double>& depth, double centre)
      : Map(x, std::move(y), depth, rows_of(x, depth), centre) {}

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

 private:
  Map(const std::vector<double>& x, std::vector<double> y, const std::vector<double>& depth,
      std::vector<MonotoneCubic> rows, double centre)
      : DepthShape(bounds_of(x, depth, steepest_of(rows, x, y, depth))),
        y_(std::move(y)),
        rows_(std::move(rows)) {
    for (double& at : y_) at += centre;
  }

  std::vector<double> y_;
  std::vector<MonotoneCubic> rows_;
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

DepthShapePointer measured_profile(const std::vector<double>& x, const std::vector<double>& depth) {
  return std::make_shared<Profile>(x, depth);
}

DepthShapePointer measured_map(const std::vector<double>& x, std::vector<double> y,
                               const std::vector<double>& depth, double centre) {
  return std::make_shared<Map>(x, std::move(y), depth, centre);
}

void RunningSurface::add(DepthShapePointer shape, double at) {
  steepest_ += shape->bounds().steepest;
  shapes_.push_back({std::move(shape), at});
}

double RunningSurface::room(double radius, double gap) const {
  double sum = 0;
  for (const auto& [shape, at] : shapes_) {
    const DepthBounds& bounds = shape->bounds();
    const double rise = radius * bounds.steepest;
    const double reach = rise + std::sqrt(rise * rise + 2 * radius * gap);  // where slope and circle part
    sum += std::min(bounds.deepest + bounds.highest, bounds.steepest * reach);
  }
  return sum;
}

SurfaceDepth RunningSurface::at(double x, double y) const {
  SurfaceDepth sum;
  for (const auto& [shape, at] : shapes_) {
    double from_zero = x - at;
    if (radius_ > 0) {
      const double period = 2 * kPi * radius_;
      const double middle = 0.5 * (shape->bounds().first + shape->bounds().last);
      from_zero -= period * std::round((from_zero - middle) / period);
    }
    const SurfaceDepth one = shape->at(from_zero, y);
    sum.depth += one.depth;
    sum.along += one.along;
    sum.across += one.across;
  }
  return sum;
}

double traced_depth(const RunningSurface& rail, const RunningSurface& wheel, double wheel_radius, double x,
                    double y) {
  constexpr double kStep = 2e-4;  // [m]
  const auto depth = [&](double s) { return rail.at(x + s, y).depth + wheel.at(x + s, y).depth; };
  double least = depth(0);
  // Beyond this distance the wheel's own circle is higher than any place that could carry it.
  constexpr double kAnyGap = std::numeric_limits<double>::infinity();
  const double range = rail.room(wheel_radius, kAnyGap) + wheel.room(wheel_radius, kAnyGap);
  const double reach =
      std::min(2 * wheel_radius * (rail.steepest() + wheel.steepest()), std::sqrt(2 * wheel_radius * range));
  for (double s = kStep; s < reach + kStep; s += kStep)
    for (const double at : {-s, s}) least = std::min(least, depth(at) + 0.5 * at * at / wheel_radius);
  return least;
}

}  // namespace tread
