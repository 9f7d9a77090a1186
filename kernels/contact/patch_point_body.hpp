#pragma once
// Values of a contact point in the solution of a step, for one index; on a device too. [theory.md, Contact]

#include <cmath>
#include <cstddef>

#include "core/body_frame.hpp"
#include "kernels/contact/contact_point.hpp"
#include "kernels/contact/friction/friction_law.hpp"
#include "kernels/lanes/patch_loop.hpp"

namespace tread {

/// Change of a closing speed in a step that no contact reaches: that of a pressure that jumps by 0.2 GPa
/// [m/s].
inline constexpr double kSpareClosing = 5;
/// Iterations with momentum, with which limits of the tractions may make them go round: three times as many
/// as the penalty by default needs. As many without momentum as end that follow, then others with it.
inline constexpr int kWithMomentum = 60;
inline constexpr int kWithoutMomentum = 20;
inline constexpr int kMostIterations = 8 * (kWithMomentum + kWithoutMomentum);  ///< the last are without it
inline constexpr double kTractionTolerance = 3e-7;  ///< last change of a traction / largest pressure
/// The same, where the iterations end without it, from which on a step counts as not solved.
inline constexpr double kUnsettled = 1e-4;
/// Growth of a traction's change from which on the compliances are taken as too small.
inline constexpr double kDivergence = 100;

TREAD_BODY PatchVector padded(const Vec3& v) {
  return {{v.x, v.y, v.z, 0}};
}
TREAD_BODY Vec3 vector_of(const PatchVector& v) {
  return {v.value[0], v.value[1], v.value[2]};
}
TREAD_BODY Traction slip_of(const ContactPoint& point, const Vec3& velocity) {
  return {dot(velocity, point.along), dot(velocity, point.across)};
}

/// Iterations by Polyak's heavy ball. [theory.md, eq. 9b']
class HeavyBall {
 public:
  /// By the largest compliance [m/Pa].
  TREAD_BODY HeavyBall(const PointSprings& springs, double compliance) {
    const double q = 1 / std::sqrt(1 + springs.penalty * compliance);
    const double b = (1 - q) / (1 + q);
    weight_ = (1 + b) * (1 + b);
    momentum_ = b * b;
  }
  /// The next iteration of a step of length dt [s].
  TREAD_BODY PointIteration next(const PointSprings& springs, double dt) {
    const int turn = taken_++ % (kWithMomentum + kWithoutMomentum);
    if (turn == 0) return {springs, dt, weight_ / (1 + momentum_), 0};
    if (turn >= kWithMomentum) return {springs, dt, 1, 0};
    return {springs, dt, weight_, momentum_};
  }

 private:
  double weight_, momentum_;
  int taken_ = 0;
};

/// A point in its tile.
struct PointLane {
  PointTile& tile;
  std::size_t lane;

  TREAD_BODY static PointLane of(PointTile* tiles, std::size_t point) {
    return {tiles[point / kLanes], point % kLanes};
  }

  /// Sets the constants of a step but friction and compliance.
  TREAD_BODY void fill(const ContactPoint& point, double dt) const {
    for (int c = 0; c < 3; ++c) {
      tile.normal[c][lane] = point.normal[c];
      tile.along[c][lane] = point.along[c];
      tile.across[c][lane] = point.across[c];
    }
    tile.impulse[lane] = dt * point.area;
    tile.gap[lane] = point.gap;
    const Traction before = slip_of(point, point.velocity_before);
    tile.slip_before[0][lane] = before.along;
    tile.slip_before[1][lane] = before.across;
    tile.shear_before[0][lane] = point.shear_before.along;
    tile.shear_before[1][lane] = point.shear_before.across;
  }

  /// Sets the coefficient of friction from the sliding in the step before, and moves the law's state on. A
  /// point starts to slide in its first step in contact.
  template <class Law>
  TREAD_BODY void rub(const ContactPoint& point, const Law& law, typename Law::State& state,
                      double dt) const {
    Traction slip;
    if (point.pressure_before > 0) slip = {tile.slip_before[0][lane], tile.slip_before[1][lane]};
    tile.friction[lane] = law.advance(state, Sliding{slip, point.position.x, point.position.y, dt});
  }

