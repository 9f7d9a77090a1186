#include "core/mesh/structured.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <stdexcept>
#include <utility>

#include "core/error.hpp"
#include "core/index.hpp"

namespace tread {

namespace {

constexpr double kMerge = 1e-7;  // [m]

}  // namespace

std::vector<double> breaks_on(const PlaneCurve& curve, double from, double to) {
  std::vector<double> result = curve.joints(from, to);
  result.insert(result.begin(), from);
  result.push_back(to);
  return result;
}

std::vector<Point2> positions(const PlaneCurve& curve, std::span<const double> parameters) {
  std::vector<Point2> points;
  for (const double s : parameters) points.push_back(curve.at(s).position);
  return points;
}

std::vector<Point2> positions(const PlaneCurve& curve, double from, double to, int count) {
  return positions(curve, evenly(from, to, count));
}

std::vector<Point2> straight(Point2 first, Point2 last, int count) {
  std::vector<Point2> points;
  points.reserve(static_cast<std::size_t>(count) + 1);
  for (int i = 0; i < count; ++i) points.push_back(first + (static_cast<double>(i) / count) * (last - first));
  points.push_back(last);
  return points;
}

std::vector<Point2> at_height(std::span<const double> x, double y) {
  std::vector<Point2> points;
  for (const double value : x) points.push_back({value, y});
  return points;
}

namespace {

/// Fractions of the chord length along a polyline.
std::vector<double> fractions(std::span<const Point2> line) {
  std::vector<double> result = {0.0};
  for (std::size_t i = 1; i < line.size(); ++i) result.push_back(result.back() + norm(line[i] - line[i - 1]));
  for (double& value : result) value /= result.back();
  result.back() = 1;
  return result;
}

void check_sides(const PatchSides& s) {
  const auto meet = [](Point2 a, Point2 b) { return norm(a - b) < kMerge; };
  if (s.bottom.size() != s.top.size() || s.left.size() != s.right.size() ||
      !meet(s.bottom.front(), s.left.front()) || !meet(s.bottom.back(), s.right.front()) ||
      !meet(s.top.front(), s.left.back()) || !meet(s.top.back(), s.right.back()))
    throw std::invalid_argument("patch: the sides do not match");
}

}  // namespace

void collapse_upper_corners(PatchSides& sides) {
  for (auto* side : {&sides.top, &sides.left, &sides.right}) side->push_back(side->back());
  sides.top.insert(sides.top.begin(), sides.top.front());
}

Patch fill(const PatchSides& s) {
  check_sides(s);
  Patch patch(static_cast<int>(s.bottom.size()) - 1, static_cast<int>(s.left.size()) - 1);
  const auto ub = fractions(s.bottom), ut = fractions(s.top), vl = fractions(s.left), vr = fractions(s.right);
  for (std::size_t j = 0; j < s.left.size(); ++j)
    for (std::size_t i = 0; i < s.bottom.size(); ++i) {
      // Crossing of the straight lines between opposite sides' fractions.
      const double u = (ub[i] + vl[j] * (ut[i] - ub[i])) / (1 - (ut[i] - ub[i]) * (vr[j] - vl[j]));
      const double v = vl[j] + u * (vr[j] - vl[j]);
      const Point2 ruled = (1 - v) * s.bottom[i] + v * s.top[i] + (1 - u) * s.left[j] + u * s.right[j];
      const Point2 corners = (1 - u) * ((1 - v) * s.bottom.front() + v * s.top.front()) +
                             u * ((1 - v) * s.bottom.back() + v * s.top.back());
      patch.at(static_cast<int>(i), static_cast<int>(j)) = ruled - corners;
    }
  // Copies the sides, so that they carry no rounding.
  for (int i = 0; i <= patch.columns; ++i) {
    patch.at(i, 0) = s.bottom[index(i)];
    patch.at(i, patch.rows) = s.top[index(i)];
  }
  for (int j = 1; j < patch.rows; ++j) {
    patch.at(0, j) = s.left[index(j)];
    patch.at(patch.columns, j) = s.right[index(j)];
  }
  return patch;
}

namespace {

/// Middle of the four neighbours. Beside a collapsed corner two of them are one node and count once.
Point2 middle_of_neighbours(const Patch& patch, int i, int j) {
  const std::array<Point2, 4> neighbours = {patch.at(i - 1, j), patch.at(i + 1, j), patch.at(i, j - 1),
                                            patch.at(i, j + 1)};
  Point2 sum;
  int count = 0;
  for (auto here = neighbours.begin(); here != neighbours.end(); ++here) {
    const auto same = [&](Point2 other) { return norm(other - *here) < kMerge; };
    if (std::any_of(neighbours.begin(), here, same)) continue;
    sum = sum + *here;
    ++count;
  }
  return (1.0 / count) * sum;
}

/// Moves inner nodes towards the middle of their neighbours where `held` is below 1. Corners of a patch that
/// lie on a smooth outline thus get cells of a useful shape.
void relax(Patch& patch, std::span<const double> held) {
  constexpr int kPasses = 16;
  for (int pass = 0; pass < kPasses; ++pass) {
    const Patch before = patch;
    for (int j = 1; j < patch.rows; ++j)
      for (int i = 1; i < patch.columns; ++i) {
        const Point2 middle = middle_of_neighbours(before, i, j);
        patch.at(i, j) = patch.at(i, j) + (1 - held[index(i)]) * (middle - patch.at(i, j));
      }
  }
}

/// Fraction of a side's bulge that its rows keep at `distance`, which is a fraction of the width. Leaning
/// columns cost time step, so the bulge fades before the fine columns begin.
double bulge_at(double distance) {
  constexpr double kReach = 0.15;
  return std::exp(-(distance / kReach) * (distance / kReach));
}

}  // namespace

Patch fill_layered(const PatchSides& s, std::span<const double> layers, std::span<const double> weight) {
  check_sides(s);
  Patch patch(static_cast<int>(s.bottom.size()) - 1, static_cast<int>(s.left.size()) - 1);
  const auto u = fractions(s.top), vl = fractions(s.left), vr = fractions(s.right);
  for (int j = 0; j <= patch.rows; ++j) {
    // Distance of the curved sides from the straight line between their ends.
    const Point2 bulge_left =
        s.left[index(j)] - (s.left.front() + vl[index(j)] * (s.left.back() - s.left.front()));
    const Point2 bulge_right =
        s.right[index(j)] - (s.right.front() + vr[index(j)] * (s.right.back() - s.right.front()));
    for (int i = 0; i <= patch.columns; ++i) {
      const double x = u[index(i)], w = weight[index(i)];
      const double side = (1 - x) * vl[index(j)] + x * vr[index(j)];
      const double v = w * layers[index(j)] + (1 - w) * side;
      patch.at(i, j) = s.bottom[index(i)] + v * (s.top[index(i)] - s.bottom[index(i)]) +
                       bulge_at(x) * bulge_left + bulge_at(1 - x) * bulge_right;
    }
  }
  for (int i = 0; i <= patch.columns; ++i) {
    patch.at(i, 0) = s.bottom[index(i)];
    patch.at(i, patch.rows) = s.top[index(i)];
  }
  relax(patch, weight);
  return patch;
}

SectionBuilder::Cell SectionBuilder::cell_of(Point2 point) {
  constexpr double kWidth = 16 * kMerge;
  return {static_cast<std::int64_t>(std::floor(point.x / kWidth)),
          static_cast<std::int64_t>(std::floor(point.y / kWidth))};
}

int SectionBuilder::find(Point2 point) const {
  int first = -1;
  const Cell low = cell_of({point.x - kMerge, point.y - kMerge});
  const Cell high = cell_of({point.x + kMerge, point.y + kMerge});
  for (std::int64_t x = low[0]; x <= high[0]; ++x)
    for (std::int64_t y = low[1]; y <= high[1]; ++y) {
      const auto cell = nodes_in_.find(Cell{x, y});
      if (cell == nodes_in_.end()) continue;
      for (const int n : cell->second)
        if (std::abs(section_.p[index(n)] - point.x) < kMerge &&
            std::abs(section_.q[index(n)] - point.y) < kMerge && (first < 0 || n < first))
          first = n;
    }
  return first;
}

void SectionBuilder::add(const Patch& patch) {
  std::vector<int> node;
  for (const Point2& point : patch.points) {
    int n = find(point);
    if (n < 0) {
      n = section_.nodes();
      section_.p.push_back(point.x);
      section_.q.push_back(point.y);
      nodes_in_[cell_of(point)].push_back(n);
    }
    node.push_back(n);
  }
  for (int j = 0; j < patch.rows; ++j)
    for (int i = 0; i < patch.columns; ++i) {
      const int at = j * (patch.columns + 1) + i;
      const std::array<int, 4> quad = {node[index(at)], node[index(at + 1)],
                                       node[index(at + patch.columns + 2)],
                                       node[index(at + patch.columns + 1)]};
      const bool collapsed = std::set<int>(quad.begin(), quad.end()).size() == 2;
      if (collapsed) continue;
      section_.quads.push_back(quad);
      section_.quad_material.push_back(0);
    }
}

std::vector<int> SectionBuilder::nodes_at(std::span<const Point2> points) const {
  std::vector<int> nodes;
  for (const Point2& point : points) {
    nodes.push_back(find(point));
    if (nodes.back() < 0)
      throw std::invalid_argument(fmt::format("section: no node at ({}, {})", point.x, point.y));
  }
  return nodes;
}

void SectionBuilder::path(const std::string& name, std::span<const Point2> points) {
  section_.paths[name] = nodes_at(points);
}

void SectionBuilder::surface(const PlaneCurve& curve, std::span<const double> parameters) {
  const auto has = [](const std::array<int, 4>& quad, int node) {
    return std::find(quad.begin(), quad.end(), node) != quad.end();
  };
  for (std::size_t k = 1; k < parameters.size(); ++k) {
    const CurvePoint first = curve.at(parameters[k - 1], Side::after),
                     second = curve.at(parameters[k], Side::before);
    const Point2 ends[] = {first.position, second.position};
    const auto nodes = nodes_at(ends);
    SurfaceEdge edge;
    edge.node = {nodes[0], nodes[1]};
    edge.tangent = {{{first.tangent.x, first.tangent.y}, {second.tangent.x, second.tangent.y}}};
    for (std::size_t quad = 0; quad < section_.quads.size(); ++quad)
      if (has(section_.quads[quad], nodes[0]) && has(section_.quads[quad], nodes[1]))
        edge.quad = static_cast<int>(quad);
    if (edge.quad < 0) throw std::invalid_argument("section: a surface edge is no edge of a quad");
    section_.surface.push_back(edge);
  }
}

void rotate(Section& section, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  const auto turn = [&](double& x, double& y) {
    const double x0 = x;
    x = c * x0 - s * y;
    y = s * x0 + c * y;
  };
  for (std::size_t n = 0; n < section.p.size(); ++n) turn(section.p[n], section.q[n]);
  for (SurfaceEdge& edge : section.surface)
    for (auto& tangent : edge.tangent) turn(tangent[0], tangent[1]);
}

void translate(Section& section, Point2 shift) {
  for (double& p : section.p) p += shift.x;
  for (double& q : section.q) q += shift.y;
}

Section rectangle(std::span<const double> p, std::span<const double> q) {
  Patch patch(static_cast<int>(p.size()) - 1, static_cast<int>(q.size()) - 1);
  for (int j = 0; j <= patch.rows; ++j)
    for (int i = 0; i <= patch.columns; ++i) patch.at(i, j) = {p[index(i)], q[index(j)]};
  SectionBuilder builder;
  builder.add(patch);
  builder.path("bottom", at_height(p, q.front()));
  builder.path("top", at_height(p, q.back()));
  std::vector<Point2> left, right;
  for (const double value : q) {
    left.push_back({p.front(), value});
    right.push_back({p.back(), value});
  }
  builder.path("left", left);
  builder.path("right", right);
  return builder.take();
}

Section rectangle(double p0, double p1, int columns, double q0, double q1, int rows) {
  if (columns < 1 || rows < 1 || !(p1 > p0) || !(q1 > q0))
    throw InputError(fmt::format("rectangle {} ... {} x {} ... {} m of {} x {} elements is empty", p0, p1, q0,
                                 q1, columns, rows));
  return rectangle(evenly(p0, p1, columns), evenly(q0, q1, rows));
}

Section block_under(const PlaneCurve& surface, double bottom, const SectionSize& size,
                    const std::string& bottom_name, const std::string& height_key) {
  const double lowest = std::min(surface.start().y, surface.end().y);
  const double height = lowest - bottom;
  const double least = std::ceil(1e4 * (size.fine_layers * size.surface - lowest)) * 1e-4;
  if (height <= 0)
    throw InputError(fmt::format(
        "{} = {:.4g} mm: the running surface falls by {:.4g} mm to its ends; state {:.4g} mm at least, which "
        "leaves room for {} layers of {:.4g} mm",
        height_key, -1e3 * bottom, -1e3 * lowest, 1e3 * least, size.fine_layers, 1e3 * size.surface));
  check(size, height, "block under a running surface",
        fmt::format(", or {} = {:.4g} mm at least", height_key, 1e3 * least));
  const auto s = graded(breaks_on(surface, 0, surface.length()),
                        [&](double at) { return size.column(surface.at(at).position.x, size.coarse); });
  PatchSides sides;
  sides.top = positions(surface, s);
  for (const Point2& point : sides.top) sides.bottom.push_back({point.x, bottom});
  const auto layers = from_below(layer_depths(size, height));
  for (const double fraction : layers) {
    sides.left.push_back(sides.bottom.front() + fraction * (sides.top.front() - sides.bottom.front()));
    sides.right.push_back(sides.bottom.back() + fraction * (sides.top.back() - sides.bottom.back()));
  }
  SectionBuilder builder;
  builder.add(fill_layered(sides, layers, std::vector<double>(s.size(), 1.0)));
  builder.surface(surface, s);
  builder.path(bottom_name, sides.bottom);
  return builder.take();
}

AreaMoments area_moments(const Section& section) {
  std::vector<AreaMoments> parts;
  for (const auto& quad : section.quads) {
    std::array<Point2, 4> corners;
    for (std::size_t c = 0; c < 4; ++c) corners[c] = {section.p[index(quad[c])], section.q[index(quad[c])]};
    parts.push_back(polygon_moments(corners));
  }
  return sum(parts);
}

RevolvedMoments revolved_moments(const Section& section) {
  RevolvedMoments total;
  for (const auto& quad : section.quads)
    for (const auto& [b, c] : {std::pair{1, 2}, std::pair{2, 3}}) {
      const auto at = [&](int corner) {
        return Point2{section.p[index(quad[index(corner)])], section.q[index(quad[index(corner)])]};
      };
      const Point2 A = at(0), B = at(b), C = at(c);
      const double area = cross(B - A, C - A) / 2;
      const double r1 = A.y + B.y + C.y;
      const double r2 = A.y * A.y + B.y * B.y + C.y * C.y;
      const double r3 = A.y * A.y * A.y + B.y * B.y * B.y + C.y * C.y * C.y;
      // Complete homogeneous polynomials of the corner radii: integral r = area h1 / 3, integral r^3 = area
      // h3 / 10.
      const double h3 = (r1 * r1 * r1 + 3 * r1 * r2 + 2 * r3) / 6;
      total.volume += 2 * std::numbers::pi * area * r1 / 3;
      total.polar += 2 * std::numbers::pi * area * h3 / 10;
    }
  return total;
}

}  // namespace tread
