#pragma once
// Contact of two alike elastic half-spaces on a grid of cells with constant traction: the reference that
// finite elements are compared with. ElasticPair::alike() stands for two bodies that are not alike. [Johnson,
// Contact Mechanics, ch. 3; Kalker, Three-Dimensional Elastic Bodies in Rolling Contact, ch. 4]
//
// x points in the rolling direction, y across, z down into the rail; the patch is at rest. All SI.

#include <functional>
#include <vector>

#include "core/math/elastic_pair.hpp"

namespace tread::half_space {

/// Elastic constants of either body.
using Material = ElasticConstants;

/// nx x ny rectangular cells; fields hold nx * ny values, x running fastest.
struct Grid {
  int nx = 0, ny = 0;
  double dx = 0, dy = 0;  ///< sides of a cell [m]
  double x0 = 0, y0 = 0;  ///< centre of cell (0, 0) [m]

  int size() const { return nx * ny; }
  int index(int i, int j) const { return j * nx + i; }
  double x(int i) const { return x0 + i * dx; }
  double y(int j) const { return y0 + j * dy; }
};

/// Square cells of side `cell` [m] that cover |x| <= half_x and |y| <= half_y [m]; the origin is a cell's
/// centre, or, with `node`, a corner of four cells.
Grid centred_grid(double half_x, double half_y, double cell, bool node = false);

/// Distance from a hollow's middle [m] up to which a patch of this semi-axis [m] may reach. On its slope a
/// wheel of this radius [m] touches where it is as steep, twice as far away in a hollow half as curved [1/m];
/// more curved hollows are bridged, at most from edge to edge.
double reach_in_hollow(double semi_axis, double radius, double curvature, double slope, double edge);

/// A cell field between the cells' centres, bilinear; zero beyond the outermost.
double interpolated(const Grid& grid, const std::vector<double>& field, double x, double y);

/// A coefficient for every offset |di| <= reach_x, |dj| <= reach_y of a target cell from a loaded cell.
class OffsetTable {
 public:
  OffsetTable() = default;
  OffsetTable(int reach_x, int reach_y)
      : width_(2 * reach_x + 1),
        values_(std::size_t(width_) * (2 * reach_y + 1)),
        middle_(std::size_t(width_) * reach_y + reach_x) {}

  double& at(int di, int dj) { return values_[middle_ + dj * width_ + di]; }
  double at(int di, int dj) const { return values_[middle_ + dj * width_ + di]; }
  /// Coefficients of row dj; element di of the pointer may be negative.
  const double* row(int dj) const { return values_.data() + middle_ + dj * width_; }

 private:
  int width_ = 0;
  std::vector<double> values_;
  std::ptrdiff_t middle_ = 0;
};

/// Differences of the two bodies' surface displacements at a cell's centre under unit traction on a cell
/// [m/Pa]. [Johnson, sect. 3.3 and 3.6]
struct Influence {
  Influence(const Grid& grid, const Material& material);

  Grid grid;
  Material material;
  OffsetTable normal;      ///< approach of the surfaces under pressure
  OffsetTable xx, xy, yy;  ///< tangential; offsets reach one cell beyond the grid along x
};

/// sum += table applied to `load`; both nx * ny.
void apply(const OffsetTable& table, const Grid& grid, const std::vector<double>& load,
           std::vector<double>& sum);

struct NormalContact {
  std::vector<double> pressure;  ///< nx * ny [Pa]
  double load = 0;               ///< [N]
  double approach = 0;           ///< of distant points, from a gap function of value zero [m]
  double area = 0;               ///< of cells under pressure [m2]
  double max_pressure = 0;       ///< [Pa]
  int cells = 0;                 ///< under pressure
};

/// Undeformed distance of the surfaces [m] at x, y [m].
using Gap = std::function<double(double x, double y)>;

/// Frictionless contact under a total load [N], any gap; conjugate gradients on the contact set. Throws when
/// the contact reaches the border of the grid or does not converge. [Polonsky and Keer, Wear 231 (1999) 206]
NormalContact press(const Influence& influence, const Gap& gap, double load);

/// x^2 / (2 radius_x) + y^2 / (2 radius_y) [m].
Gap quadratic_gap(double radius_x, double radius_y);

}  // namespace tread::half_space
