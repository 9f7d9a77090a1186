#include "kernels/solver/aggregate_parts.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <span>
#include <utility>

#include "core/mesh/bisection.hpp"

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

}  // namespace

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

double mean_radius(const SweptBlock& block, const std::vector<int>& nodes) {
  if (block.sweep != Sweep::revolved) return 1;
  double sum = 0;
  for (const int node : nodes) sum += block.section.q[static_cast<std::size_t>(node)];
  return sum / static_cast<double>(nodes.size());
}

namespace {

/// Halves a body's nodes across the longest side of their box until they are close together and few enough.
void cut_body(const HexBody& body, std::span<std::int32_t> nodes, const AggregateOptions& options,
              std::vector<std::vector<std::int32_t>>& parts) {
  const auto at = [&](std::int32_t node) -> const Vec3& {
    return body.mesh.nodes[static_cast<std::size_t>(node)];
  };
  const LongestSide side = longest_side(nodes, at);
  const auto cube = [](int n) { return static_cast<std::size_t>(n * n * n); };
  const bool wide = side.length > options.size && nodes.size() >= 2 * cube(options.least_across);
  if (!wide && nodes.size() <= cube(options.nodes_across)) {
    parts.emplace_back(nodes.begin(), nodes.end());
    return;
  }
  const std::size_t half = nodes.size() / 2;
  part_along(nodes, half, side.axis, at);
  cut_body(body, nodes.first(half), options, parts);
  cut_body(body, nodes.subspan(half), options, parts);
}

}  // namespace

std::vector<std::vector<std::int32_t>> body_parts(const HexBody& body, const AggregateOptions& options) {
  std::vector<std::int32_t> all(body.mesh.nodes.size());
  std::iota(all.begin(), all.end(), 0);
  std::vector<std::vector<std::int32_t>> parts;
  if (!all.empty()) cut_body(body, all, options, parts);
  return parts;
}

}  // namespace tread
