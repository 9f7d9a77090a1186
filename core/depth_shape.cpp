#include "core/depth_shape.hpp"

#include <cstddef>
#include <utility>

namespace tread {

namespace {

using Kind = DepthShapeView::Kind;

constexpr double kPi = std::numbers::pi;

/// Bounds of a shape of one sign.
DepthBounds bounds_of(double first, double last, double depth, double steepest) {
  return {first, last, std::max(-depth, 0.0), std::max(depth, 0.0), steepest};
}

/// Bounds of measured depths, but for their slope.
DepthBounds bounds_of(const std::vector<double>& x, const std::vector<double>& depth, double steepest) {
  const auto [low, high] = std::minmax_element(depth.begin(), depth.end());
  return {x.front(), x.back(), std::max(-*low, 0.0), std::max(*high, 0.0), steepest};
}

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

}  // namespace

DepthShape::DepthShape(const DepthBounds& bounds, const DepthShapeView& view) : bounds_(bounds), view_(view) {
  view_.first = bounds.first;
  view_.last = bounds.last;
}

DepthShape::DepthShape(const DepthBounds& bounds, std::vector<double> y, std::vector<MonotoneCubic> rows)
    : DepthShape(bounds, DepthShapeView{.kind = Kind::measured}) {
  y_ = std::move(y);
  rows_ = std::move(rows);
  for (const MonotoneCubic& row : rows_) lines_.push_back(row.view());
  view_.line = lines_.data();
  view_.y = y_.data();
  view_.rows = static_cast<int>(rows_.size());
}

DepthShapePointer dip(double depth, double length, bool pointed) {
  const double half = 0.5 * length;
  const double steepest = (pointed ? 2 : 0.5 * kPi) * std::abs(depth) / half;
  return std::make_shared<DepthShape>(
      bounds_of(-half, half, depth, steepest),
      DepthShapeView{.kind = pointed ? Kind::pointed_dip : Kind::dip, .depth = depth});
}

DepthShapePointer dent(double depth, double length, double width, double centre) {
  const double steepest = 0.5 * kPi * std::abs(depth) / (0.5 * std::min(length, width));
  return std::make_shared<DepthShape>(
      bounds_of(-0.5 * length, 0.5 * length, depth, steepest),
      DepthShapeView{.kind = Kind::dent, .depth = depth, .half_width = 0.5 * width, .centre = centre});
}

DepthShapePointer waves(double depth, double wavelength, int count) {
  return std::make_shared<DepthShape>(
      bounds_of(0, count * wavelength, depth, kPi * std::abs(depth) / wavelength),
      DepthShapeView{.kind = Kind::waves, .depth = depth, .turn = 2 * kPi / wavelength});
}

DepthShapePointer chord_flat(double length, double radius) {
  const double edge = std::asin(0.5 * length / radius);
  return std::make_shared<DepthShape>(
      bounds_of(-radius * edge, radius * edge, radius * (1 - std::cos(edge)), std::tan(edge)),
      DepthShapeView{.kind = Kind::flat, .radius = radius, .edge = edge});
}

DepthShapePointer measured_profile(const std::vector<double>& x, const std::vector<double>& depth) {
  return measured_map(x, {0}, depth, 0);
}

DepthShapePointer measured_map(const std::vector<double>& x, std::vector<double> y,
                               const std::vector<double>& depth, double centre) {
  std::vector<MonotoneCubic> rows = rows_of(x, depth);
  const DepthBounds bounds = bounds_of(x, depth, steepest_of(rows, x, y, depth));
  for (double& at : y) at += centre;
  return std::make_shared<DepthShape>(bounds, std::move(y), std::move(rows));
}

}  // namespace tread
