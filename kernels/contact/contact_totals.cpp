#include "kernels/contact/contact_totals.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace tread {

PatchArea::PatchArea(const ContactSearch& search) : per_line_(search.quadrature().per_line()) {
  const SurfacePair& surfaces = search.surfaces();
  const FaceQuadrature& quadrature = search.quadrature();
  double arc = 0;
  for (int edge = 0; edge < surfaces.rail_profile().edges(); ++edge) {
    const auto middle = surfaces.rail_profile().evaluate(edge, 0.5, surfaces.kind());
    const double width = std::hypot(middle.dp, middle.dq);
    for (int i = 0; i < per_line_; ++i) across_.push_back(arc + quadrature.place(i) * width);
    arc += width;
  }
  width_ = arc;
  for (int line = 0; line < per_line_; ++line) line_weight_.push_back(quadrature.weight(line));
  const SweptBlock& rail = surfaces.rail();
  for (int station = 0; station + 1 < rail.station_count(); ++station) pitch_.push_back(rail.pitch(station));
}

/// Arc length of the n-th point of a row, mirrored at the ends of the surface: the outermost points stand for
/// the strips up to the ends. [m]
double PatchArea::arc(int n) const {
  if (n < 0) return -across_.front();
  if (n >= static_cast<int>(across_.size())) return 2 * width_ - across_.back();
  return across_[static_cast<std::size_t>(n)];
}

/// End of the stretch that the n-th point of a row stands for, towards the point `step` further, `there`.
/// Null: no such point in contact, or no `opposite` point on the other side. [m]
double PatchArea::border(int n, int step, const ContactPoint& point, const ContactPoint* there,
                         const ContactPoint* opposite) const {
  const double half_way = 0.5 * (arc(n) + arc(n + step));
  if (there || !opposite || opposite->pressure <= point.pressure) return half_way;
  const double reached =
      arc(n) + (arc(n) - arc(n - step)) * point.pressure / (opposite->pressure - point.pressure);
  return std::clamp(reached, std::max(0.0, arc(n - 1)), std::min(width_, arc(n + 1)));
}

/// Passes along one row of points and adds their stretches to the area.
class PatchArea::Row {
 public:
  Row(const PatchArea& area, double thickness, double& sum)
      : area_(&area), thickness_(thickness), sum_(&sum) {}

  /// The next point in contact; null at the end of the row.
  void pass(const ContactPoint* next) {
    const bool joined = point_ && next && place(*next) == place(*point_) + 1;
    if (point_) {
      const int n = place(*point_);
      *sum_ += thickness_ * (area_->border(n, 1, *point_, joined ? next : nullptr, before_) -
                             area_->border(n, -1, *point_, before_, joined ? next : nullptr));
    }
    before_ = joined ? point_ : nullptr;
    point_ = next;
  }

 private:
  /// Number of the point in a row across the whole rail.
  int place(const ContactPoint& point) const {
    return point.face[1] * area_->per_line_ + static_cast<int>(point.history % area_->per_line_);
  }

  const PatchArea* area_;
  double thickness_;                      ///< of the row along the rail [m]
  double* sum_;                           ///< [m2]
  const ContactPoint* before_ = nullptr;  ///< neighbours in contact
  const ContactPoint* point_ = nullptr;
};

double PatchArea::of(const std::vector<ContactPoint>& points) const {
  double area = 0;
  std::size_t first = 0;
  while (first < points.size()) {
    const int station = points[first].face[0];
    std::size_t last = first;
    while (last < points.size() && points[last].face[0] == station) ++last;
    const double length = pitch_[static_cast<std::size_t>(station)];
    for (int line = 0; line < per_line_; ++line) {
      Row row(*this, length * line_weight_[static_cast<std::size_t>(line)], area);
      for (std::size_t i = first; i < last; ++i)
        if (points[i].history / per_line_ % per_line_ == line) row.pass(&points[i]);
      row.pass(nullptr);
    }
    first = last;
  }
  return area;
}

ContactTotals sum_up(const std::vector<ContactPoint>& points, const PointSprings& springs,
                     const PatchArea& area_by_rows) {
  ContactTotals totals;
  double load = 0;
  for (const ContactPoint& point : points) {
    totals.force_on_rail += point.area * point.traction();
    totals.area += point.area;
    if (point.slips) totals.slip_area += point.area;
    load += point.area * point.pressure;
    totals.centre += point.area * point.pressure * point.position;
    if (point.pressure > totals.max_pressure) {
      totals.max_pressure = point.pressure;
      totals.pressure_peak = point.position;
    }
    totals.max_shear = std::max(totals.max_shear, std::hypot(point.shear.along, point.shear.across));
    totals.max_penetration = std::max(totals.max_penetration, point.pressure / springs.penalty);
    totals.penalty_energy += point.area * springs.stored(point.pressure, point.shear);
  }
  if (load <= 0) return totals;
  totals.centre = (1 / load) * totals.centre;
  const double area = area_by_rows.of(points);
  totals.slip_area *= area / totals.area;
  totals.area = area;
  return totals;
}

}  // namespace tread
