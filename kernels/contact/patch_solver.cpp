#include "kernels/contact/patch_solver.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <variant>

#include "kernels/contact/patch_point_body.hpp"
#include "kernels/contact/search_body.hpp"
#include "kernels/lanes/tile_force.hpp"

namespace tread {

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
    free_[i] = padded(frame_velocity(points[i], wheel) + cells_.sum(i));
  }
}

void PatchSolver::fill_tiles(const std::vector<ContactPoint>& points, double dt) {
  tiles_.assign((points.size() + kLanes - 1) / kLanes, {});
  for (std::size_t i = 0; i < points.size(); ++i) PointLane::of(tiles_.data(), i).fill(points[i], dt);
}

void PatchSolver::sum_impulses() {
  cells_.to_nodes(impulse_, change_);
  cells_.to_points(change_);
}

template <class Law>
void PatchSolver::advance(const std::vector<ContactPoint>& points, FrictionOf<Law>& friction, double dt) {
  typename Law::State none{};
  for (std::size_t i = 0; i < points.size(); ++i) {
    typename Law::State* state = &none;
    if constexpr (FrictionOf<Law>::kHasState)
      state = &friction.state[static_cast<std::size_t>(points[i].history)];
    PointLane::of(tiles_.data(), i).rub(points[i], friction.law, *state, dt);
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

void PatchSolver::guess(const std::vector<ContactPoint>& points, const PointSprings& springs, double dt) {
  for (std::size_t i = 0; i < points.size(); ++i)
    impulse_[i] = PointLane::of(tiles_.data(), i).guess(points[i], springs, dt);
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
  const auto begin = [&] {
    double largest = 0;
    for (const PointTile& tile : tiles_)
      for (const double compliance : tile.compliance) largest = std::max(largest, compliance);
    guess(points, springs, dt);
    return HeavyBall(springs, largest);
  };
  HeavyBall ball = begin();
  double first = 0;
  for (iterations_ = 1; iterations_ <= kMostIterations; ++iterations_) {
    sum_impulses();
    const Progress progress = respond(points.size(), ball.next(springs, dt));
    unsettled_ = 0;
    if (progress.change <= kTractionTolerance * progress.largest) break;
    unsettled_ = progress.change / progress.largest;
    if (iterations_ == 1) first = progress.change;
    if (progress.change > kDivergence * first) {
      for (PointTile& tile : tiles_)
        for (double& compliance : tile.compliance) compliance *= 2;
      ball = begin();
    }
  }
}

void PatchSolver::settle(std::vector<ContactPoint>& points) {
  for (std::size_t i = 0; i < points.size(); ++i)
    impulse_[i] = PointLane::of(tiles_.data(), i).settle(points[i]);
  sum_impulses();
}

void PatchSolver::set_speeds(std::vector<ContactPoint>& points) const {
  for (std::size_t i = 0; i < points.size(); ++i)
    tread::set_speeds(points[i], vector_of(free_[i]) + cells_.sum(i));
}

void PatchSolver::solve(std::vector<ContactPoint>& points, const PointSprings& springs, Friction& friction,
                        const BodyFrame& wheel, const NodeMotion& motion, double dt) {
  // The search may find more or fewer of them, which the bits do not show.
  std::erase_if(points, [&](const ContactPoint& point) { return stays_open(point, kSpareClosing, dt); });
  cells_.link(points, motion.mass);
  change_.resize(cells_.nodes().size());
  for (std::vector<PatchVector>* vectors : {&free_, &impulse_}) vectors->resize(points.size());
  mobility_.resize(points.size());
  set_free(points, wheel, motion);
  fill_tiles(points, dt);
  std::visit([&](auto& of) { advance(points, of, dt); }, friction);
  set_compliances(points, dt);
  iterate(points, springs, dt);
  settle(points);
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
  const NodeKick kick(spin, dt);
  for (std::size_t n = 0; n < change_.size(); ++n) {
    const PatchCells::Node& node = cells_.nodes()[n];
    const Vec3 change = kick.local(vector_of(change_[n]), node.of_wheel, node.cosine, node.sine);
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
