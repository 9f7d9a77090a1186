#pragma once
// The gap between the running surfaces of rail and wheel at a point, for one index; on a device too.
// [theory.md, Surfaces and Contact]

#include <array>
#include <cmath>
#include <limits>

#include "core/corrugation.hpp"
#include "core/running_surface.hpp"
#include "kernels/contact/contact_point.hpp"
#include "kernels/contact/contact_state.hpp"
#include "kernels/contact/surface_body.hpp"

namespace tread {

/// Shares of both ends of a line in a point at `at` in [0, 1]: the nearer end takes the point.
TREAD_BODY std::array<double, 2> nearer_end(double at) {
  if (std::abs(at - 0.5) < 1e-9) return {0.5, 0.5};
  return at < 0.5 ? std::array<double, 2>{1.0, 0.0} : std::array<double, 2>{0.0, 1.0};
}

/// One of the two surfaces.
struct SurfaceSide {
  StationLine stations;
  ProfileView profile;
  const double* p = nullptr;  ///< of the section's nodes [m]
  const double* q = nullptr;

  TREAD_BODY std::int64_t slot(int node, int station) const {
    return stations.slot[station] + std::int64_t{node} * kLanes;
  }
};

/// Depths of both surfaces.
struct SurfaceDepths {
  CorrugationView corrugation;
  RunningSurfaceView rail_depth;  ///< besides the corrugation
  RunningSurfaceView wheel_depth;

  /// Depth of the rail's surface at a place [m].
  TREAD_BODY double rail(double x, double y) const {
    const double depth = corrugation.depth(x, y);
    return rail_depth.smooth() ? depth : depth + rail_depth.at(x, y).depth;
  }
};

/// An extruded rail's surface under a revolved wheel's.
struct SurfacePairBody {
  SurfaceSide rail_side, wheel_side;
  SurfaceKind kind;
  SurfaceKind kind_across;  ///< of the displacement across
  SurfaceDepths depths;

  /// Sets nodes, weights, place, face and area of a point on a rail face; `along` and `across` on [0, 1],
  /// `share` of the face.
  template <class State>
  TREAD_BODY void place(const State& state, const std::array<int, 2>& face, double at_along, double at_across,
                        double share, ContactPoint& point) const {
    const int face_station = face[0];
    const int edge = face[1];
    const auto u = state.displacement;
    const StationLine& line = rail_side.stations;
    const bool exact = kind == SurfaceKind::exact;
    const auto profile = rail_side.profile.evaluate(edge, at_across, kind);
    const LineCell cell = station_cell(line, face_station);
    const LineWeights along = line_weights(cell, at_along, kind);
    const LineWeights over = line_weights(rail_side.profile.cell(edge), at_across, kind_across);
    Vec3 x{line.stations[face_station] + at_along * cell.length, profile.p, profile.q};
    double depth = exact ? depths.rail(x.x, x.y) : 0.0;
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < 4; ++j) {
        const std::size_t k = 4 * i + j;
        const int node = rail_side.profile.node(over.ordinal[j]);
        const int station = along.ordinal[i];
        point.rail.slot[k] = rail_side.slot(node, station);
        const double weight = along.value[i] * over.value[j];
        x += weight * u.at(point.rail.slot[k]);
        if (!exact) depth += weight * depths.rail(line.stations[station], rail_side.p[node]);
      }
    point.rail.along = along.value;
    point.rail.across = over.value;
    x.z -= depth;
    point.position = x;
    point.face = face;
    const std::array<double, 2> by_station = nearer_end(at_along);
    const std::array<double, 2> by_row = nearer_end(at_across);
    point.face_share = {by_station[0] * by_row[0], by_station[0] * by_row[1], by_station[1] * by_row[0],
                        by_station[1] * by_row[1]};
    point.area = share * cell.length * std::hypot(profile.dp, profile.dq);
  }

  /// Sets the wheel's nodes, weights, angles, normal and gap at the wheel's point that is closest to the
  /// placed rail point. Returns the gap [m], or the largest number beyond the wheel's surface. A gap above
  /// `far` [m] is rough.
  template <class State>
  TREAD_BODY double find_gap(const State& state, double far, ContactPoint& point) const {
    constexpr int kMaxIterations = 6;
    constexpr double kNone = std::numeric_limits<double>::max();
    const ProfileView& profile = wheel_side.profile;
    const Vec3 d = point.position - state.wheel->origin;
    double phi = std::atan2(-d.x, -d.z);
    int edge = profile.edge_at(d.y);
    double eta = parameter(edge, d.y);
    for (int iteration = 1;; ++iteration) {
      if (!(eta >= -0.5 && eta <= 1.5)) return kNone;  // beyond the wheel's surface
      const StationLine::Cell cell = wheel_side.stations.find(phi - state.wheel->angle);
      if (cell.station < 0) return kNone;  // beyond a part of a ring
      const ProfileView::Point p = profile.evaluate(edge, eta, kind);
      const WheelSurface surface = wheel_surface(state, {cell, edge, eta, p}, point);

      const Vec3 e = cartesian_to_cylindrical(phi, d) - surface.point;
      const double shift = (e.y * p.dp + e.z * p.dq) / (p.dp * p.dp + p.dq * p.dq);
      const Vec3 along =
          kind == SurfaceKind::exact ? Vec3{1, 0, 0} + (1 / (p.q * cell.pitch)) * surface.side : surface.side;
      const Vec3 normal = cross(along, surface.across);
      const double size = norm(normal);
      const double gap = dot(e, normal) / size;
      point.normal = cylindrical_to_cartesian(phi, (1 / size) * normal);
      const bool found = std::abs(e.x) < 1e-9 && std::abs(shift) < 1e-7;
      if (found || gap > far || iteration == kMaxIterations) {
        point.gap = gap;
        return gap;
      }
      phi += e.x / p.q;
      eta += shift;
      if (eta < 0 || eta > 1) {
        const double target = p.p + shift * p.dp;
        edge = profile.edge_at(target);
        eta = parameter(edge, target);
      }
    }
  }

