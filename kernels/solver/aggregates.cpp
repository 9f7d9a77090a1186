#include "kernels/solver/aggregates.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "core/index.hpp"
#include "core/parallel/parallel.hpp"
#include "kernels/lanes/prefetch.hpp"
#include "kernels/solver/aggregate_parts.hpp"

namespace tread {

std::int64_t aggregate_count(const Mesh& mesh, const AggregateOptions& options) {
  std::int64_t count = 0;
  for (const HexBody& body : mesh.bodies)
    count += static_cast<std::int64_t>(body_parts(body, options).size());
  for (const SweptBlock& block : mesh.blocks)
    for (const auto& nodes : section_parts(block.section, options))
      count += static_cast<std::int64_t>(station_runs(block, mean_radius(block, nodes), options).size());
  return count;
}

Aggregates::Aggregates(const Mesh& mesh, const AlignedVector<double>& free, const AggregateOptions& options)
    : mesh_(&mesh),
      free_(static_cast<std::size_t>(mesh.slots), 0),
      part_of_node_(mesh.blocks.size()),
      first_body_slot_(mesh.bodies.empty() ? mesh.slots : mesh.bodies.front().base),
      of_body_slots_(static_cast<std::size_t>(mesh.slots - first_body_slot_), -1) {
  for (std::int64_t slot = 0; slot < mesh.slots; ++slot)
    for (int c = 0; c < 3; ++c)
      if (free[static_cast<std::size_t>(dof(slot, c))] != 0)
        free_[static_cast<std::size_t>(slot)] |= static_cast<std::uint8_t>(1 << c);
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    const SweptBlock& block = mesh.blocks[b];
    part_of_node_[b].resize(block.section.p.size());
    for (auto& nodes : section_parts(block.section, options)) {
      for (const int node : nodes)
        part_of_node_[b][static_cast<std::size_t>(node)] = static_cast<int>(parts_.size());
      add_part(block, std::move(nodes), options);
    }
  }
  for (const HexBody& body : mesh.bodies)
    for (const std::vector<std::int32_t>& nodes : body_parts(body, options)) add_box(body, nodes);
  sums_.resize(slices_.size());
}

void Aggregates::add_part(const SweptBlock& block, std::vector<int> nodes, const AggregateOptions& options) {
  const double radius = mean_radius(block, nodes);
  const int part = static_cast<int>(parts_.size());
  parts_.push_back({&block, std::move(nodes), slices_.size()});
  for (int station = 0; station < block.station_count(); ++station)
    slices_.push_back({StationPlace(block, station)});
  for (int tile = 0; tile < static_cast<int>(block.tiles.size()); ++tile) items_.push_back({part, tile});
  int first = 0;
  for (const int last : station_runs(block, radius, options)) {
    add_stations(part, first, last);
    first = last;
  }
}

/// Calls visit(place of the station, p, q, free components).
template <class Visit>
void Aggregates::for_each_node(const Patch& patch, const Visit& visit) const {
  for (std::size_t i = patch.first_node; i < patch.last_node; ++i) {
    const BodyNode& node = body_nodes_[i];
    const int bits = free_[static_cast<std::size_t>(node.slot)];
    if (bits != 0) visit(StationPlace(node.at.x), node.at.y, node.at.z, bits);
  }
  if (patch.part < 0) return;
  const Part& part = parts_[static_cast<std::size_t>(patch.part)];
  const Section& section = part.block->section;
  for (int station = patch.first_station; station < patch.last_station; ++station)
    for (const int node : part.nodes) {
      const std::int64_t slot = part.block->base + part.block->slot(node, station);
      const int bits = free_[static_cast<std::size_t>(slot)];
      if (bits != 0)
        visit(slice(part, station).place, section.p[static_cast<std::size_t>(node)],
              section.q[static_cast<std::size_t>(node)], bits);
    }
}

