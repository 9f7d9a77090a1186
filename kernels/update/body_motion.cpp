#include "kernels/update/body_motion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/index.hpp"
#include "core/parallel/parallel.hpp"
#include "kernels/update/anchoring.hpp"

namespace tread {

namespace {

/// One vector for each lane of a tile.
struct LaneVectors {
  double value[3][kLanes] = {};

  Vec3 at(int lane) const { return {value[0][lane], value[1][lane], value[2][lane]}; }
  void set(int lane, const Vec3& v) {
    for (int c = 0; c < 3; ++c) value[c][lane] = v[c];
  }
  /// Adds the vectors of a node's lanes, times their weights.
  void add(const double* weight, const NodeLanes& vectors) {
    for (int c = 0; c < 3; ++c)
      for (int lane = 0; lane < kLanes; ++lane) value[c][lane] += weight[lane] * vectors[c][lane];
  }
};

/// A tile of the body and the places of its stations in space.
struct TileView {
  const SweptBlock& block;
  const Tile& tile;
  std::int64_t first_slot;

  TileView(const SweptBlock& of, std::size_t t)
      : block(of),
        tile(of.tiles[t]),
        first_slot(of.base + static_cast<std::int64_t>(t) * of.section.nodes() * kLanes) {}

  double angle(int lane) const { return block.stations[static_cast<std::size_t>(tile.first_station + lane)]; }
  double radius(int node) const { return block.section.q[static_cast<std::size_t>(node)]; }
  std::int64_t slot(int node) const { return first_slot + std::int64_t{node} * kLanes; }
};

/// Calls visit(tile) for all tiles, in parallel.
template <class Visit>
void for_each_tile(const Mesh& mesh, const std::vector<int>& blocks, const Visit& visit) {
  for (const int b : blocks) {
    const SweptBlock& block = mesh.blocks[static_cast<std::size_t>(b)];
    parallel_ranges(static_cast<std::int64_t>(block.tiles.size()),
                    [&](std::int64_t first, std::int64_t last) {
                      for (auto t = static_cast<std::size_t>(first); t < static_cast<std::size_t>(last); ++t)
                        visit(TileView(block, t), t);
                    });
  }
}

/// Sum of the results of `of_tile` over the tiles of the blocks.
template <class Sum, class OfTile>
Sum sum_views(const Mesh& mesh, const std::vector<int>& blocks, const TileShare* share,
              const OfTile& of_tile) {
  return sum_tiles<Sum>(mesh, blocks, share, [&](int block, int tile) {
    return of_tile(TileView(mesh.blocks[index(block)], index(tile)));
  });
}

/// Calls visit(mass, radius, down) for the nodes of a tile; `down`: unit vector from the axis to the node.
template <class Visit>
void for_each_mass(const TileView& view, double* mass, const Visit& visit) {
  for (int lane = 0; lane < view.tile.stations; ++lane) {
    const Vec3 down = Turn(view.angle(lane)).to_cartesian({0, 0, 1});
    for (int node = 0; node < view.block.section.nodes(); ++node)
      visit(mass[view.slot(node) + lane], view.radius(node), down);
  }
}

/// First and second moments about the axis, in the axes x and z.
struct Unbalance {
  double x = 0, z = 0, xx = 0, xz = 0, zz = 0;
  Unbalance& operator+=(const Unbalance& o) {
    x += o.x;
    z += o.z;
    xx += o.xx;
    xz += o.xz;
    zz += o.zz;
    return *this;
  }
  void add(double m, double at_x, double at_z) {
    *this += {m * at_x, m * at_z, m * at_x * at_x, m * at_x * at_z, m * at_z * at_z};
  }
};

struct Moments {
  double mass = 0, first_x = 0, first_y = 0, first_z = 0, second_y = 0, polar = 0;
  Moments& operator+=(const Moments& o) {
    mass += o.mass;
    first_x += o.first_x;
    first_y += o.first_y;
    first_z += o.first_z;
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

void balance(const Mesh& mesh, const std::vector<int>& blocks, double* mass) {
  double radius = 0;
  for (const int b : blocks) {
    const SweptBlock& block = mesh.blocks[index(b)];
    if (!block.closed) return;
    radius = std::max(radius, *std::ranges::max_element(block.section.q));
  }
  auto sums = sum_views<Unbalance>(mesh, blocks, nullptr, [mass](const TileView& view) {
    Unbalance sum;
    for_each_mass(view, mass,
                  [&](double m, double r, const Vec3& down) { sum.add(m, r * down.x, r * down.z); });
    return sum;
  });
  for_each_body_node(mesh, true,
                     [&](std::int64_t slot, const Vec3& at) { sums.add(mass[slot], at.x, at.z); });

  const double determinant = sums.xx * sums.zz - sums.xz * sums.xz;
  if (!(determinant > 0)) return;
  const double a = (sums.xz * sums.z - sums.zz * sums.x) / determinant;
  const double b = (sums.xz * sums.x - sums.xx * sums.z) / determinant;
  constexpr double kOfMesh = 0.01;
  if (std::hypot(a, b) * radius > kOfMesh) return;
  for_each_tile(mesh, blocks, [&](const TileView& view, std::size_t /*tile*/) {
    for_each_mass(view, mass,
                  [&](double& m, double r, const Vec3& down) { m *= 1 + r * (a * down.x + b * down.z); });
  });
  for_each_body_node(mesh, true,
                     [&](std::int64_t slot, const Vec3& at) { mass[slot] *= 1 + a * at.x + b * at.z; });
}

SpinningBody::SpinningBody(const Mesh& mesh, std::vector<int> blocks, const double* mass)
    : mesh_(&mesh), blocks_(std::move(blocks)), nodal_mass_(mass) {
  auto sums = sum_views<Moments>(mesh, blocks_, nullptr, [mass](const TileView& view) {
    Moments m;
    for (int node = 0; node < view.block.section.nodes(); ++node)
      for (int lane = 0; lane < view.tile.stations; ++lane) {
        const double at = mass[view.slot(node) + lane];
        const double y = view.block.section.p[static_cast<std::size_t>(node)];
        const double r = view.radius(node);
        const Vec3 down = Turn(view.angle(lane)).to_cartesian({0, 0, r});
        m += Moments{at, at * down.x, at * y, at * down.z, at * y * y, at * r * r};
      }
    return m;
  });
  for_each_body_node(mesh, true, [&](std::int64_t slot, const Vec3& at) {
    const double m = mass[slot];
    sums += Moments{m, m * at.x, m * at.y, m * at.z, m * at.y * at.y, m * (at.x * at.x + at.z * at.z)};
  });
  mass_ = sums.mass;
  inertia_ = sums.polar;
  centre_y_ = sums.first_y / sums.mass;
  transverse_ = 0.5 * sums.polar + sums.second_y - sums.mass * centre_y_ * centre_y_;
  eccentricity_ = {sums.first_x / sums.mass, 0, sums.first_z / sums.mass};
}

double SpinningBody::eccentric_height(double angle) const {
  return Turn(angle).of(eccentricity_).z;
}

MeanMotion SpinningBody::mean_motion(ConstNodeField u, ConstNodeField w, const BodyFrame& frame,
                                     const TileShare* share) const {
  auto sums = sum_views<MotionSums>(*mesh_, blocks_, share, [&](const TileView& view) {
    LaneVectors displacement, velocity;
    double rotation[kLanes] = {};
    double spin[kLanes] = {};
    for (int node = 0; node < view.block.section.nodes(); ++node) {
      const double* m = nodal_mass_ + view.slot(node);
      const NodeLanes u_node = u.lanes(view.slot(node));
      const NodeLanes w_node = w.lanes(view.slot(node));
      displacement.add(m, u_node);
      velocity.add(m, w_node);
      for (int lane = 0; lane < kLanes; ++lane) {
        rotation[lane] += m[lane] * view.radius(node) * u_node[0][lane];
        spin[lane] += m[lane] * view.radius(node) * w_node[0][lane];
      }
    }
    MotionSums sum;
    for (int lane = 0; lane < view.tile.stations; ++lane) {
      const Turn turn(view.angle(lane) + frame.angle);
      const Vec3 moved = displacement.at(lane);
      sum += {turn.to_cartesian(moved), turn.to_cartesian(velocity.at(lane) + spin_cross(frame.spin, moved)),
              rotation[lane], spin[lane]};
    }
    return sum;
  });
  const Turn turn(kCartesianAngle + frame.angle);
  for_each_body_node(*mesh_, true, [&](std::int64_t slot, const Vec3& at) {
    const double m = nodal_mass_[slot];
    const Vec3 moved = m * u.at(slot);
    const Vec3 velocity = m * w.at(slot);
    const auto about_axle = [&](const Vec3& of) { return at.z * of.x - at.x * of.z; };
    sums += {turn.to_cartesian(moved), turn.to_cartesian(velocity + spin_cross(frame.spin, moved)),
             about_axle(moved), about_axle(velocity)};
  });
  return {(1 / mass_) * sums.displacement, (1 / mass_) * sums.velocity, sums.rotation / inertia_,
          sums.spin / inertia_};
}

double SpinningBody::kinetic_energy(ConstNodeField u, ConstNodeField w, const BodyFrame& frame,
                                    const TileShare* share) const {
  auto energy = sum_views<double>(*mesh_, blocks_, share, [&](const TileView& view) {
    LaneVectors carried;  // velocity of the frame in the lanes' bases
    for (int lane = 0; lane < view.tile.stations; ++lane)
      carried.set(lane, Turn(view.angle(lane) + frame.angle).to_cylindrical(frame.velocity));
    double twice[kLanes] = {};
    for (int node = 0; node < view.block.section.nodes(); ++node) {
      const double* m = nodal_mass_ + view.slot(node);
      const NodeLanes at = u.lanes(view.slot(node));
      const NodeLanes relative = w.lanes(view.slot(node));
      for (int lane = 0; lane < kLanes; ++lane) {
        const double r = view.radius(node) + at[2][lane];
        const double v_t = carried.value[0][lane] + relative[0][lane] + frame.spin * r;
        const double v_y = carried.value[1][lane] + relative[1][lane];
        const double v_r = carried.value[2][lane] + relative[2][lane] - frame.spin * at[0][lane];
        twice[lane] += m[lane] * (v_t * v_t + v_y * v_y + v_r * v_r);
      }
    }
    double sum = 0;
    for (const double lane : twice) sum += 0.5 * lane;
    return sum;
  });
  const Vec3 carried = Turn(kCartesianAngle + frame.angle).to_cylindrical(frame.velocity);
  for_each_body_node(*mesh_, true, [&](std::int64_t slot, const Vec3& at) {
    const double m = nodal_mass_[slot];
    const Vec3 v = carried + w.at(slot) + spin_cross(frame.spin, at + u.at(slot));
    energy += 0.5 * m * dot(v, v);
  });
  return energy;
}

Vec3 SpinningBody::momentum(ConstNodeField u, ConstNodeField w, const BodyFrame& frame) const {
  auto momentum = sum_views<Vec3>(*mesh_, blocks_, nullptr, [&](const TileView& view) {
    LaneVectors place, velocity;
    double mass[kLanes] = {};
    for (int node = 0; node < view.block.section.nodes(); ++node) {
      const double* m = nodal_mass_ + view.slot(node);
      place.add(m, u.lanes(view.slot(node)));
      velocity.add(m, w.lanes(view.slot(node)));
      for (int lane = 0; lane < kLanes; ++lane) {
        place.value[2][lane] += m[lane] * view.radius(node);
        mass[lane] += m[lane];
      }
    }
    Vec3 sum;
    for (int lane = 0; lane < view.tile.stations; ++lane)
      sum += mass[lane] * frame.velocity +
             Turn(view.angle(lane) + frame.angle)
                 .to_cartesian(velocity.at(lane) + spin_cross(frame.spin, place.at(lane)));
    return sum;
  });
  const Turn turn(kCartesianAngle + frame.angle);
  for_each_body_node(*mesh_, true, [&](std::int64_t slot, const Vec3& at) {
    const double m = nodal_mass_[slot];
    const Vec3 relative = w.at(slot) + spin_cross(frame.spin, at + u.at(slot));
    momentum += m * (frame.velocity + turn.to_cartesian(relative));
  });
  return momentum;
}

void SpinningBody::anchor(const MeanMotion& mean, NodeField u, NodeField w, BodyFrame& frame, double dt,
                          const unsigned char* groups) const {
  const Anchoring anchoring(mean, frame, dt);
  for_each_tile(*mesh_, blocks_, [&](const TileView& view, std::size_t /*tile*/) {
    std::array<Anchoring::Station, kLanes> stations;
    for (int lane = 0; lane < view.tile.stations; ++lane)
      stations[static_cast<std::size_t>(lane)] = anchoring.at(view.angle(lane));
    for (int node = 0; node < view.block.section.nodes(); ++node) {
      if (groups != nullptr && groups[view.slot(node) / kLanes] == 0) continue;
      const Vec3 reference{0, view.block.section.p[static_cast<std::size_t>(node)], view.radius(node)};
      for (int lane = 0; lane < view.tile.stations; ++lane) {
        const std::int64_t slot = view.slot(node) + lane;
        Vec3 displacement = u.at(slot);
        Vec3 velocity = w.at(slot);
        anchoring.move(stations[static_cast<std::size_t>(lane)], reference, displacement, velocity);
        u.set(slot, displacement);
        w.set(slot, velocity);
      }
    }
  });
  const Anchoring::Station station = anchoring.at(kCartesianAngle);
  for_each_body_node(*mesh_, true, [&](std::int64_t slot, const Vec3& at) {
    Vec3 displacement = u.at(slot);
    Vec3 velocity = w.at(slot);
    anchoring.move(station, at, displacement, velocity);
    u.set(slot, displacement);
    w.set(slot, velocity);
  });
  frame = anchoring.moved();
}

}  // namespace tread
