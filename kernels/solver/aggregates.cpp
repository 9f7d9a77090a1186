#include "kernels/solver/aggregates.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "core/parallel.hpp"

namespace tread {

namespace {

/// Neighbours of every section node along the edges of the quads.
std::vector<std::vector<int>> node_graph(const Section& section) {
  std::vector<std::set<int>> neighbours(section.p.size());
  for (const auto& quad : section.quads)
    for (std::size_t e = 0; e < 4; ++e) {
      const int a = quad[e];
      const int b = quad[(e + 1) % 4];
      neighbours[static_cast<std::size_t>(a)].insert(b);
      neighbours[static_cast<std::size_t>(b)].insert(a);
    }
  std::vector<std::vector<int>> graph;
  graph.reserve(neighbours.size());
  for (const auto& set : neighbours) graph.emplace_back(set.begin(), set.end());
  return graph;
}

/// Cuts section nodes across their longer side until they are close together and few enough. (A graph
/// partition balances areas instead and makes long parts of thin plates: four times the iterations on a
/// disc.)
void cut(const Section& section, std::vector<int> nodes, const AggregateOptions& options,
         std::vector<std::vector<int>>& parts) {
  const std::vector<double>* along = nullptr;
  double extent = -1, start = 0;
  for (const auto* axis : {&section.p, &section.q}) {
    const auto less = [&](int a, int b) {
      return (*axis)[static_cast<std::size_t>(a)] < (*axis)[static_cast<std::size_t>(b)];
    };
    const auto [low, high] = std::minmax_element(nodes.begin(), nodes.end(), less);
    const double length = (*axis)[static_cast<std::size_t>(*high)] - (*axis)[static_cast<std::size_t>(*low)];
    if (length <= extent) continue;
    along = axis;
    extent = length;
    start = (*axis)[static_cast<std::size_t>(*low)];
  }
  const auto least = static_cast<std::size_t>(options.least_across * options.least_across);
  const std::size_t slices =
      std::min(nodes.size() / least, static_cast<std::size_t>(std::ceil(extent / options.size)));
  if (slices > 1) {
    std::vector<std::vector<int>> slice(slices);
    for (const int node : nodes) {
      const double place =
          ((*along)[static_cast<std::size_t>(node)] - start) / extent * static_cast<double>(slices);
      slice[std::min(slices - 1, static_cast<std::size_t>(place))].push_back(node);
    }
    for (auto& piece : slice)
      if (!piece.empty()) cut(section, std::move(piece), options, parts);
  } else if (nodes.size() > static_cast<std::size_t>(options.nodes_across * options.nodes_across)) {
    std::stable_sort(nodes.begin(), nodes.end(), [&](int a, int b) {
      return (*along)[static_cast<std::size_t>(a)] < (*along)[static_cast<std::size_t>(b)];
    });
    const auto middle = nodes.begin() + static_cast<std::ptrdiff_t>(nodes.size() / 2);
    cut(section, {nodes.begin(), middle}, options, parts);
    cut(section, {middle, nodes.end()}, options, parts);
  } else {
    parts.push_back(std::move(nodes));
  }
}

/// Connected parts of the section, each about one aggregate in extent.
std::vector<std::vector<int>> section_parts(const Section& section, const AggregateOptions& options) {
  std::vector<int> all(section.p.size());
  std::iota(all.begin(), all.end(), 0);
  std::vector<std::vector<int>> pieces;
  cut(section, std::move(all), options, pieces);

  const auto graph = node_graph(section);
  std::vector<int> piece_of(graph.size());
  for (std::size_t i = 0; i < pieces.size(); ++i)
    for (const int node : pieces[i]) piece_of[static_cast<std::size_t>(node)] = static_cast<int>(i);
  std::vector<std::vector<int>> parts;
  std::vector<bool> taken(graph.size(), false);
  for (std::size_t seed = 0; seed < graph.size(); ++seed) {
    if (taken[seed]) continue;
    std::vector<int> members{static_cast<int>(seed)};
    taken[seed] = true;
    for (std::size_t i = 0; i < members.size(); ++i)
      for (const int next : graph[static_cast<std::size_t>(members[i])]) {
        const auto n = static_cast<std::size_t>(next);
        if (taken[n] || piece_of[n] != piece_of[seed]) continue;
        taken[n] = true;
        members.push_back(next);
      }
    parts.push_back(std::move(members));
  }
  return parts;
}

/// Ends of the runs of stations at mean distance `radius` [m] from the axis (1 for extruded blocks).
std::vector<int> station_runs(const SweptBlock& block, double radius, const AggregateOptions& options) {
  std::vector<int> ends;
  double begin = block.stations.front();
  int first = 0;
  for (int s = 1; s < block.station_count(); ++s) {
    const double at = block.stations[static_cast<std::size_t>(s)];
    const int stations = s - first;
    if (stations < options.least_across ||
        (stations < options.nodes_across && radius * (at - begin) < options.size))
      continue;
    ends.push_back(s);
    first = s;
    begin = at;
  }
  ends.push_back(block.station_count());
  return ends;
}

}  // namespace

Aggregates::Aggregates(const Mesh& mesh, const AlignedVector<double>& free, const AggregateOptions& options)
    : of_slot_(static_cast<std::size_t>(mesh.slots), -1) {
  for (const SweptBlock& block : mesh.blocks)
    for (const auto& part : section_parts(block.section, options)) {
      double radius = 1;
      if (block.sweep == Sweep::revolved) {
        radius = 0;
        for (const int node : part) radius += block.section.q[static_cast<std::size_t>(node)];
        radius /= static_cast<double>(part.size());
      }
      int first = 0;
      for (const int last : station_runs(block, radius, options)) {
        add_patch(block, part, first, last, free);
        first = last;
      }
    }
}

void Aggregates::add_patch(const SweptBlock& block, const std::vector<int>& part, int first_station,
                           int last_station, const AlignedVector<double>& free) {
  Patch patch;
  patch.first_node = static_cast<std::int64_t>(nodes_.size());
  Vec3 centre;
  for (int station = first_station; station < last_station; ++station) {
    const bool revolved = block.sweep == Sweep::revolved;
    const double angle = revolved ? block.stations[static_cast<std::size_t>(station)] : 0;
    for (const int section_node : part) {
      const std::int64_t slot = block.base + block.slot(section_node, station);
      int bits = 0;
      for (int c = 0; c < 3; ++c)
        if (free[static_cast<std::size_t>(dof(slot, c))] != 0) bits |= 1 << c;
      if (bits == 0) continue;
      const Vec3 at = position(block, section_node, station);
      centre += at;
      nodes_.push_back({{at.x, at.y, at.z},
                        std::cos(angle),
                        std::sin(angle),
                        static_cast<std::int32_t>(slot),
                        static_cast<std::int16_t>(bits),
                        static_cast<std::int16_t>(revolved)});
      of_slot_[static_cast<std::size_t>(slot)] = count();
    }
  }
  patch.last_node = static_cast<std::int64_t>(nodes_.size());
  if (patch.first_node == patch.last_node) return;
  centre = (1.0 / static_cast<double>(patch.last_node - patch.first_node)) * centre;
  for (std::int64_t i = patch.first_node; i < patch.last_node; ++i)
    for (int c = 0; c < 3; ++c) nodes_[static_cast<std::size_t>(i)].offset[c] -= centre[c];
  orthonormalise(patch);
  patches_.push_back(patch);
}

/// Displacement of each local component under the six rigid motions; zero rows where it is not free.
std::array<Aggregates::Rigid, 3> Aggregates::rigid_rows(const Node& node) {
  const double c = node.cosine, s = node.sine;
  const Vec3 offset{node.offset[0], node.offset[1], node.offset[2]};
  const std::array<Vec3, 3> axes = node.revolved ? std::array<Vec3, 3>{{{-c, 0, s}, {0, 1, 0}, {-s, 0, -c}}}
                                                 : std::array<Vec3, 3>{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  std::array<Rigid, 3> rows = {};
  for (std::size_t i = 0; i < 3; ++i) {
    if (!(node.free >> i & 1)) continue;
    const Vec3 turn = cross(offset, axes[i]);  // axis . (omega x offset) = omega . (offset x axis)
    rows[i] = {axes[i].x, axes[i].y, axes[i].z, turn.x, turn.y, turn.z};
  }
  return rows;
}

void Aggregates::orthonormalise(Patch& patch) {
  Eigen::Matrix<double, 6, 6> gram = Eigen::Matrix<double, 6, 6>::Zero();
  double extent = 0;
  for (std::int64_t i = patch.first_node; i < patch.last_node; ++i) {
    const Node& node = nodes_[static_cast<std::size_t>(i)];
    for (const double value : node.offset) extent = std::max(extent, std::abs(value));
    for (const Rigid& row : rigid_rows(node)) {
      const Eigen::Map<const Eigen::Matrix<double, 6, 1>> v(row.data());
      gram += v * v.transpose();
    }
  }
  // Rotations in units of the aggregate's extent, so that one threshold judges all motions.
  const double unit = extent > 0 ? 1 / extent : 1;
  Eigen::Matrix<double, 6, 1> scale;
  scale << 1, 1, 1, unit, unit, unit;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> eigen(scale.asDiagonal() * gram *
                                                                         scale.asDiagonal());
  constexpr double kSmallest = 1e-7;  // a motion below it is one of the others up to rounding
  patch.first_mode = modes_;
  for (int k = 5; k >= 0; --k) {
    const double value = eigen.eigenvalues()[k];
    if (value <= kSmallest * eigen.eigenvalues()[5]) break;
    auto& row = patch.basis[static_cast<std::size_t>(patch.mode_count++)];
    for (int i = 0; i < 6; ++i)
      row[static_cast<std::size_t>(i)] = scale[i] * eigen.eigenvectors()(i, k) / std::sqrt(value);
  }
  modes_ += patch.mode_count;
}

std::array<double, 6> Aggregates::mode_row(std::int64_t unknown) const {
  const std::int64_t slot = unknown / (3 * kLanes) * kLanes + unknown % kLanes;
  const auto component = static_cast<std::size_t>(unknown / kLanes % 3);
  const Patch& patch = patches_[static_cast<std::size_t>(of_slot(slot))];
  const auto node = std::find_if(nodes_.begin() + patch.first_node, nodes_.begin() + patch.last_node,
                                 [&](const Node& n) { return n.slot == slot; });
  const Rigid row = rigid_rows(*node)[component];
  std::array<double, 6> values = {};
  for (std::size_t k = 0; k < 6; ++k)
    for (std::size_t i = 0; i < 6; ++i) values[k] += patch.basis[k][i] * row[i];
  return values;
}

void Aggregates::restrict_to_modes(const double* fine, double* coarse) const {
  parallel_ranges(count(), [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t a = first; a < last; ++a) {
      const Patch& patch = patches_[static_cast<std::size_t>(a)];
      Rigid sum = {};
      for (std::int64_t i = patch.first_node; i < patch.last_node; ++i) {
        const Node& node = nodes_[static_cast<std::size_t>(i)];
        double local[3];
        for (int c = 0; c < 3; ++c) local[c] = node.free >> c & 1 ? fine[dof(node.slot, c)] : 0;
        const double f[3] = {node.revolved ? -node.cosine * local[0] - node.sine * local[2] : local[0],
                             local[1],
                             node.revolved ? node.sine * local[0] - node.cosine * local[2] : local[2]};
        const double* x = node.offset;
        for (std::size_t c = 0; c < 3; ++c) sum[c] += f[c];
        sum[3] += x[1] * f[2] - x[2] * f[1];
        sum[4] += x[2] * f[0] - x[0] * f[2];
        sum[5] += x[0] * f[1] - x[1] * f[0];
      }
      for (int k = 0; k < patch.mode_count; ++k) {
        const Rigid& row = patch.basis[static_cast<std::size_t>(k)];
        double value = 0;
        for (std::size_t i = 0; i < 6; ++i) value += row[i] * sum[i];
        coarse[patch.first_mode + k] = value;
      }
    }
  });
}

void Aggregates::prolongate_add(const double* coarse, double* fine) const {
  parallel_ranges(count(), [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t a = first; a < last; ++a) {
      const Patch& patch = patches_[static_cast<std::size_t>(a)];
      Rigid m = {};
      for (int k = 0; k < patch.mode_count; ++k)
        for (std::size_t i = 0; i < 6; ++i)
          m[i] += coarse[patch.first_mode + k] * patch.basis[static_cast<std::size_t>(k)][i];
      for (std::int64_t i = patch.first_node; i < patch.last_node; ++i) {
        const Node& node = nodes_[static_cast<std::size_t>(i)];
        const double* x = node.offset;
        const double u[3] = {m[0] + m[4] * x[2] - m[5] * x[1], m[1] + m[5] * x[0] - m[3] * x[2],
                             m[2] + m[3] * x[1] - m[4] * x[0]};
        const double local[3] = {node.revolved ? -node.cosine * u[0] + node.sine * u[2] : u[0], u[1],
                                 node.revolved ? -node.sine * u[0] - node.cosine * u[2] : u[2]};
        for (int c = 0; c < 3; ++c)
          if (node.free >> c & 1) fine[dof(node.slot, c)] += local[c];
      }
    }
  });
}

}  // namespace tread