void Aggregates::add_stations(int part, int first_station, int last_station) {
  Patch patch;
  patch.part = part;
  patch.first_station = first_station;
  patch.last_station = last_station;
  if (!add_patch(patch)) return;
  for (int station = first_station; station < last_station; ++station)
    slices_[parts_[static_cast<std::size_t>(part)].first_slice + static_cast<std::size_t>(station)].patch =
        count() - 1;
}

void Aggregates::add_box(const HexBody& body, const std::vector<std::int32_t>& nodes) {
  Patch patch;
  patch.first_node = body_nodes_.size();
  for (const std::int32_t node : nodes)
    body_nodes_.push_back({body.slot(node), body.mesh.nodes[static_cast<std::size_t>(node)]});
  patch.last_node = body_nodes_.size();
  const bool moves = add_patch(patch);
  for (std::size_t i = patch.first_node; moves && i < patch.last_node; ++i)
    of_body_slots_[static_cast<std::size_t>(body_nodes_[i].slot - first_body_slot_)] =
        static_cast<std::int32_t>(i);
  body_patches_.resize(body_nodes_.size(), moves ? count() - 1 : -1);
}

/// Returns false where nothing of the patch is free.
bool Aggregates::add_patch(Patch patch) {
  int nodes = 0;
  for_each_node(patch, [&](const StationPlace& place, double p, double q, int /*free*/) {
    patch.centre += place.position(p, q);
    ++nodes;
  });
  if (nodes == 0) return false;
  patch.centre = (1.0 / nodes) * patch.centre;
  orthonormalise(patch);
  patch.first_mode = modes_;
  modes_ += patch.mode_count;
  patches_.push_back(patch);
  return true;
}

namespace {

constexpr std::array<RigidMotion, 6> kUnitMotions = {
    {{{1, 0, 0}, {}}, {{0, 1, 0}, {}}, {{0, 0, 1}, {}}, {{}, {1, 0, 0}}, {{}, {0, 1, 0}}, {{}, {0, 0, 1}}}};

/// Displacement of each local component of a node under the six unit motions about `centre`.
std::array<std::array<double, 6>, 3> rigid_rows(const StationPlace& place, double p, double q,
                                                const Vec3& centre) {
  std::array<std::array<double, 6>, 3> rows;
  for (std::size_t m = 0; m < 6; ++m) {
    const StationValues values = place.displacement(kUnitMotions[m], centre);
    const Vec3 at = values.constant + p * values.along_p + q * values.along_q;
    for (int c = 0; c < 3; ++c) rows[static_cast<std::size_t>(c)][m] = at[c];
  }
  return rows;
}

}  // namespace

void Aggregates::orthonormalise(Patch& patch) const {
  Eigen::Matrix<double, 6, 6> gram = Eigen::Matrix<double, 6, 6>::Zero();
  double extent = 0;
  for_each_node(patch, [&](const StationPlace& place, double p, double q, int free) {
    extent = std::max(extent, norm(place.position(p, q) - patch.centre));
    const auto rows = rigid_rows(place, p, q, patch.centre);
    for (std::size_t c = 0; c < 3; ++c) {
      if (!(free >> c & 1)) continue;
      const Eigen::Map<const Eigen::Matrix<double, 6, 1>> row(rows[c].data());
      gram += row * row.transpose();
    }
  });
  // Rotations are in units of the aggregate's extent, so that one threshold judges all motions.
  const double unit = extent > 0 ? 1 / extent : 1;
  Eigen::Matrix<double, 6, 1> scale;
  scale << 1, 1, 1, unit, unit, unit;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> eigen(scale.asDiagonal() * gram *
                                                                         scale.asDiagonal());
  constexpr double kSmallest = 1e-7;  // a smaller motion is a combination of the others up to rounding
  for (int k = 5; k >= 0; --k) {
    const double value = eigen.eigenvalues()[k];
    if (value <= kSmallest * eigen.eigenvalues()[5]) break;
    RigidMotion& mode = patch.basis[static_cast<std::size_t>(patch.mode_count++)];
    for (std::size_t i = 0; i < 6; ++i)
      mode += (scale[static_cast<Eigen::Index>(i)] * eigen.eigenvectors()(static_cast<Eigen::Index>(i), k) /
               std::sqrt(value)) *
              kUnitMotions[i];
  }
}

