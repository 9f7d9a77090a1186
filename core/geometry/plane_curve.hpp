#pragma once
// Plane curves of straight segments, circular arcs and graph cubics: the exact profiles of rail and wheel.

#include <functional>
#include <span>
#include <vector>

namespace tread {

struct Point2 {
  double x = 0, y = 0;
};

inline Point2 operator+(Point2 a, Point2 b) {
  return {a.x + b.x, a.y + b.y};
}
inline Point2 operator-(Point2 a, Point2 b) {
  return {a.x - b.x, a.y - b.y};
}
inline Point2 operator*(double s, Point2 a) {
  return {s * a.x, s * a.y};
}
inline double dot(Point2 a, Point2 b) {
  return a.x * b.x + a.y * b.y;
}
inline double cross(Point2 a, Point2 b) {
  return a.x * b.y - a.y * b.x;
}
double norm(Point2 a);

struct CurvePoint {
  Point2 position;  ///< [m]
  Point2 tangent;   ///< unit tangent in the direction of increasing s
};

/// The piece that gives tangent and curvature at a joint, where they may jump.
enum class Side { before, after };

/// A curve built piece by piece from its start. The parameter s [m] is the arc length on segments and arcs;
/// on a graph cubic it is the chord length, spread evenly over the abscissa.
class PlaneCurve {
 public:
  explicit PlaneCurve(Point2 start) : end_(start) {}

  PlaneCurve& line_to(Point2 end);
  /// Appends the shorter arc about `centre`. Start and end must have equal distances from it to 1e-8 m.
  PlaneCurve& arc_to(Point2 end, Point2 centre);
  /// Appends a cubic y(x) with the given slopes dy/dx at start and end; end.x > start.x.
  PlaneCurve& cubic_to(Point2 end, double slope_start, double slope_end);
  /// Appends a curve whose start lies within 1e-8 m of the end of this curve.
  PlaneCurve& append(const PlaneCurve& other);

  double length() const { return length_; }
  Point2 start() const { return at(0).position; }
  Point2 end() const { return end_; }
  CurvePoint at(double s, Side side = Side::after) const;

  /// Parameters strictly inside (from, to) at which the tangent or the curvature may jump. The pieces of an
  /// interpolated table do not count.
  std::vector<double> joints(double from, double to) const;

  /// First parameter, going from `from` to `to` in either direction, at which f is positive; `to` if there is
  /// none. Crossings closer together than 1/4000 of the distance may be missed.
  double first(double from, double to, const std::function<double(const CurvePoint&)>& f) const;

  /// Parameter of the point with abscissa x on a curve of increasing x. Outside the curve's range: parameter
  /// of the nearer end.
  double at_x(double x) const;

 private:
  enum class Kind { line, arc, cubic };
  struct Piece {
    Kind kind = Kind::line;
    Point2 start, end;
    Point2 centre;                          // arc: centre
    double angle = 0, turn = 0;             // arc: polar angle of the start, signed angle to the end [rad]
    double slope_start = 0, slope_end = 0;  // cubic: dy/dx at start and end
    double from = 0, length = 0;
  };

  void push(Piece piece);
  static CurvePoint point_on(const Piece& piece, double t);

  Point2 end_;
  double length_ = 0;
  std::vector<Piece> pieces_;
};

/// Interpolates the points (x increasing strictly, at least 3) by a C1 cubic whose slopes are those of the
/// parabola through three neighbours. Throws InputError that names `place` and the offending point.
PlaneCurve curve_through(std::span<const double> x, std::span<const double> y, const char* place);

/// Area and second moments of area about the centroid.
struct AreaMoments {
  double area = 0;        ///< [m2]
  Point2 centroid;        ///< [m]
  double xx = 0, yy = 0;  ///< integrals of (x - xc)^2 and (y - yc)^2 [m4]
};

/// Moments of a counter-clockwise polygon.
AreaMoments polygon_moments(std::span<const Point2> corners);

/// Moments of several parts together.
AreaMoments sum(std::span<const AreaMoments> parts);

}  // namespace tread
