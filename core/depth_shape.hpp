#pragma once
// Shapes of depth below a smooth surface: dips, dents, waves, flats, measured depths.
// [theory.md, Surfaces]

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "core/inline.hpp"
#include "core/math/monotone_cubic.hpp"

namespace tread {

/// Depth below the smooth surface, negative above it, and its derivatives.
struct SurfaceDepth {
  double depth = 0;   ///< [m]
  double along = 0;   ///< by the place along the surface [-]
  double across = 0;  ///< by the place across it [-]
};

/// Where a shape of depth lies, and how far it reaches.
struct DepthBounds {
  double first = 0, last = 0;  ///< beginning and end along the surface [m]
  double highest = 0;          ///< bound of the height above the smooth surface, 0 or more [m]
  double deepest = 0;          ///< bound of the depth, 0 or more [m]
  double steepest = 0;         ///< bound of the derivatives' sizes [-]
};

/// One shape of depth as plain data, on a device too. x counts along the surface from the shape's own zero, y
/// across from the surface's middle [m].
struct DepthShapeView {
  enum class Kind { dip, pointed_dip, dent, waves, flat, measured };

  Kind kind = Kind::dip;
  double first = 0, last = 0;         ///< DepthBounds
  double depth = 0;                   ///< of dips, dents and waves [m]
  double half_width = 0, centre = 0;  ///< of dents [m]
  double turn = 0;                    ///< of waves, by length [rad/m]
  double radius = 0, edge = 0;        ///< of flats: of the wheel [m]; half of the chord's angle [rad]
  // Measured depths: monotone cubics along by row, straight across.
  const MonotoneCubicView* line = nullptr;
  const double* y = nullptr;  ///< by row [m]
  int rows = 0;

  TREAD_BODY SurfaceDepth at(double x_at, double y_at) const {
    switch (kind) {
      case Kind::dip:
        return dip(x_at);
      case Kind::pointed_dip:
        return pointed_dip(x_at);
      case Kind::dent:
        return dent(x_at, y_at);
      case Kind::waves:
        return waves(x_at);
      case Kind::flat:
        return flat(x_at);
      case Kind::measured:
        break;
    }
    return measured(x_at, y_at);
  }

 private:
  static constexpr double kPi = std::numbers::pi;

  TREAD_BODY SurfaceDepth dip(double x) const {
    const double s = x / last;
    if (std::abs(s) >= 1) return {};
    return {0.5 * depth * (1 + std::cos(kPi * s)), -0.5 * kPi * depth / last * std::sin(kPi * s), 0};
  }

  TREAD_BODY SurfaceDepth pointed_dip(double x) const {
    const double s = x / last;
    if (std::abs(s) >= 1) return {};
    const double left = 1 - std::abs(s);
    const double side = s > 0 ? 1 : (s < 0 ? -1 : 0);
    return {depth * left * left, -side * 2 * depth / last * left, 0};
  }

  TREAD_BODY SurfaceDepth dent(double x, double across) const {
    const double s = x / last;
    const double t = (across - centre) / half_width;
    const double r = std::hypot(s, t);
    if (r >= 1) return {};
    const double radial = r > 0 ? -0.5 * kPi * depth * std::sin(kPi * r) / r : 0;  // of the depth, over r
    return {0.5 * depth * (1 + std::cos(kPi * r)), radial * s / last, radial * t / half_width};
  }

  TREAD_BODY SurfaceDepth waves(double x) const {
    if (x <= 0 || x >= last) return {};
    return {0.5 * depth * (1 - std::cos(turn * x)), 0.5 * depth * turn * std::sin(turn * x), 0};
  }

  TREAD_BODY SurfaceDepth flat(double x) const {
    const double angle = x / radius;
    if (std::abs(angle) >= edge) return {};
    const double secant = 1 / std::cos(angle);
    return {radius * (1 - std::cos(edge) * secant), -std::cos(edge) * std::sin(angle) * secant * secant, 0};
  }

  /// Depth along a row; beyond the ends it stays.
  TREAD_BODY SurfaceDepth on_line(const MonotoneCubicView& row, double x) const {
    const double inside = std::clamp(x, first, last);
    return {row.value(inside), inside == x ? row.derivative(x) : 0, 0};
  }

  TREAD_BODY SurfaceDepth measured(double x, double across) const {
    if (rows == 1) return on_line(line[0], x);
    const double inside = std::clamp(across, y[0], y[rows - 1]);
    const int j = piece_at(y, rows, inside);
    const SurfaceDepth left = on_line(line[j], x);
    const SurfaceDepth right = on_line(line[j + 1], x);
    const double t = (inside - y[j]) / (y[j + 1] - y[j]);
    return {(1 - t) * left.depth + t * right.depth, (1 - t) * left.along + t * right.along,
            inside == across ? (right.depth - left.depth) / (y[j + 1] - y[j]) : 0};
  }
};

/// A shape of depth and what it is made of.
class DepthShape {
 public:
  /// A shape without measured depths.
  DepthShape(const DepthBounds& bounds, const DepthShapeView& view);
  /// Measured depths by row of y, whose x are those of the bounds.
  DepthShape(const DepthBounds& bounds, std::vector<double> y, std::vector<MonotoneCubic> rows);
  DepthShape(const DepthShape&) = delete;
  DepthShape& operator=(const DepthShape&) = delete;

  SurfaceDepth at(double x, double y) const { return view_.at(x, y); }
  const DepthBounds& bounds() const { return bounds_; }
  /// The shape as plain data, while this object lives.
  const DepthShapeView& view() const { return view_; }

 private:
  DepthBounds bounds_;
  std::vector<double> y_;
  std::vector<MonotoneCubic> rows_;
  std::vector<MonotoneCubicView> lines_;
  DepthShapeView view_;
};

using DepthShapePointer = std::shared_ptr<const DepthShape>;

/// Dip over the whole width, deepest at x = 0. Pointed: two parabolas that meet at an angle, as at a welded
/// or bolted joint; its angle is 8 depth / length. Smooth: one wave of a cosine.
DepthShapePointer dip(double depth, double length, bool pointed);

/// Dent about (0, `centre`): one wave of a cosine over an ellipse of these axes [m].
DepthShapePointer dent(double depth, double length, double width, double centre);

/// Whole waves from crest to crest, from x = 0 on; `depth` from crest to trough [m].
DepthShapePointer waves(double depth, double wavelength, int count);

/// Flat whose chord is `length` long, on a wheel of `radius` [m]; its middle at x = 0.
DepthShapePointer chord_flat(double length, double radius);

/// Measured depths along the surface [m], the same across. Beyond the ends the depth stays.
DepthShapePointer measured_profile(const std::vector<double>& x, const std::vector<double>& depth);

/// Measured depths at all pairs of x and y, by row of y: depth[j * x.size() + i] belongs to (x[i], y[j] +
/// `centre`) [m]. Monotone cubics along, straight across. Beyond the ends the depth stays.
DepthShapePointer measured_map(const std::vector<double>& x, std::vector<double> y,
                               const std::vector<double>& depth, double centre);

}  // namespace tread
