#include "kernels/tie.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "kernels/lanes/tile_force.hpp"

namespace tread {

namespace {

/// Where a secondary node sits on a primary face: two section nodes, two stations, fractions along both.
struct FacePoint {
  std::array<int, 2> section_node;
  std::array<int, 2> station;
  double across;  ///< fraction from section_node[0] to [1]
  double along;   ///< fraction from station[0] to [1]
};

/// Primary section edge under each secondary section node.
struct SectionPoint {
  std::array<int, 2> node;
  double fraction;
};

std::vector<SectionPoint> locate_in_section(const SweptBlock& fine, const std::vector<int>& fine_path,
                                            const SweptBlock& coarse, const std::vector<int>& coarse_path) {
  std::vector<SectionPoint> points;
  for (const int node : fine_path) {
    const double p = fine.section.p[static_cast<std::size_t>(node)];
    const double q = fine.section.q[static_cast<std::size_t>(node)];
    SectionPoint best{{-1, -1}, 0};
    double distance = 1e30;
    for (std::size_t i = 0; i + 1 < coarse_path.size(); ++i) {
      const auto a = static_cast<std::size_t>(coarse_path[i]);
      const auto b = static_cast<std::size_t>(coarse_path[i + 1]);
      const double dp = coarse.section.p[b] - coarse.section.p[a];
      const double dq = coarse.section.q[b] - coarse.section.q[a];
      const double length2 = dp * dp + dq * dq;
      const double fraction =
          std::clamp(((p - coarse.section.p[a]) * dp + (q - coarse.section.q[a]) * dq) / length2, 0.0, 1.0);
      const double off =
          std::hypot(coarse.section.p[a] + fraction * dp - p, coarse.section.q[a] + fraction * dq - q);
      if (off < distance) {
        distance = off;
        best = {{coarse_path[i], coarse_path[i + 1]}, fraction};
      }
    }
    if (distance > 1e-9)
      throw InputError(
          fmt::format("tie of '{}' to '{}': section node {} at ({:.6f}, {:.6f}) m lies {:.3e} m off the "
                      "coarse line; make both lines coincide",
                      fine.name, coarse.name, node, p, q, distance));
    if (best.fraction < 1e-9) best.fraction = 0;
    if (best.fraction > 1 - 1e-9) best.fraction = 1;
    points.push_back(best);
  }
  return points;
}

struct StationPoint {
  std::array<int, 2> station;
  double fraction;
};

StationPoint locate_along(const SweptBlock& fine, int station, const SweptBlock& coarse) {
  constexpr double turn = 2 * std::numbers::pi;
  constexpr double tolerance = 1e-9;
  double at = fine.stations[static_cast<std::size_t>(station)];
  const double first = coarse.stations.front();
  if (coarse.closed) at = first + std::fmod(std::fmod(at - first, turn) + turn, turn);
  if (coarse.closed && first + turn - at < tolerance) at = first;
  const auto above = std::upper_bound(coarse.stations.begin(), coarse.stations.end(), at + tolerance);
  int j = static_cast<int>(above - coarse.stations.begin()) - 1;
  const int count = coarse.station_count();
  if (!coarse.closed && j == count - 1 && at < coarse.stations.back() + tolerance) j = count - 2;
  if (j < 0 || (!coarse.closed && j >= count - 1))
    throw InputError(fmt::format("tie of '{}' to '{}': station {} at {:.6f} lies beyond the coarse block",
                                 fine.name, coarse.name, station, at));
  const int next = j + 1 < count ? j + 1 : 0;
  const double span = next > 0 ? coarse.stations[static_cast<std::size_t>(next)] : first + turn;
  const double here = coarse.stations[static_cast<std::size_t>(j)];
  double fraction = (at - here) / (span - here);
  if (fraction < tolerance) fraction = 0;
  if (fraction > 1 - tolerance) fraction = 1;
  return {{j, next}, fraction};
}

const std::vector<int>& path_of(const SweptBlock& block, const std::string& name) {
  const auto found = block.section.paths.find(name);
  if (found == block.section.paths.end())
    throw InputError(fmt::format("block '{}' has no section path '{}' to tie", block.name, name));
  return found->second;
}

template <class Visit>
void for_each_secondary(const Mesh& mesh, const TieSpec& spec, Visit visit) {
  const SweptBlock& fine = mesh.blocks[static_cast<std::size_t>(spec.secondary)];
  const SweptBlock& coarse = mesh.blocks[static_cast<std::size_t>(spec.primary)];
  const auto& fine_path = path_of(fine, spec.secondary_path);
  const auto across = locate_in_section(fine, fine_path, coarse, path_of(coarse, spec.primary_path));
  for (int station = 0; station < fine.station_count(); ++station) {
    const StationPoint along = locate_along(fine, station, coarse);
    for (std::size_t i = 0; i < fine_path.size(); ++i)
      visit(fine_path[i], station,
            FacePoint{across[i].node, along.station, across[i].fraction, along.fraction});
  }
}

double face_weight(const FacePoint& face, int corner) {
  const double across = corner % 2 == 0 ? 1 - face.across : face.across;
  const double along = corner / 2 == 0 ? 1 - face.along : face.along;
  return across * along;
}

}  // namespace

void place_on_chords(Mesh& mesh, const TieSpec& spec) {
  SweptBlock& fine = mesh.blocks[static_cast<std::size_t>(spec.secondary)];
  const SweptBlock& coarse = mesh.blocks[static_cast<std::size_t>(spec.primary)];
  if (fine.sweep == Sweep::extruded) return;  // straight: the nodes lie there already
  for_each_secondary(mesh, spec, [&](int node, int station, const FacePoint& face) {
    Vec3 target;
    for (int corner = 0; corner < 4; ++corner)
      target += face_weight(face, corner) * position(coarse,
                                                     face.section_node[static_cast<std::size_t>(corner % 2)],
                                                     face.station[static_cast<std::size_t>(corner / 2)]);
    const Vec3 shift = to_local(fine, station, 0, target - position(fine, node, station));
    if (norm(shift) > 1e-12) fine.node_shift[fine.slot(node, station)] += shift;
  });
}

namespace {

std::size_t index(std::int64_t i) {
  return static_cast<std::size_t>(i);
}

/// A station of the other block that has a share in one of the own.
struct StationShare {
  int station;
  double share;
  double turn;  ///< from the other's basis to the own [rad]
};

/// Links of the own stations in lanes; by own tile.
void add_items(TieSide& side, const SweptBlock& own, const SweptBlock& other,
               const std::vector<std::vector<StationShare>>& shares) {
  const auto first_node = [&](const SweptBlock& block, int station) {
    return dof(block.base + block.slot(0, station), 0);
  };
  for (const Tile& tile : own.tiles) {
    const auto begin = shares.begin() + tile.first_station;
    std::size_t most = 0;
    for (auto it = begin; it != begin + tile.stations; ++it) most = std::max(most, it->size());
    if (most == 0) continue;
    side.items.push_back({first_node(own, tile.first_station), side.stations.size(), static_cast<int>(most)});
    for (std::size_t k = 0; k < most; ++k) {
      StationLink<double>& link = side.stations.emplace_back();
      std::fill_n(link.at, kLanes, first_node(other, 0));  // without a share any will do
      for (int lane = 0; lane < tile.stations; ++lane) {
        if (k >= begin[lane].size()) continue;
        const StationShare& share = begin[lane][k];
        link.at[lane] = first_node(other, share.station);
        link.share[lane] = share.share;
        link.cosine[lane] = std::cos(share.turn);
        link.sine[lane] = std::sin(share.turn);
      }
    }
  }
}

std::int64_t slot_of(std::int64_t unknown) {
  return unknown / (3 * kLanes) * kLanes + unknown % kLanes;
}

/// visit(own slot, other slot, weight) for every link with a weight.
template <class Visit>
void for_each_link(const TieSide& side, const Visit& visit) {
  for (const TieSide::Item& item : side.items)
    for (const LinkedNode& node : side.nodes)
      for (int lane = 0; lane < kLanes; ++lane)
        for (int k = 0; k < item.station_count; ++k)
          for (int i = node.first; i < node.last; ++i) {
            const StationLink<double>& station = side.stations[item.first_station + index(k)];
            const NodeLink<double>& link = side.links[index(i)];
            const double weight = link.share * station.share[lane];
            if (weight > 0)
              visit(slot_of(item.own + lane) + std::int64_t{node.node} * kLanes,
                    slot_of(station.at[lane]) + std::int64_t{link.node} * kLanes, weight);
          }
}

/// Adds to the field's values, or replaces them.
void sum_up(const std::vector<TieSide>& sides, bool add, std::initializer_list<double*> fields) {
  for (const TieSide& side : sides)
    parallel_ranges(static_cast<std::int64_t>(side.items.size()), [&](std::int64_t first, std::int64_t last) {
      for (std::int64_t i = first; i < last; ++i) {
        const TieSide::Item& item = side.items[index(i)];
        TieTile<double> tile;
        tile.own = item.own;
        tile.stations = side.stations.data() + item.first_station;
        tile.station_count = item.station_count;
        tile.nodes = side.nodes.data();
        tile.node_count = static_cast<int>(side.nodes.size());
        tile.links = side.links.data();
        for (double* field : fields) tile_forces().front()->tie_in_double(tile, add, field);
      }
    });
}

}  // namespace

Ties::Ties(const Mesh& mesh, const std::vector<TieSpec>& specs) {
  for (const TieSpec& spec : specs) join(mesh, spec);
  for (const TieSide& side : to_secondary_)
    for_each_link(side, [&](std::int64_t secondary, std::int64_t primary, double /*weight*/) {
      secondary_.push_back(secondary);
      primary_.push_back(primary);
    });
  for (std::vector<std::int64_t>* slots : {&secondary_, &primary_}) {
    std::sort(slots->begin(), slots->end());
    slots->erase(std::unique(slots->begin(), slots->end()), slots->end());
  }
  for (const std::int64_t slot : secondary_)
    if (std::binary_search(primary_.begin(), primary_.end(), slot))
      throw InputError("a node is both secondary and primary of a tie; tie its block on another line");
}

void Ties::join(const Mesh& mesh, const TieSpec& spec) {
  const SweptBlock& fine = mesh.blocks[index(spec.secondary)];
  const SweptBlock& coarse = mesh.blocks[index(spec.primary)];
  const auto& fine_path = path_of(fine, spec.secondary_path);
  const auto& coarse_path = path_of(coarse, spec.primary_path);
  const auto points = locate_in_section(fine, fine_path, coarse, coarse_path);

  std::vector<std::vector<StationShare>> of_fine(fine.stations.size());
  std::vector<std::vector<StationShare>> of_coarse(coarse.stations.size());
  for (int station = 0; station < fine.station_count(); ++station) {
    const StationPoint along = locate_along(fine, station, coarse);
    const std::array<double, 2> share = {1 - along.fraction, along.fraction};
    for (std::size_t end = 0; end < 2; ++end) {
      if (share[end] == 0) continue;
      const int primary = along.station[end];
      const double turn = fine.sweep == Sweep::extruded
                              ? 0.0
                              : fine.stations[index(station)] - coarse.stations[index(primary)];
      of_fine[index(station)].push_back({primary, share[end], turn});
      of_coarse[index(primary)].push_back({station, share[end], -turn});
    }
  }

  TieSide& follow = to_secondary_.emplace_back();
  TieSide& gather = to_primary_.emplace_back();
  add_items(follow, fine, coarse, of_fine);
  add_items(gather, coarse, fine, of_coarse);
  const auto across = [](const SectionPoint& point, std::size_t end) {
    return end == 0 ? 1 - point.fraction : point.fraction;
  };
  const auto add_node = [](TieSide& side, int node, const std::vector<NodeLink<double>>& links) {
    if (links.empty()) return;
    const int first = static_cast<int>(side.links.size());
    side.links.insert(side.links.end(), links.begin(), links.end());
    side.nodes.push_back({node, first, static_cast<int>(side.links.size())});
  };
  for (std::size_t i = 0; i < fine_path.size(); ++i) {
    std::vector<NodeLink<double>> links;
    for (std::size_t end = 0; end < 2; ++end)
      if (across(points[i], end) > 0) links.push_back({points[i].node[end], across(points[i], end)});
    add_node(follow, fine_path[i], links);
  }
  for (const int node : coarse_path) {
    std::vector<NodeLink<double>> links;
    for (std::size_t i = 0; i < fine_path.size(); ++i)
      for (std::size_t end = 0; end < 2; ++end)
        if (points[i].node[end] == node && across(points[i], end) > 0)
          links.push_back({fine_path[i], across(points[i], end)});
    add_node(gather, node, links);
  }
}

std::vector<TiedSlot> Ties::tied_slots() const {
  std::vector<TiedSlot> slots;
  for (const TieSide& side : to_secondary_)
    for_each_link(side, [&](std::int64_t secondary, std::int64_t primary, double /*weight*/) {
      if (slots.empty() || slots.back().secondary != secondary) slots.push_back({secondary, {}});
      slots.back().primaries.push_back(primary);
    });
  return slots;
}

std::int64_t Ties::bytes() const {
  std::size_t sum = (secondary_.size() + primary_.size()) * sizeof(std::int64_t);
  for (const auto* sides : {&to_secondary_, &to_primary_})
    for (const TieSide& side : *sides)
      sum += side.items.size() * sizeof(TieSide::Item) + side.stations.size() * sizeof(side.stations[0]) +
             side.nodes.size() * sizeof(LinkedNode) + side.links.size() * sizeof(side.links[0]);
  return static_cast<std::int64_t>(sum);
}

void Ties::follow(std::initializer_list<double*> fields) const {
  sum_up(to_secondary_, false, fields);
}

void Ties::hand_over(double* force) const {
  sum_up(to_primary_, true, {force});
}

void Ties::gather(double* force) const {
  hand_over(force);
  for (const std::int64_t slot : secondary_)
    for (int c = 0; c < 3; ++c) force[dof(slot, c)] = 0;
}

void Ties::gather_diagonal(double* diagonal) const {
  for (const TieSide& side : to_primary_)
    for_each_link(side, [&](std::int64_t primary, std::int64_t secondary, double weight) {
      for (int c = 0; c < 3; ++c) diagonal[dof(primary, c)] += weight * weight * diagonal[dof(secondary, c)];
    });
  for (const std::int64_t slot : secondary_)
    for (int c = 0; c < 3; ++c) diagonal[dof(slot, c)] = 0;
}

void Ties::gather_mass(double* mass) const {
  for (const TieSide& side : to_primary_)
    for_each_link(side, [&](std::int64_t primary, std::int64_t secondary, double weight) {
      mass[primary] += weight * mass[secondary];
    });
  for (const std::int64_t slot : secondary_) mass[slot] = 0;
}

}  // namespace tread
