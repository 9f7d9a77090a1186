#include "kernels/contact/patch_solver.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <variant>

#include "core/parallel/parallel.hpp"
#include "kernels/lanes/tile_force.hpp"

namespace tread {

namespace {

constexpr int kMaxIterations = 300;
constexpr double kTolerance = 3e-7;  ///< last change of a traction / largest pressure
/// Growth of a traction's change from which on the compliances are taken as too small.
constexpr double kDivergence = 100;
/// Change of a closing speed in a step that no contact reaches: that of a pressure that jumps by 0.2 GPa
/// [m/s].
constexpr double kSpare = 5;
/// Points from which on threads share the work: below, waiting for one another takes longer.
constexpr std::size_t kWorthSharing = 2048;
static_assert(kLinkedNodes == 2 * kSupport);

/// Calls body(i) for i below n, by all threads if the patch has points enough.
template <class Body>
void share(std::size_t points, std::size_t n, const Body& body) {
  const auto run = [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i) body(static_cast<std::size_t>(i));
  };
  if (points < kWorthSharing)
    run(0, static_cast<std::int64_t>(n));
  else
    parallel_ranges(static_cast<std::int64_t>(n), run);
}

PatchVector padded(const Vec3& v) {
  return {{v.x, v.y, v.z, 0}};
}
Vec3 vector(const PatchVector& v) {
  return {v.value[0], v.value[1], v.value[2]};
}

Traction slip_of(const ContactPoint& point, const Vec3& velocity) {
  return {dot(velocity, point.along), dot(velocity, point.across)};
}

/// Velocity of the wheel against the rail at a point without contact. [m/s]
Vec3 free_velocity(const ContactPoint& point, const BodyFrame& wheel, const NodeMotion& motion) {
  Vec3 free =
      wheel.velocity + cross({0, wheel.spin, 0}, point.position - point.gap * point.normal - wheel.origin);
  for (std::size_t k = 0; k < kSupport; ++k) {
    free += point.wheel_weight[k] * globalise(point.wheel_cosine[k / 4], point.wheel_sine[k / 4],
                                              motion.velocity.at(point.wheel_slot[k]));
    free -= point.rail_weight[k] * motion.velocity.at(point.rail_slot[k]);
  }
  return free;
}

/// Removes points that were apart and stay so unless they close by more than kSpare faster than in the step
/// before. The search may find more or fewer of them, which the bits do not show.
void remove_open(std::vector<ContactPoint>& points, double dt) {
  std::erase_if(points, [&](const ContactPoint& point) {
    const double closing = dot(point.velocity_before, point.normal) + kSpare;
    return point.pressure_before <= 0 && point.gap >= 0.5 * dt * closing;
  });
}

}  // namespace

PatchSolver::PatchSolver() : lanes_(tile_forces().front()) {}

void PatchSolver::reserve(std::int64_t slots, std::size_t points, std::size_t nodes) {
  node_of_.assign(static_cast<std::size_t>(slots), -1);
  tiles_.reserve(points / kLanes + 1);
  free_.reserve(points);
  impulse_.reserve(points);
  nodes_.reserve(nodes);
  change_.reserve(nodes);
  first_point_.reserve(nodes + 2);
  for (auto* numbers : {&node_, &point_}) numbers->reserve(points * kLinkedNodes);
  for (auto* weights : {&node_weight_, &point_weight_}) weights->reserve(points * kLinkedNodes);
}

void PatchSolver::link(const std::vector<ContactPoint>& points, const BodyFrame& wheel,
                       const NodeMotion& motion) {
  nodes_.clear();
  free_.resize(points.size());
  node_.resize(points.size() * kLinkedNodes);
  node_weight_.resize(node_.size());
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
    const auto tie = [&](std::size_t k, double weight, const Node& node) {
      const int n = number(node);
      node_[i * kLinkedNodes + k] = n;
      node_weight_[i * kLinkedNodes + k] = weight * nodes_[static_cast<std::size_t>(n)].mobility;
    };
    for (std::size_t k = 0; k < kSupport; ++k) {
      tie(k, point.wheel_weight[k],
          {point.wheel_slot[k], true, point.wheel_cosine[k / 4], point.wheel_sine[k / 4], 0});
      tie(kSupport + k, -point.rail_weight[k], {point.rail_slot[k], false, 1, 0, 0});
    }
    free_[i] = padded(free_velocity(point, wheel, motion));
  }
  impulse_.resize(points.size());
  change_.resize(nodes_.size());
  list_points_of_nodes();
}

