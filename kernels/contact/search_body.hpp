#pragma once
// Search of a contact point, for one index; on a device too. [theory.md, Contact]

#include <array>
#include <cmath>
#include <cstdint>

#include "kernels/contact/face_quadrature.hpp"
#include "kernels/contact/surface_pair_body.hpp"

namespace tread {

/// Bounds of a search.
struct SearchBounds {
  double far;            ///< gap above which it need not be precise [m]
  double margin;         ///< gap up to which points are kept [m]
  double closing_speed;  ///< of the surfaces at most [m/s]
  double time;           ///< of the search [s]

  /// Time from which on a face may close whose smallest gap is this [s].
  TREAD_BODY double wake_time(double smallest) const {
    return smallest > margin ? time + (smallest - margin) / closing_speed : time;
  }
};

/// The end of the searched surface.
struct SearchEnd {
  double room;                ///< distance from the wheel's axis along the rail [m]
  double outermost;           ///< integration point of a face, from its side
  int first_edge, last_edge;  ///< searched
  int edges;                  ///< of the rail

  /// True for a point of this edge, at `across` on it and at `ahead` [m] of the wheel's axis.
  TREAD_BODY bool has(int edge, double across, double ahead) const {
    const bool beside = (first_edge > 0 && edge == first_edge && across <= outermost) ||
                        (last_edge < edges && edge == last_edge - 1 && across >= 1 - outermost);
    return beside || std::abs(ahead) >= room;
  }
};

/// Sets place, bases, history and velocity of a point of a face, and its gap [m]. Returns false if it is left
/// out: it does not touch before the step ends, and carried no pressure `before`. Without velocities
/// (statics) the history stays zero.
template <class State>
TREAD_BODY bool find_point(const SurfacePairBody& surfaces, const State& state, const SearchBounds& bounds,
                           const std::array<int, 2>& face, const FaceQuadrature::Point& at,
                           const PointHistory& before, ContactPoint& point, double& gap) {
  surfaces.place(state, face, at.along, at.across, at.weight, point);
  gap = surfaces.find_gap(state, bounds.far, point);
  // A point that carried pressure stays until a step in which it carries none has released its energy.
  if (gap >= bounds.margin && !(before.pressure > 0)) return false;
  set_bases(point);
  if (state.velocity) {
    point.shear_before = before.shear;
    point.pressure_before = before.pressure;
    point.velocity_before = wheel_velocity(state, point) - rail_velocity(state, point);
  }
  return true;
}

/// True for a point that was apart and stays so unless it closes by more than `spare` [m/s] faster than in
/// the step before.
TREAD_BODY bool stays_open(const ContactPoint& point, double spare, double dt) {
  const double closing = dot(point.velocity_before, point.normal) + spare;
  return point.pressure_before <= 0 && point.gap >= 0.5 * dt * closing;
}

}  // namespace tread
