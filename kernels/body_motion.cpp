#include "kernels/body_motion.hpp"

#include <utility>

#include "core/parallel.hpp"

namespace tread {

namespace {

struct NodeView {
  std::int64_t slot;
  double angle;    ///< of the node in the frame [rad]
  Vec3 reference;  ///< (0, y, r) [m]
  double mass;
};

template <class Visit>
void visit_tile(const SweptBlock& block, std::size_t t, const double* mass, Visit visit) {
  const Tile& tile = block.tiles[t];
  for (int node = 0; node < block.section.nodes(); ++node) {
    const auto n = static_cast<std::size_t>(node);
    for (int l = 0; l < tile.stations; ++l) {
      const std::int64_t slot =
          block.base + (static_cast<std::int64_t>(t) * block.section.nodes() + node) * kLanes + l;
      visit(NodeView{slot,
                     block.stations[static_cast<std::size_t>(tile.first_station + l)],
                     {0, block.section.p[n], block.section.q[n]},
                     mass[slot]});
    }
  }
}

/// Sums over tiles in a fixed order whatever the number of threads.
template <class Sum, class Visit>
Sum sum_over_tiles(const Mesh& mesh, const std::vector<int>& blocks, const double* mass, Visit visit) {
  Sum total{};
  for (const int b : blocks) {
    const SweptBlock& block = mesh.blocks[static_cast<std::size_t>(b)];
    std::vector<Sum> partial(block.tiles.size());
    parallel_ranges(static_cast<std::int64_t>(block.tiles.size()),
                    [&](std::int64_t first, std::int64_t last) {
                      for (auto t = static_cast<std::size_t>(first); t < static_cast<std::size_t>(last); ++t)
                        visit_tile(block, t, mass, [&](const NodeView& node) { visit(node, partial[t]); });
                    });
    for (const Sum& part : partial) total += part;
  }
  return total;
}

struct Moments {
  double mass = 0, first_y = 0, second_y = 0, polar = 0;
  Moments& operator+=(const Moments& o) {
    mass += o.mass;
    first_y += o.first_y;
    second_y += o.second_y;
    polar += o.polar;
    return *this;
  }
};

struct MotionSums {
  Vec3 displacement, velocity;
  double rotation = 0, spin = 0;
  MotionSums& operator+=(const MotionSums& o) {
    displacement += o.displacement;
    velocity += o.velocity;
    rotation += o.rotation;
    spin += o.spin;
    return *this;
  }
};

}  // namespace

SpinningBody::SpinningBody(const Mesh& mesh, std::vector<int> blocks, const double* mass)
    : mesh_(&mesh), blocks_(std::move(blocks)), nodal_mass_(mass) {
  const auto sums = sum_over_tiles<Moments>(mesh, blocks_, mass, [](const NodeView& n, Moments& m) {
    const double y = n.reference.y;
    const double r = n.reference.z;
    m += Moments{n.mass, n.mass * y, n.mass * y * y, n.mass * r * r};
  });
  mass_ = sums.mass;
  inertia_ = sums.polar;
  centre_y_ = sums.first_y / sums.mass;
  transverse_ = 0.5 * sums.polar + sums.second_y - sums.mass * centre_y_ * centre_y_;
}

MeanMotion SpinningBody::mean_motion(ConstNodeField u, ConstNodeField w, const BodyFrame& frame) const {
  const auto sums =
      sum_over_tiles<MotionSums>(*mesh_, blocks_, nodal_mass_, [&](const NodeView& n, MotionSums& s) {
        const Vec3 displacement = u.at(n.slot);
        const Vec3 velocity = w.at(n.slot) + spin_cross(frame.spin, displacement);
        const double phi = n.angle + frame.angle;
        s += MotionSums{n.mass * cylindrical_to_cartesian(phi, displacement),
                        n.mass * cylindrical_to_cartesian(phi, velocity),
                        n.mass * n.reference.z * displacement.x, n.mass * n.reference.z * w.at(n.slot).x};
      });
  return {(1 / mass_) * sums.displacement, (1 / mass_) * sums.velocity, sums.rotation / inertia_,
          sums.spin / inertia_};
}

double SpinningBody::kinetic_energy(ConstNodeField u, ConstNodeField w, const BodyFrame& frame) const {
  return sum_over_tiles<double>(*mesh_, blocks_, nodal_mass_, [&](const NodeView& n, double& sum) {
    const Vec3 relative = w.at(n.slot) + spin_cross(frame.spin, n.reference + u.at(n.slot));
    const Vec3 v = frame.velocity + cylindrical_to_cartesian(n.angle + frame.angle, relative);
    sum += 0.5 * n.mass * dot(v, v);
  });
}

Vec3 SpinningBody::momentum(ConstNodeField u, ConstNodeField w, const BodyFrame& frame) const {
  return sum_over_tiles<Vec3>(*mesh_, blocks_, nodal_mass_, [&](const NodeView& n, Vec3& sum) {
    const Vec3 relative = w.at(n.slot) + spin_cross(frame.spin, n.reference + u.at(n.slot));
    sum += n.mass * (frame.velocity + cylindrical_to_cartesian(n.angle + frame.angle, relative));
  });
}

void SpinningBody::anchor(MeanMotion mean, NodeField u, NodeField w, BodyFrame& frame, double dt) const {
  // Along the axis the body is restrained, not free: the frame stays there.
  mean.displacement.y = mean.velocity.y = 0;
  BodyFrame moved = frame;
  moved.origin += mean.displacement;
  moved.velocity += mean.velocity;
  moved.angle += mean.rotation;
  moved.spin += mean.spin;

  BodyFrame before_half = frame;
  before_half.advance(-0.5 * dt);
  BodyFrame after_half = moved;
  after_half.advance(-0.5 * dt);
  const double turned_half = after_half.angle - before_half.angle;
  const Vec3 step_half = after_half.origin - before_half.origin;
  const Vec3 speed_change = moved.velocity - frame.velocity;

  for (const int b : blocks_) {
    const SweptBlock& block = mesh_->blocks[static_cast<std::size_t>(b)];
    parallel_ranges(static_cast<std::int64_t>(block.tiles.size()), [&](std::int64_t first,
                                                                       std::int64_t last) {
      for (auto t = static_cast<std::size_t>(first); t < static_cast<std::size_t>(last); ++t)
        visit_tile(block, t, nodal_mass_, [&](const NodeView& n) {
          const Vec3 displacement = u.at(n.slot);
          const Vec3 velocity = w.at(n.slot);
          // Absolute position now, seen from the moved frame.
          const Vec3 arm =
              n.reference + displacement - cartesian_to_cylindrical(n.angle + frame.angle, mean.displacement);
          u.set(n.slot, turn(arm, -mean.rotation) - n.reference);
          // Absolute velocity at the half step, seen from the moved frame.
          const double phi_half = n.angle + before_half.angle;
          const Vec3 arm_half = n.reference + displacement - (0.5 * dt) * velocity;
          const Vec3 absolute = velocity + spin_cross(frame.spin, arm_half);
          const Vec3 moved_arm = turn(arm_half - cartesian_to_cylindrical(phi_half, step_half), -turned_half);
          w.set(n.slot, turn(absolute - cartesian_to_cylindrical(phi_half, speed_change), -turned_half) -
                            spin_cross(moved.spin, moved_arm));
        });
    });
  }
  frame = moved;
}

}  // namespace tread
