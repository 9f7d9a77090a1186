#pragma once
// Depths of a running surface below its smooth shape. [theory.md, Surfaces]

#include <cmath>
#include <numbers>
#include <vector>

#include "core/depth_shape.hpp"
#include "core/inline.hpp"

namespace tread {

/// A shape of depth whose zero lies at x = `at` [m].
struct PlacedDepth {
  DepthShapeView shape;
  double at = 0;
};

/// Sum of shapes as plain data, on a device too.
struct RunningSurfaceView {
  const PlacedDepth* shape = nullptr;
  int shapes = 0;
  double radius = 0;  ///< of a wheel, after whose circumference x returns; 0: a rail [m]
  double start = 0;   ///< where the wheel's sweep angle 0 meets the rail [m]

  TREAD_BODY bool smooth() const { return shapes == 0; }

  TREAD_BODY SurfaceDepth at(double x, double y) const {
    SurfaceDepth sum;
    for (int i = 0; i < shapes; ++i) {
      const DepthShapeView& one = shape[i].shape;
      double from_zero = x - shape[i].at;
      if (radius > 0) {
        const double period = 2 * std::numbers::pi * radius;
        const double middle = 0.5 * (one.first + one.last);
        from_zero -= period * std::round((from_zero - middle) / period);
      }
      const SurfaceDepth depth = one.at(from_zero, y);
      sum.depth += depth.depth;
      sum.along += depth.along;
      sum.across += depth.across;
    }
    return sum;
  }

  /// The same at a wheel's sweep angle [rad]; in free rolling it meets the rail at x = start - radius angle.
  TREAD_BODY SurfaceDepth around(double angle, double y) const { return at(start - radius * angle, y); }
};

/// Sum of shapes on a rail's or wheel's surface.
class RunningSurface {
 public:
  /// A smooth surface, with a view's `radius` and `start` [m].
  explicit RunningSurface(double radius = 0, double start = 0) : radius_(radius), start_(start) {}

  /// Adds a shape whose zero lies at x = `at` [m].
  void add(DepthShapePointer shape, double at);

  SurfaceDepth at(double x, double y) const { return view().at(x, y); }
  /// The surface as plain data, while this object lives and gets no shape.
  RunningSurfaceView view() const {
    return {placed_.data(), static_cast<int>(placed_.size()), radius_, start_};
  }
  bool smooth() const { return placed_.empty(); }
  /// Depth that a wheel of `radius` [m] which touches the surface may find within `gap` [m] of it [m].
  double room(double radius, double gap) const;
  double steepest() const { return steepest_; }  ///< bound of the derivatives' sizes [-]

 private:
  std::vector<DepthShapePointer> shapes_;
  std::vector<PlacedDepth> placed_;  ///< views of the shapes
  double radius_, start_;
  double steepest_ = 0;
};

/// Depth by which a rigid round wheel at x runs lower for the depths of both surfaces: it rolls on the
/// highest places about x, at y across [m].
double traced_depth(const RunningSurface& rail, const RunningSurface& wheel, double wheel_radius, double x,
                    double y);

}  // namespace tread
