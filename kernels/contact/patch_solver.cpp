#include "kernels/contact/patch_solver.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <variant>

#include "kernels/lanes/tile_force.hpp"

namespace tread {

namespace {

constexpr int kMaxSweeps = 100;
constexpr double kTolerance = 1e-6;  ///< last change of a traction / largest pressure

PatchVector padded(const Vec3& v) {
  return {{v.x, v.y, v.z, 0}};
}
Vec3 vector(const PatchVector& v) {
  return {v.value[0], v.value[1], v.value[2]};
}

/// Components closing, along, across.
Vec3 in_frame(const ContactPoint& point, const Vec3& v) {
  return {dot(v, point.normal), dot(v, point.along), dot(v, point.across)};
}

/// Sets the traction that a point would have if the surfaces went on as in the step before.
void guess(ContactPoint& point, const Vec3& velocity, const PointSprings& springs, double friction,
           double dt) {
  point.pressure = std::max(0.0, springs.penalty * (0.5 * dt * velocity.x - point.gap));
  point.shear =
      springs.stick
          .advance(point.shear_before, {dt * velocity.y, dt * velocity.z}, friction * point.pressure, 0)
          .traction;
}

}  // namespace

PatchSolver::PatchSolver() : lanes_(tile_forces().front()) {}

void PatchSolver::reserve(std::int64_t slots, std::size_t points, std::size_t nodes) {
  node_of_.assign(static_cast<std::size_t>(slots), -1);
  links_.reserve(points);
  coefficient_.reserve(points);
  nodes_.reserve(nodes);
  change_.reserve(nodes);
}

void PatchSolver::link(const std::vector<ContactPoint>& points, const BodyFrame& wheel,
                       const NodeMotion& motion, double dt) {
  nodes_.clear();
  links_.resize(points.size());
  const auto number = [&](const Node& node) {
    int& known = node_of_[static_cast<std::size_t>(node.slot)];
    if (known < 0) {
      known = static_cast<int>(nodes_.size());
      nodes_.push_back(node);
      nodes_.back().mobility = std::sqrt(motion.inverse_mass[node.slot]);
    }
    return known;
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    const ContactPoint& point = points[i];
    Link& link = links_[i];
    Vec3 free =
        wheel.velocity + cross({0, wheel.spin, 0}, point.position - point.gap * point.normal - wheel.origin);
    double mobility = 0;
    const auto tie = [&](std::size_t k, double weight, const Node& node, const Vec3& velocity) {
      const int n = number(node);
      const double share = weight * nodes_[static_cast<std::size_t>(n)].mobility;
      link.nodes.node[k] = n;
      link.nodes.weight[k] = share;
      mobility += share * share;
      free += weight * velocity;
    };
    for (std::size_t k = 0; k < kSupport; ++k) {
      const double c = point.wheel_cosine[k / 4];
      const double s = point.wheel_sine[k / 4];
      tie(k, point.wheel_weight[k], {point.wheel_slot[k], true, c, s, 0},
          globalise(c, s, motion.velocity.at(point.wheel_slot[k])));
      tie(kSupport + k, -point.rail_weight[k], {point.rail_slot[k], false, 1, 0, 0},
          motion.velocity.at(point.rail_slot[k]));
    }
    link.free = padded(free);
    link.before = in_frame(point, point.velocity_before);
    link.compliance = 0.5 * dt * dt * point.area * mobility;
  }
  change_.assign(nodes_.size(), {});
}

void PatchSolver::push(const Link& link, const Vec3& impulse) {
  lanes_->patch_give(link.nodes, -impulse, change_.data());
}

Vec3 PatchSolver::relative_velocity(const ContactPoint& point, const Link& link) const {
  return in_frame(point, lanes_->patch_take(link.nodes, change_.data(), link.free));
}

template <bool rubs, class Law>
PatchSolver::Sweep PatchSolver::sweep(std::vector<ContactPoint>& points, const Coefficients<Law>& friction,
                                      const Step& step) {
  const double dt = step.dt;
  const double penalty = step.springs.penalty;
  double change = 0;
  double largest = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    ContactPoint& point = points[i];
    const Link& link = links_[i];
    const double compliance = link.compliance;
    const Vec3 velocity = relative_velocity(point, link);
    const Vec3 mean = 0.5 * (link.before + velocity);
    const Vec3 before{point.pressure, point.shear.along, point.shear.across};
    point.closing_speed = mean.x;
    // Gap in the middle of the step if the point's own pressure were zero.
    const double gap = point.gap - 0.5 * dt * velocity.x - compliance * point.pressure;
    point.pressure = std::max(0.0, -penalty * gap / (1 + penalty * compliance));
    if constexpr (rubs) {
      point.slip_speed = {mean.y, mean.z};
      // Slip between both middles if the point's own shear were zero.
      const Traction slip{dt * mean.y + compliance * point.shear.along,
                          dt * mean.z + compliance * point.shear.across};
      const auto stick =
          step.springs.stick.advance(point.shear_before, slip, friction[i] * point.pressure, compliance);
      point.shear = stick.traction;
      point.slips = stick.slips;
    }
    const Vec3 by = Vec3{point.pressure, point.shear.along, point.shear.across} - before;
    const double square = dot(by, by);
    if (square > 0)  // else it stays out of contact
      push(link, dt * point.area * (by.x * point.normal + by.y * point.along + by.z * point.across));
    change = std::max(change, square);
    largest = std::max(largest, point.pressure);
  }
  return {std::sqrt(change), largest};
}

