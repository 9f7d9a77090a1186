#include "kernels/contact/surface_pair.hpp"

#include <cmath>
#include <limits>
#include <utility>

namespace tread {

namespace {

/// Shares of both ends of a line in a point at `at` in [0, 1]: the nearer end takes the point.
std::array<double, 2> nearer_end(double at) {
  if (std::abs(at - 0.5) < 1e-9) return {0.5, 0.5};
  return at < 0.5 ? std::array{1.0, 0.0} : std::array{0.0, 1.0};
}

}  // namespace

/// A place on the wheel's undeformed surface.
struct SurfacePair::WheelPlace {
  StationFinder::Cell cell;
  int edge;
  double eta;
  SurfaceProfile::Point profile;
};

/// Point and tangents of the wheel's deformed surface, in the cylindrical basis at the place.
struct SurfacePair::WheelSurface {
  Vec3 point;   ///< [m]
  Vec3 side;    ///< derivative by the cell's fraction [m]; of the displacement alone where it is exact
  Vec3 across;  ///< derivative by eta [m]
};

SurfacePair::SurfacePair(const SweptBlock& rail, const SweptBlock& wheel, SurfaceKind kind,
                         RunningSurface rail_depth, RunningSurface wheel_depth)
    : rail_(&rail),
      wheel_(&wheel),
      kind_(kind),
      rail_depth_(std::move(rail_depth)),
      wheel_depth_(std::move(wheel_depth)),
      rail_profile_(rail.section),
      wheel_profile_(wheel.section),
      rail_stations_(rail),
      wheel_stations_(wheel) {}

void SurfacePair::place(const ContactState& state, std::array<int, 2> face, const FaceQuadrature::Point& at,
                        ContactPoint& point) const {
  const auto [face_station, edge] = face;
  const ConstNodeField u = state.displacement;
  const bool exact = kind_ == SurfaceKind::exact;
  const auto profile = rail_profile_.evaluate(edge, at.across, kind_);
  const LineCell cell = station_cell(*rail_, face_station);
  const LineWeights along = line_weights(cell, at.along, kind_);
  const LineWeights across = line_weights(rail_profile_.cell(edge), at.across, kind_);
  Vec3 x{rail_->stations[static_cast<std::size_t>(face_station)] + at.along * cell.length, profile.p,
         profile.q};
  double depth = exact ? depth_at(x.x, x.y) : 0.0;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) {
      const std::size_t k = 4 * i + j;
      const int node = rail_profile_.node(across.ordinal[j]);
      const int station = along.ordinal[i];
      point.rail.slot[k] = rail_->base + rail_->slot(node, station);
      const double weight = along.value[i] * across.value[j];
      x += weight * u.at(point.rail.slot[k]);
      if (!exact)
        depth += weight * depth_at(rail_->stations[static_cast<std::size_t>(station)],
                                   rail_->section.p[static_cast<std::size_t>(node)]);
    }
  point.rail.along = along.value;
  point.rail.across = across.value;
  x.z -= depth;
  point.position = x;
  point.face = face;
  const auto [here, ahead] = nearer_end(at.along);
  const auto [left, right] = nearer_end(at.across);
  point.face_share = {here * left, here * right, ahead * left, ahead * right};
  point.area = at.weight * cell.length * std::hypot(profile.dp, profile.dq);
}

