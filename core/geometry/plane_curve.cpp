#include "core/geometry/plane_curve.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/error.hpp"

namespace tread {

namespace {

constexpr double kJoin = 1e-8;  // [m]

}  // namespace

double norm(Point2 a) {
  return std::hypot(a.x, a.y);
}

void PlaneCurve::push(Piece piece) {
  piece.start = end_;
  piece.from = length_;
  end_ = piece.end;
  length_ += piece.length;
  pieces_.push_back(piece);
}

PlaneCurve& PlaneCurve::line_to(Point2 end) {
  Piece piece;
  piece.end = end;
  piece.length = norm(end - end_);
  push(piece);
  return *this;
}

PlaneCurve& PlaneCurve::arc_to(Point2 end, Point2 centre) {
  const Point2 a = end_ - centre, b = end - centre;
  if (std::abs(norm(a) - norm(b)) > kJoin)
    throw std::invalid_argument("PlaneCurve::arc_to: the ends have different distances from the centre");
  Piece piece;
  piece.kind = Kind::arc;
  piece.end = end;
  piece.centre = centre;
  piece.angle = std::atan2(a.y, a.x);
  piece.turn = std::atan2(cross(a, b), dot(a, b));
  piece.length = norm(a) * std::abs(piece.turn);
  push(piece);
  return *this;
}

PlaneCurve& PlaneCurve::cubic_to(Point2 end, double slope_start, double slope_end) {
  if (!(end.x > end_.x)) throw std::invalid_argument("PlaneCurve::cubic_to: x must increase");
  Piece piece;
  piece.kind = Kind::cubic;
  piece.end = end;
  piece.slope_start = slope_start;
  piece.slope_end = slope_end;
  piece.length = norm(end - end_);
  push(piece);
  return *this;
}

PlaneCurve& PlaneCurve::append(const PlaneCurve& other) {
  if (norm(other.start() - end_) > kJoin)
    throw std::invalid_argument("PlaneCurve::append: the curves do not meet");
  for (Piece piece : other.pieces_) push(piece);
  return *this;
}

CurvePoint PlaneCurve::point_on(const Piece& piece, double t) {
  CurvePoint point;
  const Point2 chord = piece.end - piece.start;
  switch (piece.kind) {
    case Kind::line:
      point.position = piece.start + t * chord;
      point.tangent = (1 / piece.length) * chord;
      break;
    case Kind::arc: {
      const double angle = piece.angle + t * piece.turn;
      const Point2 radial = {std::cos(angle), std::sin(angle)};
      const double radius = piece.length / std::abs(piece.turn);
      point.position = piece.centre + radius * radial;
      point.tangent = std::copysign(1.0, piece.turn) * Point2{-radial.y, radial.x};
      break;
    }
    case Kind::cubic: {
      const double a = piece.slope_start * chord.x - chord.y, b = chord.y - piece.slope_end * chord.x;
      const double u = 1 - t;
      point.position = piece.start + t * chord;
      point.position.y += t * u * (a * u + b * t);
      const double slope = (chord.y + (1 - 2 * t) * (a * u + b * t) + t * u * (b - a)) / chord.x;
      point.tangent = (1 / std::hypot(1.0, slope)) * Point2{1, slope};
      break;
    }
  }
  if (t == 0) point.position = piece.start;
  if (t == 1) point.position = piece.end;
  return point;
}

CurvePoint PlaneCurve::at(double s, Side side) const {
  if (pieces_.empty()) return {end_, {1, 0}};
  auto next = side == Side::after
                  ? std::upper_bound(pieces_.begin(), pieces_.end(), s,
                                     [](double value, const Piece& piece) { return value < piece.from; })
                  : std::lower_bound(pieces_.begin(), pieces_.end(), s,
                                     [](const Piece& piece, double value) { return piece.from < value; });
  const Piece& piece = next == pieces_.begin() ? *next : *(next - 1);
  return point_on(piece, std::clamp((s - piece.from) / piece.length, 0.0, 1.0));
}

std::vector<double> PlaneCurve::joints(double from, double to) const {
  std::vector<double> result;
  for (std::size_t i = 1; i < pieces_.size(); ++i) {
    const bool inside_table = pieces_[i].kind == Kind::cubic && pieces_[i - 1].kind == Kind::cubic;
    const double s = pieces_[i].from;
    if (!inside_table && s > from && s < to) result.push_back(s);
  }
  return result;
}

double PlaneCurve::first(double from, double to, const std::function<double(const CurvePoint&)>& f) const {
  constexpr int samples = 4000;
  if (f(at(from)) > 0) return from;
  for (int i = 1; i <= samples; ++i) {
    double outside = from + (to - from) * (i - 1) / samples;
    double inside = from + (to - from) * i / samples;
    if (!(f(at(inside)) > 0)) continue;
    for (int step = 0; step < 60; ++step) {
      const double middle = 0.5 * (outside + inside);
      (f(at(middle)) > 0 ? inside : outside) = middle;
    }
    return inside;
  }
  return to;
}

double PlaneCurve::at_x(double x) const {
  double low = 0, high = length_;
  if (x <= at(low).position.x) return low;
  if (x >= at(high).position.x) return high;
  for (int step = 0; step < 80; ++step) {
    const double middle = 0.5 * (low + high);
    (at(middle).position.x > x ? high : low) = middle;
  }
  return 0.5 * (low + high);
}

namespace {

/// Slope at x[i] of the parabola through the points i0, i0 + 1, i0 + 2.
double parabola_slope(std::span<const double> x, std::span<const double> y, std::size_t i0, std::size_t i) {
  const double d01 = (y[i0 + 1] - y[i0]) / (x[i0 + 1] - x[i0]);
  const double d12 = (y[i0 + 2] - y[i0 + 1]) / (x[i0 + 2] - x[i0 + 1]);
  const double second = (d12 - d01) / (x[i0 + 2] - x[i0]);
  return d01 + second * ((x[i] - x[i0]) + (x[i] - x[i0 + 1]));
}

}  // namespace

PlaneCurve curve_through(std::span<const double> x, std::span<const double> y, const char* place) {
  const std::size_t count = x.size();
  if (count < 3 || y.size() != count)
    throw InputError(fmt::format("{}: {} abscissae and {} ordinates: a profile needs at least 3 points",
                                 place, count, y.size()));
  for (std::size_t i = 0; i < count; ++i) {
    if (!std::isfinite(x[i]) || !std::isfinite(y[i]))
      throw InputError(fmt::format("{}: point {} is not a number", place, i + 1));
    if (i > 0 && !(x[i] > x[i - 1]))
      throw InputError(
          fmt::format("{}: y = {} m at point {} does not exceed the one before; sort the table by y and "
                      "remove points that repeat or fold back",
                      place, x[i], i + 1));
  }
  const auto slope = [&](std::size_t i) {
    return parabola_slope(x, y, std::min(i > 0 ? i - 1 : 0, count - 3), i);
  };
  PlaneCurve curve({x[0], y[0]});
  for (std::size_t i = 1; i < count; ++i) curve.cubic_to({x[i], y[i]}, slope(i - 1), slope(i));
  return curve;
}

AreaMoments polygon_moments(std::span<const Point2> corners) {
  AreaMoments m;
  const Point2 origin = corners[0];
  double sx = 0, sy = 0, sxx = 0, syy = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point2 a = corners[i] - origin, b = corners[(i + 1) % corners.size()] - origin;
    const double c = cross(a, b);
    m.area += c / 2;
    sx += c * (a.x + b.x) / 6;
    sy += c * (a.y + b.y) / 6;
    sxx += c * (a.x * a.x + a.x * b.x + b.x * b.x) / 12;
    syy += c * (a.y * a.y + a.y * b.y + b.y * b.y) / 12;
  }
  m.centroid = origin + (1 / m.area) * Point2{sx, sy};
  m.xx = sxx - sx * sx / m.area;
  m.yy = syy - sy * sy / m.area;
  return m;
}

AreaMoments sum(std::span<const AreaMoments> parts) {
  AreaMoments total;
  for (const AreaMoments& part : parts) {
    total.area += part.area;
    total.centroid = total.centroid + part.area * part.centroid;
  }
  total.centroid = (1 / total.area) * total.centroid;
  for (const AreaMoments& part : parts) {
    const Point2 d = part.centroid - total.centroid;
    total.xx += part.xx + part.area * d.x * d.x;
    total.yy += part.yy + part.area * d.y * d.y;
  }
  return total;
}

}  // namespace tread