 private:
  /// A place on the wheel's undeformed surface.
  struct WheelPlace {
    StationLine::Cell cell;
    int edge;
    double eta;
    ProfileView::Point profile;
  };

  /// Point and tangents of the wheel's deformed surface, in the cylindrical basis at the place.
  struct WheelSurface {
    Vec3 point;   ///< [m]
    Vec3 side;    ///< derivative by the cell's fraction [m]; of the displacement alone where it is exact
    Vec3 across;  ///< derivative by eta [m]
  };

  TREAD_BODY double parameter(int edge, double p) const {
    const ProfileView& profile = wheel_side.profile;
    return (p - profile.edge_p(edge, 0)) / (profile.edge_p(edge, 1) - profile.edge_p(edge, 0));
  }

  /// Displacement of a wheel's node; for facets its place, too.
  template <class State>
  TREAD_BODY Vec3 nodal(const State& state, int node, int station, std::int64_t slot) const {
    Vec3 value = state.displacement.at(slot);
    if (kind == SurfaceKind::exact) return value;
    const double across = wheel_side.p[node];
    value += {0, across, wheel_side.q[node]};
    if (!depths.wheel_depth.smooth())
      value.z -= depths.wheel_depth.around(wheel_side.stations.stations[station], across).depth;
    return value;
  }

  /// Sets the point's nodes, weights and angles of the wheel too.
  template <class State>
  TREAD_BODY WheelSurface wheel_surface(const State& state, const WheelPlace& at, ContactPoint& point) const {
    const bool exact = kind == SurfaceKind::exact;
    const StationLine& stations = wheel_side.stations;
    const StationLine::Cell& cell = at.cell;
    const ProfileView::Point& p = at.profile;
    const LineCell line = station_cell(stations, cell.station);
    const LineWeights around = line_weights(line, cell.distance / cell.pitch, kind);
    const LineWeights over = line_weights(wheel_side.profile.cell(at.edge), at.eta, kind_across);
    const std::array<double, 4> turned = {cell.distance + line.length_before, cell.distance,
                                          cell.distance - cell.pitch,
                                          cell.distance - cell.pitch - line.length_after};
    WheelSurface out{};
    if (exact) {
      out.point = {0, p.p, p.q};
      out.across = {0, p.dp, p.dq};
    }
    if (exact && !depths.wheel_depth.smooth()) {
      const double angle = stations.stations[cell.station] + cell.distance;
      const SurfaceDepth depth = depths.wheel_depth.around(angle, p.p);
      out.point.z -= depth.depth;
      out.side.z += depth.along * depths.wheel_depth.radius * cell.pitch;
      out.across.z -= depth.across * p.dp;
    }
    for (std::size_t i = 0; i < 4; ++i) {
      Vec3 value;
      Vec3 slope;
      for (std::size_t j = 0; j < 4; ++j) {
        const int node = wheel_side.profile.node(over.ordinal[j]);
        const std::size_t k = 4 * i + j;
        point.wheel.slot[k] = wheel_side.slot(node, around.ordinal[i]);
        const Vec3 at_node = nodal(state, node, around.ordinal[i], point.wheel.slot[k]);
        value += over.value[j] * at_node;
        slope += over.slope[j] * at_node;
      }
      value = turn(value, -turned[i]);
      out.point += around.value[i] * value;
      out.side += around.slope[i] * value;
      out.across += around.value[i] * turn(slope, -turned[i]);
      // The stations' angles do not depend on phi, so that all points of a station have the same bits.
      point.wheel_angle[i] = state.wheel->angle + stations.stations[around.ordinal[i]];
    }
    point.wheel.along = around.value;
    point.wheel.across = over.value;
    return out;
  }
};

/// Sets the point's tangents and the bases of the wheel's nodes about it.
TREAD_BODY void set_bases(ContactPoint& point) {
  for (std::size_t i = 0; i < 4; ++i) {
    point.wheel_cosine[i] = std::cos(point.wheel_angle[i]);
    point.wheel_sine[i] = std::sin(point.wheel_angle[i]);
  }
  const Vec3 ahead{1, 0, 0};
  const Vec3 along = ahead - dot(ahead, point.normal) * point.normal;
  point.along = (1 / norm(along)) * along;
  point.across = cross(point.along, point.normal);
}

}  // namespace tread
