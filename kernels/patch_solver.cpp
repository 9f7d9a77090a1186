#include "kernels/patch_solver.hpp"

#include <algorithm>
#include <cmath>

namespace tread {

namespace {

constexpr int kMaxSweeps = 100;
constexpr double kTolerance = 1e-6;  ///< last change of a traction / largest pressure

std::size_t index(int i) {
  return static_cast<std::size_t>(i);
}

/// Sets the traction that a point would have if the surfaces went on as in the step before.
void guess(ContactPoint& point, double penalty, const CoulombFriction& friction, double dt) {
  const Vec3 moved = dt * point.velocity_before;
  point.pressure = std::max(0.0, penalty * (0.5 * dot(moved, point.normal) - point.gap));
  const Traction slip{dot(moved, point.along), dot(moved, point.across)};
  point.shear = friction.advance(point.shear_before, slip, point.pressure, 0).traction;
}

}  // namespace

void PatchSolver::reserve(std::int64_t slots, std::size_t points, std::size_t nodes) {
  node_of_.assign(static_cast<std::size_t>(slots), -1);
  links_.reserve(points);
  nodes_.reserve(nodes);
  velocity_.reserve(nodes);
  inverse_mass_.reserve(nodes);
}

void PatchSolver::link(const std::vector<ContactPoint>& points, const BodyFrame& wheel,
                       const NodeMotion& motion, double dt) {
  nodes_.clear();
  velocity_.clear();
  inverse_mass_.clear();
  links_.resize(points.size());
  const auto number = [&](std::int64_t slot, bool of_wheel) {
    int& node = node_of_[static_cast<std::size_t>(slot)];
    if (node < 0) {
      node = static_cast<int>(nodes_.size());
      const Padded velocity(motion.velocity.at(slot));
      nodes_.push_back({slot, of_wheel, velocity});
      velocity_.push_back(velocity);
      inverse_mass_.push_back(motion.inverse_mass[slot]);
    }
    return node;
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    const ContactPoint& point = points[i];
    Link& link = links_[i];
    double mobility = 0;
    for (std::size_t k = 0; k < kSupport; ++k) {
      link.rail[k] = number(point.rail_slot[k], false);
      link.wheel[k] = number(point.wheel_slot[k], true);
      mobility += point.rail_weight[k] * point.rail_weight[k] * inverse_mass_[index(link.rail[k])] +
                  point.wheel_weight[k] * point.wheel_weight[k] * inverse_mass_[index(link.wheel[k])];
    }
    link.compliance = 0.5 * dt * dt * point.area * mobility;
    link.frame_velocity = Padded(
        wheel.velocity + cross({0, wheel.spin, 0}, point.position - point.gap * point.normal - wheel.origin));
  }
}

void PatchSolver::push(const ContactPoint& point, const Link& link, const Vec3& impulse) {
  const Padded on_rail(impulse);
  for (std::size_t station = 0; station < 4; ++station) {
    const Padded on_wheel(localise(point.wheel_cosine[station], point.wheel_sine[station], impulse));
    for (std::size_t k = 4 * station; k < 4 * station + 4; ++k) {
      const std::size_t rail = index(link.rail[k]);
      const std::size_t wheel = index(link.wheel[k]);
      velocity_[rail].add(point.rail_weight[k] * inverse_mass_[rail], on_rail);
      velocity_[wheel].add(-(point.wheel_weight[k] * inverse_mass_[wheel]), on_wheel);
    }
  }
}

Vec3 PatchSolver::relative_velocity(const ContactPoint& point, const Link& link) const {
  Padded relative = link.frame_velocity;
  for (std::size_t station = 0; station < 4; ++station) {
    Padded on_rail, local;
    for (std::size_t k = 4 * station; k < 4 * station + 4; ++k) {
      local.add(point.wheel_weight[k], velocity_[index(link.wheel[k])]);
      on_rail.add(-point.rail_weight[k], velocity_[index(link.rail[k])]);
    }
    on_rail.add(1, Padded(globalise(point.wheel_cosine[station], point.wheel_sine[station], local)));
    relative.add(1, on_rail);
  }
  return relative;
}

template <bool rubs>
PatchSolver::Sweep PatchSolver::sweep(std::vector<ContactPoint>& points, const Law& law) {
  const double dt = law.dt;
  Sweep sweep;
  for (std::size_t i = 0; i < points.size(); ++i) {
    ContactPoint& point = points[i];
    const double compliance = links_[i].compliance;
    const Vec3 velocity = relative_velocity(point, links_[i]);
    const Vec3 mean = 0.5 * (point.velocity_before + velocity);
    point.closing_speed = dot(mean, point.normal);
    // Gap in the middle of the step if the point's own pressure were zero.
    const double gap = point.gap - 0.5 * dt * dot(velocity, point.normal) - compliance * point.pressure;
    const double pressure = std::max(0.0, -law.penalty * gap / (1 + law.penalty * compliance));
    Vec3 by;
    if constexpr (rubs) {
      const Vec3 before = point.traction();
      point.slip_speed = {dot(mean, point.along), dot(mean, point.across)};
      // Slip between both middles if the point's own shear were zero.
      const Traction slip{dt * point.slip_speed.along + compliance * point.shear.along,
                          dt * point.slip_speed.across + compliance * point.shear.across};
      const auto stick = law.friction.advance(point.shear_before, slip, pressure, compliance);
      point.shear = stick.traction;
      point.slips = stick.slips;
      point.pressure = pressure;
      by = point.traction() - before;
    } else {
      by = pressure * point.normal - point.pressure * point.normal;
      point.pressure = pressure;
    }
    const double change = norm(by);
    if (change > 0) push(point, links_[i], dt * point.area * by);  // else it stays out of contact
    sweep.change = std::max(sweep.change, change);
    sweep.largest = std::max(sweep.largest, pressure);
  }
  return sweep;
}

void PatchSolver::slip_freely(std::vector<ContactPoint>& points) const {
  for (std::size_t i = 0; i < points.size(); ++i) {
    ContactPoint& point = points[i];
    const Vec3 mean = 0.5 * (point.velocity_before + relative_velocity(point, links_[i]));
    point.slip_speed = {dot(mean, point.along), dot(mean, point.across)};
    point.shear = {};
    point.slips = true;
  }
}

void PatchSolver::solve(std::vector<ContactPoint>& points, double penalty, const CoulombFriction& friction,
                        const BodyFrame& wheel, const NodeMotion& motion, double dt) {
  link(points, wheel, motion, dt);
  for (std::size_t i = 0; i < points.size(); ++i) {
    guess(points[i], penalty, friction, dt);
    push(points[i], links_[i], dt * points[i].area * points[i].traction());
  }

  // Gauss and Seidel: each point in turn finds the traction that fits the motion which the others leave it.
  const Law law{penalty, friction, dt};
  const bool rubs = friction.friction_coefficient > 0;
  for (int sweeps = 0; sweeps < kMaxSweeps; ++sweeps) {
    const Sweep last = rubs ? sweep<true>(points, law) : sweep<false>(points, law);
    if (last.change <= kTolerance * last.largest) break;
  }
  if (!rubs) slip_freely(points);
  write_back(motion, wheel.spin, dt);
}

void PatchSolver::write_back(const NodeMotion& motion, double spin, double dt) {
  // In the spinning frame half of an impulse acts before the turn of the relative velocity, half after it.
  const double cosine = 0.5 * (1 + std::cos(2 * spin * dt));
  const double sine = 0.5 * std::sin(2 * spin * dt);
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const Node& node = nodes_[i];
    node_of_[static_cast<std::size_t>(node.slot)] = -1;
    Vec3 change = Vec3(velocity_[i]) - Vec3(node.free);
    if (node.of_wheel)
      change = {cosine * change.x - sine * change.z, change.y, sine * change.x + cosine * change.z};
    motion.velocity.add(node.slot, change);
    motion.displacement.add(node.slot, dt * change);
  }
}

std::int64_t PatchSolver::bytes() const {
  return static_cast<std::int64_t>(node_of_.size() * sizeof(int) +
                                   nodes_.capacity() * (sizeof(Node) + sizeof(Padded) + sizeof(double)) +
                                   links_.capacity() * sizeof(Link));
}

}  // namespace tread
