#pragma once
// The web of a wheel from points of its drawing.

#include <vector>

#include "core/math/monotone_cubic.hpp"

namespace tread {

/// Both faces of a web over the radius, monotone cubics through the points of an outline.
class WebOutline {
 public:
  /// Points once around the web: from the hub along one face to the rim, and back along the other. `y`: to
  /// the field side of the nominal rolling circle; `r`: from the axis [m]. InputError where r falls on the
  /// way to the rim or grows on the way back, where the faces end apart from each other by more than 0.1 mm
  /// of radius, or meet.
  WebOutline(const std::vector<double>& y, const std::vector<double>& r);

  struct Faces {
    double gauge, field;  ///< y of both sides [m]
  };
  /// Faces at a radius from hub() to rim() [m].
  Faces at(double r) const { return {gauge_.value(r), field_.value(r)}; }
  double hub() const { return hub_; }                          ///< [m]
  double rim() const { return rim_; }                          ///< [m]
  double least_thickness() const { return least_thickness_; }  ///< across [m]

 private:
  MonotoneCubic gauge_, field_;
  double hub_ = 0, rim_ = 0, least_thickness_ = 0;
};

}  // namespace tread