void PatchSolver::slip_freely(std::vector<ContactPoint>& points) const {
  for (std::size_t i = 0; i < points.size(); ++i) {
    ContactPoint& point = points[i];
    const Vec3 mean = 0.5 * (links_[i].before + relative_velocity(point, links_[i]));
    point.slip_speed = {mean.y, mean.z};
    point.shear = {};
    point.slips = true;
  }
}

/// The coefficients of the step, from the sliding in the step before. A point starts to slide in its first
/// step in contact.
template <class Law>
PatchSolver::Coefficients<Law> PatchSolver::advance(const std::vector<ContactPoint>& points,
                                                    FrictionOf<Law>& friction, double dt) {
  typename Law::State none{};
  if constexpr (Law::kUniform) {
    return {friction.law.advance(none, {}), nullptr};
  } else {
    coefficient_.resize(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      const ContactPoint& point = points[i];
      const Vec3 before = point.pressure_before > 0 ? links_[i].before : Vec3{};
      const Sliding sliding{{before.y, before.z}, point.position.x, point.position.y, dt};
      if constexpr (FrictionOf<Law>::kHasState)
        coefficient_[i] =
            friction.law.advance(friction.state[static_cast<std::size_t>(point.history)], sliding);
      else
        coefficient_[i] = friction.law.advance(none, sliding);
    }
    return {0, coefficient_.data()};
  }
}

/// Gauss and Seidel: each point in turn finds the traction that fits the motion which the others leave it.
template <class Law>
void PatchSolver::solve_with(std::vector<ContactPoint>& points, const Coefficients<Law>& friction, bool rubs,
                             const Step& step) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    guess(points[i], links_[i].before, step.springs, friction[i], step.dt);
    push(links_[i], step.dt * points[i].area * points[i].traction());
  }
  for (int sweeps = 0; sweeps < kMaxSweeps; ++sweeps) {
    const Sweep last = rubs ? sweep<true>(points, friction, step) : sweep<false>(points, friction, step);
    if (last.change <= kTolerance * last.largest) break;
  }
  if (!rubs) slip_freely(points);
}

void PatchSolver::solve(std::vector<ContactPoint>& points, const PointSprings& springs, Friction& friction,
                        const BodyFrame& wheel, const NodeMotion& motion, double dt) {
  link(points, wheel, motion, dt);
  std::visit(
      [&](auto& of) {
        solve_with(points, advance(points, of, dt), !of.law.frictionless(), {springs, dt});
        if constexpr (std::decay_t<decltype(of)>::kHasState)
          for (const ContactPoint& point : points)
            if (point.pressure <= 0) of.state[static_cast<std::size_t>(point.history)] = {};
      },
      friction);
  write_back(motion, wheel.spin, dt);
}

void PatchSolver::write_back(const NodeMotion& motion, double spin, double dt) {
  // In the spinning frame half of an impulse acts before the turn of the relative velocity, half after it.
  const double cosine = 0.5 * (1 + std::cos(2 * spin * dt));
  const double sine = 0.5 * std::sin(2 * spin * dt);
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const Node& node = nodes_[i];
    node_of_[static_cast<std::size_t>(node.slot)] = -1;
    Vec3 change = node.mobility * vector(change_[i]);
    if (node.of_wheel) {
      change = localise(node.cosine, node.sine, change);
      change = {cosine * change.x - sine * change.z, change.y, sine * change.x + cosine * change.z};
    }
    motion.velocity.add(node.slot, change);
    motion.displacement.add(node.slot, dt * change);
  }
}

std::int64_t PatchSolver::bytes() const {
  return static_cast<std::int64_t>(
      node_of_.size() * sizeof(int) + nodes_.capacity() * (sizeof(Node) + sizeof(PatchVector)) +
      links_.capacity() * sizeof(Link) + coefficient_.capacity() * sizeof(double));
}

}  // namespace tread