/// Sets the point's nodes, weights and angles of the wheel too.
SurfacePair::WheelSurface SurfacePair::wheel_surface(const ContactState& state, const WheelPlace& at,
                                                     ContactPoint& point) const {
  const bool exact = kind_ == SurfaceKind::exact;
  const ConstNodeField u = state.displacement;
  const auto& cell = at.cell;
  const auto& p = at.profile;
  const LineCell line = station_cell(*wheel_, cell.station);
  const LineWeights around = line_weights(line, cell.distance / cell.pitch, kind_);
  const LineWeights over = line_weights(wheel_profile_.cell(at.edge), at.eta, kind_);
  const std::array<double, 4> turned = {cell.distance + line.length_before, cell.distance,
                                        cell.distance - cell.pitch,
                                        cell.distance - cell.pitch - line.length_after};
  WheelSurface out{exact ? Vec3{0, p.p, p.q} : Vec3{}, {}, exact ? Vec3{0, p.dp, p.dq} : Vec3{}};
  if (exact && !wheel_depth_.smooth()) {
    const double angle = wheel_->stations[static_cast<std::size_t>(cell.station)] + cell.distance;
    const SurfaceDepth depth = wheel_depth_.around(angle, p.p);
    out.point.z -= depth.depth;
    out.side.z += depth.along * wheel_depth_.radius() * cell.pitch;
    out.across.z -= depth.across * p.dp;
  }
  for (std::size_t i = 0; i < 4; ++i) {
    Vec3 value;
    Vec3 slope;
    for (std::size_t j = 0; j < 4; ++j) {
      const int node = wheel_profile_.node(over.ordinal[j]);
      const std::size_t k = 4 * i + j;
      point.wheel.slot[k] = wheel_->base + wheel_->slot(node, around.ordinal[i]);
      Vec3 nodal = u.at(point.wheel.slot[k]);
      if (!exact) {
        const double across = wheel_->section.p[static_cast<std::size_t>(node)];
        nodal += {0, across, wheel_->section.q[static_cast<std::size_t>(node)]};
        if (!wheel_depth_.smooth())
          nodal.z -=
              wheel_depth_.around(wheel_->stations[static_cast<std::size_t>(around.ordinal[i])], across)
                  .depth;
      }
      value += over.value[j] * nodal;
      slope += over.slope[j] * nodal;
    }
    value = turn(value, -turned[i]);
    out.point += around.value[i] * value;
    out.side += around.slope[i] * value;
    out.across += around.value[i] * turn(slope, -turned[i]);
    // The stations' angles do not depend on phi, so that all points of a station have the same bits.
    point.wheel_angle[i] = state.wheel->angle + wheel_->stations[static_cast<std::size_t>(around.ordinal[i])];
  }
  point.wheel.along = around.value;
  point.wheel.across = over.value;
  return out;
}

double SurfacePair::find_gap(const ContactState& state, double far, ContactPoint& point) const {
  constexpr int kMaxIterations = 6;
  constexpr double kNone = std::numeric_limits<double>::max();
  const Vec3 d = point.position - state.wheel->origin;
  double phi = std::atan2(-d.x, -d.z);
  int edge = wheel_profile_.edge_at(d.y);
  const auto parameter = [&](double p) {
    return (p - wheel_profile_.edge_p(edge, 0)) /
           (wheel_profile_.edge_p(edge, 1) - wheel_profile_.edge_p(edge, 0));
  };
  double eta = parameter(d.y);
  for (int iteration = 1;; ++iteration) {
    if (!(eta >= -0.5 && eta <= 1.5)) return kNone;  // beyond the wheel's surface
    const auto cell = wheel_stations_.find(phi - state.wheel->angle);
    if (cell.station < 0) return kNone;  // beyond a part of a ring
    const auto p = wheel_profile_.evaluate(edge, eta, kind_);
    const WheelSurface surface = wheel_surface(state, {cell, edge, eta, p}, point);

    const Vec3 e = cartesian_to_cylindrical(phi, d) - surface.point;
    const double shift = (e.y * p.dp + e.z * p.dq) / (p.dp * p.dp + p.dq * p.dq);
    const Vec3 along =
        kind_ == SurfaceKind::exact ? Vec3{1, 0, 0} + (1 / (p.q * cell.pitch)) * surface.side : surface.side;
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
      edge = wheel_profile_.edge_at(target);
      eta = parameter(target);
    }
  }
}

}  // namespace tread