void PatchSolver::list_points_of_nodes() {
  first_point_.assign(nodes_.size() + 2, 0);
  for (const int node : node_) ++first_point_[static_cast<std::size_t>(node) + 2];
  for (std::size_t n = 2; n < first_point_.size(); ++n) first_point_[n] += first_point_[n - 1];
  point_.resize(node_.size());
  point_weight_.resize(node_.size());
  for (std::size_t term = 0; term < node_.size(); ++term) {
    const auto place = static_cast<std::size_t>(first_point_[static_cast<std::size_t>(node_[term]) + 1]++);
    point_[place] = static_cast<int>(term / kLinkedNodes);
    point_weight_[place] = node_weight_[term];
  }
}

void PatchSolver::fill_tiles(const std::vector<ContactPoint>& points, double dt) {
  tiles_.assign((points.size() + kLanes - 1) / kLanes, {});
  for (std::size_t i = 0; i < points.size(); ++i) {
    const ContactPoint& point = points[i];
    PointTile& tile = tiles_[i / kLanes];
    const std::size_t lane = i % kLanes;
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
}

PatchTerms PatchSolver::nodes_of(std::size_t point) const {
  return {node_.data() + point * kLinkedNodes, node_weight_.data() + point * kLinkedNodes};
}

void PatchSolver::sum_impulses() {
  share(impulse_.size(), nodes_.size(), [&](std::size_t n) {
    const int first = first_point_[n];
    change_[n] = lanes_->patch_sum({point_.data() + first, point_weight_.data() + first},
                                   first_point_[n + 1] - first, impulse_.data(), {});
  });
}

/// The coefficients of the step, from the sliding in the step before. A point starts to slide in its first
/// step in contact.
template <class Law>
void PatchSolver::advance(const std::vector<ContactPoint>& points, FrictionOf<Law>& friction, double dt) {
  typename Law::State none{};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const ContactPoint& point = points[i];
    PointTile& tile = tiles_[i / kLanes];
    const std::size_t lane = i % kLanes;
    Traction slip;
    if (point.pressure_before > 0) slip = {tile.slip_before[0][lane], tile.slip_before[1][lane]};
    const Sliding sliding{slip, point.position.x, point.position.y, dt};
    if constexpr (FrictionOf<Law>::kHasState)
      tile.friction[lane] =
          friction.law.advance(friction.state[static_cast<std::size_t>(point.history)], sliding);
    else
      tile.friction[lane] = friction.law.advance(none, sliding);
  }
}

/// Sets the compliances to half of the way in a step by which unit tractions of all points together part the
/// surfaces at each, but not less than by the point's own: sums of the rows of a matrix with few negative
/// entries, whose largest eigenvalue they bound.
void PatchSolver::set_compliances(const std::vector<ContactPoint>& points, double dt) {
  for (std::size_t i = 0; i < points.size(); ++i) impulse_[i] = {{0.5 * dt * dt * points[i].area, 0, 0, 0}};
  sum_impulses();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const PatchTerms terms = nodes_of(i);
    double own = 0;
    for (int k = 0; k < kLinkedNodes; ++k) own += terms.weight[k] * terms.weight[k];
    const double all = lanes_->patch_sum(terms, kLinkedNodes, change_.data(), {}).value[0];
    tiles_[i / kLanes].compliance[i % kLanes] = std::max(0.5 * dt * dt * points[i].area * own, all);
  }
}

/// Sets the tractions that the points would have if the surfaces went on as in the step before.
void PatchSolver::guess(const std::vector<ContactPoint>& points, const PointSprings& springs, double dt) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const ContactPoint& point = points[i];
    PointTile& tile = tiles_[i / kLanes];
    const std::size_t lane = i % kLanes;
    const Traction slip{tile.slip_before[0][lane], tile.slip_before[1][lane]};
    const PointTraction<double> traction =
        tread::respond<double>({point.gap, slip, point.shear_before, tile.friction[lane], 0}, springs, dt,
                               {dot(point.velocity_before, point.normal), slip}, {});
    const double values[3] = {traction.pressure, traction.shear.along, traction.shear.across};
    for (int c = 0; c < 3; ++c) tile.held[c][lane] = tile.response[c][lane] = values[c];
    impulse_[i] = padded(-dt * point.area *
                         (values[0] * point.normal + values[1] * point.along + values[2] * point.across));
  }
}