  /// Sets the traction that the point would have if the surfaces went on as in the step before. Returns its
  /// impulse on the wheel [N s].
  TREAD_BODY PatchVector guess(const ContactPoint& point, const PointSprings& springs, double dt) const {
    const Traction slip{tile.slip_before[0][lane], tile.slip_before[1][lane]};
    const Traction shear{tile.shear_before[0][lane], tile.shear_before[1][lane]};
    const PointTraction<double> traction =
        respond<double>({tile.gap[lane], slip, shear, tile.friction[lane], 0}, springs, dt,
                        {dot(point.velocity_before, axis(tile.normal)), slip}, {});
    const double values[3] = {traction.pressure, traction.shear.along, traction.shear.across};
    for (int c = 0; c < 3; ++c) tile.held[c][lane] = tile.before[c][lane] = values[c];
    return impulse_of(values);
  }

  /// Sets the tractions of the point to the last response. Returns its impulse on the wheel [N s].
  TREAD_BODY PatchVector settle(ContactPoint& point) const {
    point.pressure = tile.response[0][lane];
    point.shear = {tile.response[1][lane], tile.response[2][lane]};
    const double size = std::hypot(point.shear.along, point.shear.across);
    const double limit = tile.friction[lane] * point.pressure;
    point.slips = tile.friction[lane] == 0 || (size > 0 && size >= kSlipping * limit);
    const double values[3] = {point.pressure, point.shear.along, point.shear.across};
    return impulse_of(values);
  }

 private:
  TREAD_BODY Vec3 axis(const double (&of)[3][kLanes]) const {
    return {of[0][lane], of[1][lane], of[2][lane]};
  }
  /// Impulse of tractions on the wheel [N s].
  TREAD_BODY PatchVector impulse_of(const double (&traction)[3]) const {
    return padded(-tile.impulse[lane] * (traction[0] * axis(tile.normal) + traction[1] * axis(tile.along) +
                                         traction[2] * axis(tile.across)));
  }
};

/// Velocity of the wheel against the rail by the motion of the wheel's frame alone [m/s].
TREAD_BODY Vec3 frame_velocity(const ContactPoint& point, const BodyFrame& wheel) {
  const Vec3 arm = point.position - point.gap * point.normal - wheel.origin;
  return wheel.velocity + cross({0, wheel.spin, 0}, arm);
}

/// Sets closing and slip speed at the start of the step: means of the steps before and after, in which the
/// wheel moves by `after` against the rail [m/s].
TREAD_BODY void set_speeds(ContactPoint& point, const Vec3& after) {
  const Vec3 mean = 0.5 * (point.velocity_before + after);
  point.closing_speed = dot(mean, point.normal);
  point.slip_speed = slip_of(point, mean);
}

/// Motion of a node by the change of its velocity, on the rail turned round [PatchSolver], in a step of dt
/// [s].
struct NodeKick {
  double cosine, sine;  ///< of the turn of the relative velocity, half of it
  double dt;

  /// In the spinning frame half of an impulse acts before the turn of the relative velocity, half after it.
  TREAD_BODY NodeKick(double spin, double step)
      : cosine(0.5 * (1 + std::cos(2 * spin * step))), sine(0.5 * std::sin(2 * spin * step)), dt(step) {}

  /// Change of the velocity in the node's basis; `of_wheel`, node_cosine, node_sine: of its basis.
  TREAD_BODY Vec3 local(const Vec3& change, bool of_wheel, double node_cosine, double node_sine) const {
    if (!of_wheel) return -1 * change;
    const Vec3 turned = localise(node_cosine, node_sine, change);
    return {cosine * turned.x - sine * turned.z, turned.y, sine * turned.x + cosine * turned.z};
  }
};

/// Work of friction in a step, and loss because the forces lead the motion.
struct PointWork {
  double frictional, lost;  ///< [J]
};

/// Sets the point's frictional work and its history. Returns its works.
TREAD_BODY PointWork settle_history(ContactPoint& point, PointHistory& history, const PointSprings& springs,
                                    double dt) {
  const Traction slip{dt * point.slip_speed.along, dt * point.slip_speed.across};
  point.frictional_work = springs.stick.dissipation(history.shear, point.shear, slip);
  // Work that the forces took from the bodies since the step before, less the stored and rubbed parts.
  const double work = dt * point.pressure * point.closing_speed + point.shear.along * slip.along +
                      point.shear.across * slip.across;
  const double stored =
      springs.stored(point.pressure, point.shear) - springs.stored(history.pressure, history.shear);
  history = {point.shear, point.pressure};
  return {point.area * point.frictional_work, point.area * (work - stored - point.frictional_work)};
}

}  // namespace tread
