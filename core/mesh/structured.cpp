#include "core/mesh/structured.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <stdexcept>
#include <utility>

#include "core/error.hpp"

namespace tread {

namespace {

constexpr double kMerge = 1e-7;         // [m]
constexpr double kColumnGrowth = 0.22;  // d(size)/d(distance): neighbours grow by about exp(0.22)
constexpr double kRowGrowth = 1.45;     // most, from row to row

std::size_t index(int i) {
  return static_cast<std::size_t>(i);
}

}  // namespace

double SectionSize::column(double p, double largest) const {
  const double outside = std::max(0.0, std::abs(p - band_centre) - band_half_width);
  return std::max(surface, std::min(largest, surface + kColumnGrowth * outside));
}

double SectionSize::layer_weight(double p, double left, double right) const {
  const double reach = p < band_centre ? band_centre - left : right - band_centre;
  const double full = std::clamp(reach - 10e-3, 0.0, band_half_width);
  if (reach <= full) return 0;
  return std::clamp((reach - std::abs(p - band_centre)) / (reach - full), 0.0, 1.0);
}

void check(const SectionSize& size, double depth, const std::string& name) {
  if (!(size.surface > 0) || !(size.coarse > 0) || !(size.band_half_width > 0) || size.fine_layers < 1)
    throw InputError(
        fmt::format("{}: element sizes {} and {} m, band half width {} m, {} layers: all have to be positive",
                    name, size.surface, size.coarse, size.band_half_width, size.fine_layers));
  if (size.fine_layers * size.surface > depth)
    throw InputError(
        fmt::format("{}: {} layers of {} m do not fit into {} m below the surface; reduce element_size", name,
                    size.fine_layers, size.surface, depth));
}

std::vector<double> graded(std::span<const double> breaks, const std::function<double(double)>& size) {
  constexpr int samples = 400;
  std::vector<double> result = {breaks.front()};
  for (std::size_t k = 1; k < breaks.size(); ++k) {
    const double a = breaks[k - 1], step = (breaks[k] - a) / samples;
    std::vector<double> elements(samples + 1, 0.0);  // wanted number of elements from a on
    for (int i = 1; i <= samples; ++i)
      elements[index(i)] = elements[index(i - 1)] + step / size(a + (i - 0.5) * step);
    const double wanted = elements.back();
    // Rounds down more readily than up: a smaller element costs time step, a larger one costs little.
    const int count = std::max(1, static_cast<int>(std::min(wanted + 0.35, 1.09 * wanted + 0.1)));
    for (int i = 1; i < count; ++i) {
      const double target = wanted * i / count;
      const auto above = std::upper_bound(elements.begin(), elements.end(), target);
      const double part = (target - *(above - 1)) / (*above - *(above - 1));
      result.push_back(a + step * (static_cast<double>(above - elements.begin()) - 1 + part));
    }
    result.push_back(breaks[k]);
  }
  return result;
}

std::vector<double> evenly(double first, double last, int count) {
  std::vector<double> values;
  values.reserve(static_cast<std::size_t>(count) + 1);
  for (int i = 0; i < count; ++i) values.push_back(first + (last - first) * i / count);
  values.push_back(last);
  return values;
}

std::vector<double> layer_depths(const SectionSize& size, double depth) {
  const double fine = size.fine_layers * size.surface, rest = depth - fine;
  if (rest < 0.7 * size.surface) return evenly(0, depth, size.fine_layers);
  const double largest = std::max(size.surface, size.coarse);
  const auto rows_below = [&](double growth, int count) {
    std::vector<double> depths = {fine};
    double row = size.surface;
    for (int i = 0; i < count; ++i) depths.push_back(depths.back() + std::min(row *= growth, largest));
    return depths;
  };
  int count = 1;
  while (rows_below(kRowGrowth, count).back() < depth) ++count;
  double low = 0, high = kRowGrowth;
  for (int step = 0; step < 60; ++step) {
    const double growth = 0.5 * (low + high);
    (rows_below(growth, count).back() < depth ? low : high) = growth;
  }
  const auto below = rows_below(high, count);
  std::vector<double> depths = evenly(0, fine, size.fine_layers);
  depths.insert(depths.end(), below.begin() + 1, below.end());
  depths.back() = depth;
  return depths;
}

std::vector<double> from_below(std::span<const double> depths) {
  std::vector<double> result;
  for (auto depth = depths.rbegin(); depth != depths.rend(); ++depth)
    result.push_back(1 - *depth / depths.back());
  result.back() = 1;
  return result;
}

std::vector<double> nested(std::span<const double> fine, std::span<const double> coarse,
                           const std::string& name) {
  const int edges = static_cast<int>(coarse.size()) - 1, last = static_cast<int>(fine.size()) - 1;
  if (edges > last)
    throw InputError(
        fmt::format("{}: {} coarse elements meet {} fine ones along the tie; give a larger coarse size or a "
                    "smaller element_size",
                    name, edges, last));
  std::vector<int> at(coarse.size());
  for (int k = 0; k <= edges; ++k) {
    const auto next = std::lower_bound(fine.begin(), fine.end(), coarse[index(k)]);
    int nearest = static_cast<int>(next - fine.begin());
    if (nearest > last || (nearest > 0 && coarse[index(k)] - fine[index(nearest - 1)] <
                                              fine[index(nearest)] - coarse[index(k)]))
      --nearest;
    at[index(k)] = k == 0 ? 0 : std::max(nearest, at[index(k - 1)] + 1);
  }
  at[index(edges)] = last;
  for (int k = edges - 1; k > 0; --k) at[index(k)] = std::min(at[index(k)], at[index(k + 1)] - 1);

  std::vector<double> result = {coarse.front()};
  for (int k = 0; k < edges; ++k) {
    const auto part = evenly(coarse[index(k)], coarse[index(k + 1)], at[index(k + 1)] - at[index(k)]);
    result.insert(result.end(), part.begin() + 1, part.end());
  }
  return result;
}

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
      // Where the straight lines between opposite sides' fractions cross.
      const double u = (ub[i] + vl[j] * (ut[i] - ub[i])) / (1 - (ut[i] - ub[i]) * (vr[j] - vl[j]));
      const double v = vl[j] + u * (vr[j] - vl[j]);
      const Point2 ruled = (1 - v) * s.bottom[i] + v * s.top[i] + (1 - u) * s.left[j] + u * s.right[j];
      const Point2 corners = (1 - u) * ((1 - v) * s.bottom.front() + v * s.top.front()) +
                             u * ((1 - v) * s.bottom.back() + v * s.top.back());
      patch.at(static_cast<int>(i), static_cast<int>(j)) = ruled - corners;
    }
  // The sides themselves without rounding.
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

/// Of the four neighbours; beside a collapsed corner two of them are one node and count once.
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

/// Moves inner nodes towards the middle of their neighbours where `held` is below 1: corners of a patch that
/// lie on a smooth outline get cells of a useful shape.
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

/// How much of a side's bulge its rows keep at a distance, a fraction of the width: columns that lean cost
/// time step, so it fades before the fine columns begin.
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
    // How far the curved sides stand off the straight line between their ends.
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

int SectionBuilder::find(Point2 point) const {
  for (int n = 0; n < section_.nodes(); ++n)
    if (std::abs(section_.p[index(n)] - point.x) < kMerge &&
        std::abs(section_.q[index(n)] - point.y) < kMerge)
      return n;
  return -1;
}

void SectionBuilder::add(const Patch& patch) {
  std::vector<int> node;
  for (const Point2& point : patch.points) {
    int n = find(point);
    if (n < 0) {
      n = section_.nodes();
      section_.p.push_back(point.x);
      section_.q.push_back(point.y);
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
                    const std::string& bottom_name) {
  const double height = std::min(surface.start().y, surface.end().y) - bottom;
  check(size, height, "block under a running surface");
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