PatchSolver::Progress PatchSolver::respond(std::size_t points, const PointIteration& iteration) {
  share(points, tiles_.size(), [&](std::size_t t) {
    const std::size_t first = t * kLanes;
    lanes_->patch_respond(tiles_[t], static_cast<int>(std::min<std::size_t>(kLanes, points - first)),
                          iteration, nodes_of(first), change_.data(), free_.data() + first,
                          impulse_.data() + first);
  });
  double change[kLanes] = {};
  double largest[kLanes] = {};
  for (const PointTile& tile : tiles_)
    for (int l = 0; l < kLanes; ++l) {
      change[l] = std::max(change[l], tile.change[l]);
      largest[l] = std::max(largest[l], tile.response[0][l]);
    }
  return {std::sqrt(*std::max_element(change, change + kLanes)),
          *std::max_element(largest, largest + kLanes)};
}

void PatchSolver::iterate(const std::vector<ContactPoint>& points, const PointSprings& springs, double dt) {
  double momentum = 0;
  const auto begin = [&] {
    double largest = 0;
    for (const PointTile& tile : tiles_)
      for (const double compliance : tile.compliance) largest = std::max(largest, compliance);
    const double q = 1 / std::sqrt(1 + springs.penalty * largest);
    momentum = (1 - q) / (1 + q);
    guess(points, springs, dt);
  };
  begin();
  double first = 0;
  for (iterations_ = 1; iterations_ <= kMaxIterations; ++iterations_) {
    sum_impulses();
    const Progress progress = respond(points.size(), {springs, dt, iterations_ > 1 ? momentum : 0});
    if (progress.change <= kTolerance * progress.largest) break;
    if (iterations_ == 1) first = progress.change;
    if (progress.change > kDivergence * first) {
      for (PointTile& tile : tiles_)
        for (double& compliance : tile.compliance) compliance *= 2;
      begin();
    }
  }
}

void PatchSolver::settle(std::vector<ContactPoint>& points, double dt) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    ContactPoint& point = points[i];
    const PointTile& tile = tiles_[i / kLanes];
    const std::size_t lane = i % kLanes;
    point.pressure = tile.response[0][lane];
    point.shear = {tile.response[1][lane], tile.response[2][lane]};
    const double size = std::hypot(point.shear.along, point.shear.across);
    const double limit = tile.friction[lane] * point.pressure;
    point.slips = tile.friction[lane] == 0 || (size > 0 && size >= kSlipping * limit);
    impulse_[i] = padded(-dt * point.area * point.traction());
  }
  sum_impulses();
}

/// Sets closing and slip speed at the start of the step: means of the steps before and after.
void PatchSolver::set_speeds(std::vector<ContactPoint>& points) const {
  for (std::size_t i = 0; i < points.size(); ++i) {
    ContactPoint& point = points[i];
    const Vec3 after = vector(lanes_->patch_sum(nodes_of(i), kLinkedNodes, change_.data(), free_[i]));
    const Vec3 mean = 0.5 * (point.velocity_before + after);
    point.closing_speed = dot(mean, point.normal);
    point.slip_speed = slip_of(point, mean);
  }
}

void PatchSolver::solve(std::vector<ContactPoint>& points, const PointSprings& springs, Friction& friction,
                        const BodyFrame& wheel, const NodeMotion& motion, double dt) {
  remove_open(points, dt);
  link(points, wheel, motion);
  fill_tiles(points, dt);
  std::visit([&](auto& of) { advance(points, of, dt); }, friction);
  set_compliances(points, dt);
  iterate(points, springs, dt);
  settle(points, dt);
  set_speeds(points);
  std::visit(
      [&](auto& of) {
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
  const std::size_t terms = node_.capacity() + point_.capacity();
  const std::size_t vectors = free_.capacity() + impulse_.capacity() + change_.capacity();
  return static_cast<std::int64_t>(node_of_.size() * sizeof(int) +
                                   nodes_.capacity() * (sizeof(Node) + sizeof(int)) +
                                   tiles_.capacity() * sizeof(PointTile) + vectors * sizeof(PatchVector) +
                                   terms * (sizeof(int) + sizeof(double)));
}

}  // namespace tread
