#include "kernels/solver/held_motions.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <utility>

#include "core/aligned.hpp"
#include "core/error.hpp"
#include "core/mesh/node_field.hpp"
#include "core/parallel/parallel.hpp"

namespace tread {

namespace {

/// Calls visit(p, q, slot of its first lane) for a tile's section nodes.
template <class Visit>
void for_each_node(const SweptBlock& block, int tile, const Visit& visit) {
  for (int node = 0; node < block.section.nodes(); ++node)
    visit(block.section.p[static_cast<std::size_t>(node)], block.section.q[static_cast<std::size_t>(node)],
          block.base + (std::int64_t{tile} * block.section.nodes() + node) * kLanes);
}

}  // namespace

HeldMotions::HeldMotions(const Mesh& mesh, const std::vector<int>& blocks, const double* mass,
                         std::vector<RigidMotion> motions)
    : mesh_(&mesh), mass_(mass), motions_(std::move(motions)) {
  for (const int b : blocks) {
    const SweptBlock& block = mesh.blocks[static_cast<std::size_t>(b)];
    for (int tile = 0; tile < static_cast<int>(block.tiles.size()); ++tile)
      items_.push_back({&block, tile,
                        stations_.size() + static_cast<std::size_t>(
                                               block.tiles[static_cast<std::size_t>(tile)].first_station)});
    for (int station = 0; station < block.station_count(); ++station) stations_.emplace_back(block, station);
  }
  partial_.resize(items_.size());

  const auto n = static_cast<Eigen::Index>(count());
  Eigen::MatrixXd product(n, n);
  AlignedVector<double> field(static_cast<std::size_t>(3 * mesh.slots));
  for (Eigen::Index j = 0; j < n; ++j) {
    std::fill(field.begin(), field.end(), 0.0);
    add(motions_[static_cast<std::size_t>(j)], false, field.data());
    const RigidMotion momentum = resultant(field.data(), true);
    for (Eigen::Index i = 0; i < n; ++i) product(i, j) = dot(motions_[static_cast<std::size_t>(i)], momentum);
  }
  const Eigen::FullPivLU<Eigen::MatrixXd> factor(product);
  if (!factor.isInvertible())
    throw NumericalError("static solver: a held motion has no mean; its nodes are fixed or it is held twice");
  const Eigen::MatrixXd inverse = factor.inverse();
  inverse_.assign(inverse.data(), inverse.data() + inverse.size());
}

RigidMotion HeldMotions::resultant(const double* field, bool weighted) const {
  parallel_ranges(static_cast<std::int64_t>(items_.size()), [&](std::int64_t first, std::int64_t last) {
    for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(last); ++i) {
      const auto& [block, tile, first_station] = items_[i];
      TileValues sums;
      for_each_node(*block, tile, [&](double p, double q, std::int64_t slot) {
        const double* mass = mass_ + slot;
        sums.add(p, q, field + dof(slot, 0), [=](int, int lane) { return weighted ? mass[lane] : 1.0; });
      });
      partial_[i] = {};
      for (int lane = 0; lane < block->tiles[static_cast<std::size_t>(tile)].stations; ++lane)
        partial_[i] += stations_[first_station + static_cast<std::size_t>(lane)].resultant(sums.at(lane), {});
    }
  });
  RigidMotion sum;
  for (const RigidMotion& part : partial_) sum += part;
  for_each_body_node(*mesh_, true, [&](std::int64_t slot, const Vec3& at) {
    const Vec3 value = (weighted ? mass_[slot] : 1.0) * ConstNodeField(field).at(slot);
    sum += RigidMotion{value, cross(at, value)};
  });
  return sum;
}

void HeldMotions::add(const RigidMotion& motion, bool weighted, double* field) const {
  parallel_ranges(static_cast<std::int64_t>(items_.size()), [&](std::int64_t first, std::int64_t last) {
    for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(last); ++i) {
      const auto& [block, tile, first_station] = items_[i];
      TileValues values;
      for (int lane = 0; lane < block->tiles[static_cast<std::size_t>(tile)].stations; ++lane)
        values.set(lane, stations_[first_station + static_cast<std::size_t>(lane)].displacement(motion, {}));
      for_each_node(*block, tile, [&](double p, double q, std::int64_t slot) {
        const double* mass = mass_ + slot;
        values.add_to(p, q, field + dof(slot, 0),
                      [=](int, int lane) { return weighted || mass[lane] == 0 ? mass[lane] : 1.0; });
      });
    }
  });
  for_each_body_node(*mesh_, true, [&](std::int64_t slot, const Vec3& at) {
    const double scale = weighted || mass_[slot] == 0 ? mass_[slot] : 1.0;
    NodeField(field).add(slot, scale * (motion.translation + cross(motion.rotation, at)));
  });
}

/// Returns R (R^T M R)^-1 work, a rigid motion.
RigidMotion HeldMotions::combined(const std::vector<double>& work) const {
  RigidMotion sum;
  for (std::size_t j = 0; j < count(); ++j)
    for (std::size_t i = 0; i < count(); ++i) sum += (inverse_[i * count() + j] * work[j]) * motions_[i];
  return sum;
}

void HeldMotions::balance(double* r) const {
  add(-1 * combined(work(r)), true, r);
}

void HeldMotions::remove_mean(double* x) const {
  const RigidMotion momentum = resultant(x, true);
  std::vector<double> mean(count());
  for (std::size_t i = 0; i < count(); ++i) mean[i] = dot(motions_[i], momentum);
  add(-1 * combined(mean), false, x);
}

std::vector<double> HeldMotions::work(const double* r) const {
  const RigidMotion force = resultant(r, false);
  std::vector<double> work(count());
  for (std::size_t i = 0; i < count(); ++i) work[i] = dot(motions_[i], force);
  return work;
}

}  // namespace tread