int Aggregates::of_slot(std::int64_t slot) const {
  if (free_[static_cast<std::size_t>(slot)] == 0) return -1;
  if (is_of_body(slot)) {
    const std::int32_t node = of_body_slots_[static_cast<std::size_t>(slot - first_body_slot_)];
    return node < 0 ? -1 : body_patches_[static_cast<std::size_t>(node)];
  }
  std::size_t b = 0;
  while (slot >= mesh_->blocks[b].base + mesh_->blocks[b].slots()) ++b;
  const SweptBlock& block = mesh_->blocks[b];
  const std::int64_t group = (slot - block.base) / kLanes;
  const auto tile = static_cast<std::size_t>(group / block.section.nodes());
  const auto node = static_cast<std::size_t>(group % block.section.nodes());
  const int station = block.tiles[tile].first_station + static_cast<int>(slot % kLanes);
  return slice(parts_[static_cast<std::size_t>(part_of_node_[b][node])], station).patch;
}

std::array<double, 6> Aggregates::mode_row(std::int64_t unknown) const {
  const std::int64_t slot = slot_of(unknown);
  const int component = component_of(unknown);
  std::array<double, 6> values = {};
  if (!(free_[static_cast<std::size_t>(slot)] >> component & 1)) return values;
  const Patch& patch = patches_[static_cast<std::size_t>(of_slot(slot))];
  if (is_of_body(slot)) {
    const auto node =
        static_cast<std::size_t>(of_body_slots_[static_cast<std::size_t>(slot - first_body_slot_)]);
    const Vec3& at = body_nodes_[node].at;
    for (std::size_t k = 0; k < 6; ++k)
      values[k] = (patch.basis[k].translation + cross(patch.basis[k].rotation, at - patch.centre))[component];
    return values;
  }
  const Part& part = parts_[static_cast<std::size_t>(patch.part)];
  const std::int64_t group = (slot - part.block->base) / kLanes;
  const auto node = static_cast<std::size_t>(group % part.block->section.nodes());
  const int station =
      part.block->tiles[static_cast<std::size_t>(group / part.block->section.nodes())].first_station +
      static_cast<int>(slot % kLanes);
  for (std::size_t k = 0; k < 6; ++k) {
    const StationValues mode = slice(part, station).place.displacement(patch.basis[k], patch.centre);
    values[k] = (mode.constant + part.block->section.p[node] * mode.along_p +
                 part.block->section.q[node] * mode.along_q)[component];
  }
  return values;
}

/// Calls visit(p, q, first slot) for a part's section nodes in a tile. Their values lie apart in `field`:
/// those of later nodes are fetched ahead.
template <class Visit>
void Aggregates::for_each_slot(const Item& item, const double* field, const Visit& visit) const {
  constexpr std::size_t kAhead = 8;
  const Part& part = parts_[index(item.part)];
  const SweptBlock& block = *part.block;
  const auto first_slot = [&](std::size_t i) {
    return block.base + (std::int64_t{item.tile} * block.section.nodes() + part.nodes[i]) * kLanes;
  };
  for (std::size_t i = 0; i < part.nodes.size(); ++i) {
    if (i + kAhead < part.nodes.size()) prefetch_vector<0>(field + dof(first_slot(i + kAhead), 0));
    const std::size_t node = index(part.nodes[i]);
    visit(block.section.p[node], block.section.q[node], first_slot(i));
  }
}

