#include "kernels/contact/patch_solver.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <variant>

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
PatchVector padded(const Vec3& v) {
  return {{v.x, v.y, v.z, 0}};
}
Vec3 vector(const PatchVector& v) {
  return {v.value[0], v.value[1], v.value[2]};
}

Traction slip_of(const ContactPoint& point, const Vec3& velocity) {
  return {dot(velocity, point.along), dot(velocity, point.across)};
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

PatchSolver::PatchSolver() : respond_(tile_forces().front()->patch_respond) {}

void PatchSolver::reserve(std::int64_t slots, std::size_t points, std::size_t nodes) {
  cells_.reserve(slots, points, nodes);
  tiles_.reserve(points / kLanes + 1);
  free_.reserve(points);
  impulse_.reserve(points);
  mobility_.reserve(points);
  change_.reserve(nodes);
}

void PatchSolver::set_free(const std::vector<ContactPoint>& points, const BodyFrame& wheel,
                           const NodeMotion& motion) {
  for (std::size_t n = 0; n < change_.size(); ++n) {
    const PatchCells::Node& node = cells_.nodes()[n];
    const Vec3 velocity = motion.velocity.at(node.slot);
    change_[n] = padded(node.of_wheel ? globalise(node.cosine, node.sine, velocity) : -1 * velocity);
  }
  cells_.to_points(change_);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const ContactPoint& point = points[i];
    const Vec3 arm = point.position - point.gap * point.normal - wheel.origin;
    free_[i] = padded(wheel.velocity + cross({0, wheel.spin, 0}, arm) + cells_.sum(i));
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

void PatchSolver::sum_impulses() {
  cells_.to_nodes(impulse_, change_);
  cells_.to_points(change_);
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
  cells_.own_mobility(mobility_);
  for (std::size_t i = 0; i < points.size(); ++i)
    tiles_[i / kLanes].compliance[i % kLanes] =
        std::max(0.5 * dt * dt * points[i].area * mobility_[i], cells_.sum(i).x);
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
  share_patch(points, tiles_.size(), [&](std::size_t t) {
    const std::size_t first = t * kLanes;
    const PatchVelocities velocities{free_.data() + first,
                                     {cells_.sums(0).data() + first, cells_.sums(1).data() + first}};
    respond_(tiles_[t], static_cast<int>(std::min<std::size_t>(kLanes, points - first)), iteration,
             velocities, impulse_.data() + first);
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
    const Vec3 after = vector(free_[i]) + cells_.sum(i);
    const Vec3 mean = 0.5 * (point.velocity_before + after);
    point.closing_speed = dot(mean, point.normal);
    point.slip_speed = slip_of(point, mean);
  }
}

void PatchSolver::solve(std::vector<ContactPoint>& points, const PointSprings& springs, Friction& friction,
                        const BodyFrame& wheel, const NodeMotion& motion, double dt) {
  remove_open(points, dt);
  cells_.link(points, motion.inverse_mass);
  change_.resize(cells_.nodes().size());
  for (std::vector<PatchVector>* vectors : {&free_, &impulse_}) vectors->resize(points.size());
  mobility_.resize(points.size());
  set_free(points, wheel, motion);
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
  for (std::size_t n = 0; n < change_.size(); ++n) {
    const PatchCells::Node& node = cells_.nodes()[n];
    Vec3 change = vector(change_[n]);
    if (node.of_wheel) {
      change = localise(node.cosine, node.sine, change);
      change = {cosine * change.x - sine * change.z, change.y, sine * change.x + cosine * change.z};
    } else {
      change = -1 * change;
    }
    motion.velocity.add(node.slot, change);
    motion.displacement.add(node.slot, dt * change);
  }
}

std::int64_t PatchSolver::bytes() const {
  const std::size_t vectors = free_.capacity() + impulse_.capacity() + change_.capacity();
  return cells_.bytes() +
         static_cast<std::int64_t>(tiles_.capacity() * sizeof(PointTile) + vectors * sizeof(PatchVector) +
                                   mobility_.capacity() * sizeof(double));
}

}  // namespace tread
