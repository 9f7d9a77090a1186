#pragma once
// Depths of a running surface below its smooth shape: dips, dents, waves, flats, measured depths.
// [theory.md, Surfaces]

#include <memory>
#include <vector>

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

/// One shape of depth. x counts along the surface from the shape's own zero, y across from the surface's
/// middle [m].
class DepthShape {
 public:
  explicit DepthShape(const DepthBounds& bounds) : bounds_(bounds) {}
  DepthShape(const DepthShape&) = delete;
  DepthShape& operator=(const DepthShape&) = delete;
  virtual ~DepthShape() = default;

  virtual SurfaceDepth at(double x, double y) const = 0;
  const DepthBounds& bounds() const { return bounds_; }

 private:
  DepthBounds bounds_;
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

/// Sum of shapes on a rail's or wheel's surface.
class RunningSurface {
 public:
  /// A smooth surface. `radius`: of a wheel, after whose circumference x returns; 0: a rail. `start`: where
  /// the wheel's sweep angle 0 meets the rail. [m]
  explicit RunningSurface(double radius = 0, double start = 0) : radius_(radius), start_(start) {}

  /// Adds a shape whose zero lies at x = `at` [m].
  void add(DepthShapePointer shape, double at);

  SurfaceDepth at(double x, double y) const;
  /// The same at a wheel's sweep angle [rad]; in free rolling it meets the rail at x = start - radius angle.
  SurfaceDepth around(double angle, double y) const { return at(start_ - radius_ * angle, y); }
  double radius() const { return radius_; }  ///< [m]

  bool smooth() const { return shapes_.empty(); }
  /// Depth that a wheel of `radius` [m] which touches the surface may find within `gap` [m] of it [m].
  double room(double radius, double gap) const;
  double steepest() const { return steepest_; }  ///< bound of the derivatives' sizes [-]

 private:
  struct Placed {
    DepthShapePointer shape;
    double at;  ///< [m]
  };
  std::vector<Placed> shapes_;
  double radius_, start_;
  double steepest_ = 0;
};

/// Depth by which a rigid round wheel at x runs lower for the depths of both surfaces: it rolls on the
/// highest places about x, at y across [m].
double traced_depth(const RunningSurface& rail, const RunningSurface& wheel, double wheel_radius, double x,
                    double y);

}  // namespace tread