void Aggregates::restrict_to_modes(const double* fine, double* coarse) const {
  parallel_ranges(static_cast<std::int64_t>(items_.size()), [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i) {
      const Item& item = items_[index(i)];
      const Part& part = parts_[index(item.part)];
      TileValues sums;
      for_each_slot(item, fine, [&](double p, double q, std::int64_t slot) {
        where_free(slot, [&](const auto& weight) { sums.add(p, q, fine + dof(slot, 0), weight); });
      });
      const Tile& tile = part.block->tiles[index(item.tile)];
      for (int lane = 0; lane < tile.stations; ++lane)
        sums_[part.first_slice + static_cast<std::size_t>(tile.first_station + lane)] = sums.at(lane);
    }
  });
  parallel_ranges(count(), [&](std::int64_t first, std::int64_t last) {
    for (auto a = static_cast<std::size_t>(first); a < static_cast<std::size_t>(last); ++a) {
      const Patch& patch = patches_[a];
      const RigidMotion sum = resultant(patch, fine);
      for (int k = 0; k < patch.mode_count; ++k)
        coarse[patch.first_mode + k] = dot(patch.basis[static_cast<std::size_t>(k)], sum);
    }
  });
}

/// Resultant of the forces at a patch's nodes; those of blocks are summed up in sums_.
RigidMotion Aggregates::resultant(const Patch& patch, const double* fine) const {
  RigidMotion sum;
  for (std::size_t i = patch.first_node; i < patch.last_node; ++i) {
    const BodyNode& node = body_nodes_[i];
    const int bits = free_[static_cast<std::size_t>(node.slot)];
    Vec3 force;
    for (int c = 0; c < 3; ++c) force[c] = (bits >> c & 1) != 0 ? fine[dof(node.slot, c)] : 0;
    sum += RigidMotion{force, cross(node.at - patch.centre, force)};
  }
  if (patch.part < 0) return sum;
  const Part& part = parts_[static_cast<std::size_t>(patch.part)];
  for (int station = patch.first_station; station < patch.last_station; ++station)
    sum += slice(part, station)
               .place.resultant(sums_[part.first_slice + static_cast<std::size_t>(station)], patch.centre);
  return sum;
}

RigidMotion Aggregates::motion(const Patch& patch, const double* coarse) const {
  RigidMotion sum;
  for (int k = 0; k < patch.mode_count; ++k)
    sum += coarse[patch.first_mode + k] * patch.basis[static_cast<std::size_t>(k)];
  return sum;
}

void Aggregates::prolongate_add(const double* coarse, double* fine) const {
  parallel_ranges(static_cast<std::int64_t>(items_.size()), [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i) {
      const Item& item = items_[index(i)];
      const Part& part = parts_[index(item.part)];
      const Tile& tile = part.block->tiles[index(item.tile)];
      TileValues motions;
      for (int lane = 0; lane < tile.stations; ++lane) {
        const Slice& at = slice(part, tile.first_station + lane);
        if (at.patch < 0) continue;
        const Patch& patch = patches_[static_cast<std::size_t>(at.patch)];
        motions.set(lane, at.place.displacement(motion(patch, coarse), patch.centre));
      }
      for_each_slot(item, fine, [&](double p, double q, std::int64_t slot) {
        where_free(slot, [&](const auto& weight) { motions.add_to(p, q, fine + dof(slot, 0), weight); });
      });
    }
  });
  parallel_ranges(count(), [&](std::int64_t first, std::int64_t last) {
    for (auto a = static_cast<std::size_t>(first); a < static_cast<std::size_t>(last); ++a) {
      const Patch& patch = patches_[a];
      if (patch.first_node == patch.last_node) continue;
      const RigidMotion moved = motion(patch, coarse);
      for (std::size_t i = patch.first_node; i < patch.last_node; ++i) {
        const BodyNode& node = body_nodes_[i];
        const Vec3 at = moved.translation + cross(moved.rotation, node.at - patch.centre);
        for (int c = 0; c < 3; ++c)
          if ((free_[static_cast<std::size_t>(node.slot)] >> c & 1) != 0) fine[dof(node.slot, c)] += at[c];
      }
    }
  });
}

}  // namespace tread
