#pragma once
// Structured patches of quads and the sections of rail and wheel that they make up.

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "core/geometry/plane_curve.hpp"
#include "core/mesh/grading.hpp"
#include "core/mesh/section.hpp"

namespace tread {

/// Breaks for graded() on a curve: the parameters `from`, every joint between, `to`.
std::vector<double> breaks_on(const PlaneCurve& curve, double from, double to);
std::vector<Point2> positions(const PlaneCurve& curve, std::span<const double> parameters);
/// Positions at count + 1 evenly spaced parameters.
std::vector<Point2> positions(const PlaneCurve& curve, double from, double to, int count);
std::vector<Point2> straight(Point2 first, Point2 last, int count);
std::vector<Point2> at_height(std::span<const double> x, double y);

/// (columns + 1) x (rows + 1) points; column i runs along increasing x, row j along increasing y.
struct Patch {
  Patch(int columns_, int rows_) : columns(columns_), rows(rows_), points(index(columns_, rows_) + 1) {}
  Point2& at(int i, int j) { return points[index(i, j)]; }
  Point2 at(int i, int j) const { return points[index(i, j)]; }
  std::size_t index(int i, int j) const {
    return static_cast<std::size_t>(j) * (static_cast<std::size_t>(columns) + 1) +
           static_cast<std::size_t>(i);
  }
  int columns, rows;
  std::vector<Point2> points;
};

/// The four sides of a patch: bottom and top by increasing i, left and right by increasing j; corners shared.
struct PatchSides {
  std::vector<Point2> bottom, top, left, right;
};

/// Repeats the upper corners at the end of both of their sides, as fill_layered() expects for collapsed
/// corners.
void collapse_upper_corners(PatchSides& sides);

/// Transfinite interpolation between the sides.
Patch fill(const PatchSides& sides);

/// Columns are straight between bottom and top except near curved left and right sides. Where weight[i] = 1,
/// their nodes stand at `layers` (fractions from the bottom, rows + 1 of them). Where weight[i] = 0, they are
/// spaced as on the left and right sides. Two sides that meet may end with their common corner twice: the
/// corner is then collapsed and its cell has no area. A smooth outline passes through such a corner without a
/// flat cell.
Patch fill_layered(const PatchSides& sides, std::span<const double> layers, std::span<const double> weight);

/// Collects patches into a section. Nodes closer than 1e-7 m are merged.
class SectionBuilder {
 public:
  /// Adds a patch without the cells of collapsed corners.
  void add(const Patch& patch);
  /// Nodes at the given points, which must exist.
  std::vector<int> nodes_at(std::span<const Point2> points) const;
  void path(const std::string& name, std::span<const Point2> points);
  /// Makes the edges between consecutive parameters of the curve the running surface, with its one-sided
  /// tangents.
  void surface(const PlaneCurve& curve, std::span<const double> parameters);
  Section take() { return std::move(section_); }

 private:
  /// Numbers along x and y of a square of the plane, some times as wide as the distance at which nodes merge.
  using Cell = std::array<std::int64_t, 2>;
  static Cell cell_of(Point2 point);
  /// The first node at the point, or -1.
  int find(Point2 point) const;

  Section section_;
  std::map<Cell, std::vector<int>> nodes_in_;  ///< by cell, so that a point is compared with few nodes
};

/// Rotates the section and its tangents about the origin by `angle` [rad], counter-clockwise.
void rotate(Section& section, double angle);
void translate(Section& section, Point2 shift);

/// Grid over p x q with paths "bottom", "top", "left" and "right".
Section rectangle(std::span<const double> p, std::span<const double> q);
Section rectangle(double p0, double p1, int columns, double q0, double q1, int rows);

/// One structured block between a surface and the straight line q = bottom. Its running surface is the whole
/// `surface`; path `bottom_name` is the line. InputError, which names the scene's key of the block's height,
/// where the line lies not below the whole surface, MeshSizeError where the layers do not fit between.
Section block_under(const PlaneCurve& surface, double bottom, const SectionSize& size,
                    const std::string& bottom_name, const std::string& height_key);

/// Sum of the moments of all quads.
AreaMoments area_moments(const Section& section);

/// Moments of the body that the section sweeps in a full turn about q = 0.
struct RevolvedMoments {
  double volume = 0;  ///< [m3]
  double polar = 0;   ///< integral of r^2 over the volume: moment of inertia about the axis / density [m5]
};
RevolvedMoments revolved_moments(const Section& section);

}  // namespace tread
