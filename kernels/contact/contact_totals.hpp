#pragma once
// Sums over the patch at one instant.

#include <vector>

#include "core/math/vec.hpp"
#include "kernels/contact/contact_point.hpp"
#include "kernels/contact/contact_search.hpp"
#include "kernels/contact/patch_solver.hpp"

namespace tread {

struct ContactTotals {
  Vec3 force_on_rail;          ///< [N]
  double area = 0;             ///< [m2]
  double slip_area = 0;        ///< [m2]
  double max_pressure = 0;     ///< at integration points [Pa]
  double max_shear = 0;        ///< at integration points [Pa]
  double max_penetration = 0;  ///< [m]
  double penalty_energy = 0;   ///< stored in the normal and tangential penalties [J]
  Vec3 centre;                 ///< of pressure [m]
  Vec3 pressure_peak;          ///< position of the largest pressure [m]
};

/// Area of the patch by rows of points across the rail.
class PatchArea {
 public:
  PatchArea() = default;
  explicit PatchArea(const ContactSearch& search);

  /// Area of points in contact, in the order of the search [m2]. Counting points would make the area jump by
  /// whole points. A row ends where the penetration, linear at its border, falls to zero, at the latest at
  /// the next point.
  double of(const std::vector<ContactPoint>& points) const;

 private:
  class Row;
  double arc(int n) const;
  double border(int n, int step, const ContactPoint& point, const ContactPoint* there,
                const ContactPoint* opposite) const;

  int per_line_ = 1;
  std::vector<double> pitch_;        ///< by rail station [m]
  std::vector<double> line_weight_;  ///< share of a face's length, by line of points
  std::vector<double> across_;       ///< arc length across the rail up to each integration point of a row [m]
  double width_ = 0;                 ///< of the rail's surface along its arc [m]
};

/// Sums over the points in contact.
ContactTotals sum_up(const std::vector<ContactPoint>& points, const PointSprings& springs,
                     const PatchArea& area);

}  // namespace tread
