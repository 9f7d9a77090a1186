#include "kernels/ties/tie.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "core/error.hpp"
#include "core/index.hpp"
#include "core/marks.hpp"
#include "core/parallel/parallel.hpp"
#include "kernels/lanes/tile_force.hpp"
#include "kernels/ties/tie_places.hpp"

namespace tread {

namespace {

/// Place of a secondary node on a primary face: two section nodes, two stations, fractions along both.
struct FacePoint {
  std::array<int, 2> section_node;
  std::array<int, 2> station;
  double across;  ///< fraction from section_node[0] to [1]
  double along;   ///< fraction from station[0] to [1]
};

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
  if (fine.sweep == Sweep::extruded) return;  // the nodes of a straight block lie there already
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

/// A station of the other block that has a share in an own station.
struct StationShare {
  int station;
  double share;
  double turn;  ///< turn from the other's basis to the own [rad]
};

/// Shares by station of either block.
struct SharesAlong {
  std::vector<std::vector<StationShare>> of_fine, of_coarse;
};

SharesAlong shares_along(const SweptBlock& fine, const SweptBlock& coarse) {
  SharesAlong shares;
  shares.of_fine.resize(fine.stations.size());
  shares.of_coarse.resize(coarse.stations.size());
  for (int station = 0; station < fine.station_count(); ++station) {
    const StationPoint along = locate_along(fine, station, coarse);
    const std::array<double, 2> share = {1 - along.fraction, along.fraction};
    for (std::size_t end = 0; end < 2; ++end) {
      if (share[end] == 0) continue;
      const int primary = along.station[end];
      const double turn = fine.sweep == Sweep::extruded
                              ? 0.0
                              : fine.stations[index(station)] - coarse.stations[index(primary)];
      shares.of_fine[index(station)].push_back({primary, share[end], turn});
      shares.of_coarse[index(primary)].push_back({station, share[end], -turn});
    }
  }
  return shares;
}

/// Throws if a node takes two sums: its value would depend on their order.
void require_one_sum_per_node(const TieSums& sums) {
  std::vector<std::int64_t> nodes;
  for (const TieSums::Item& item : sums.items)
    for (int n = 0; n < item.node_count; ++n)
      nodes.push_back(item.own + std::int64_t{3 * kLanes} * sums.nodes[item.first_node + index(n)].node);
  std::sort(nodes.begin(), nodes.end());
  if (std::adjacent_find(nodes.begin(), nodes.end()) != nodes.end())
    throw InputError("a node belongs to two ties; tie their blocks on lines without common nodes");
}

/// Section nodes of one side of a tie.
struct LinkedLine {
  std::size_t first_other, first_node;  ///< indices in TieSums
};

LinkedLine next_line(const TieSums& sums) {
  return {sums.others.size(), sums.nodes.size()};
}

/// Adds the tiles of `own`, whose section nodes from `line` on are linked to those of `other`.
void add_items(TieSums& sums, const LinkedLine& line, const SweptBlock& own, const SweptBlock& other,
               const std::vector<std::vector<StationShare>>& shares) {
  const auto place = [&](const SweptBlock& block, int station) {
    return dof(block.base + block.slot(0, station), 0);
  };
  for (const Tile& tile : own.tiles) {
    const auto begin = shares.begin() + tile.first_station;
    std::size_t most = 0;
    for (auto it = begin; it != begin + tile.stations; ++it) most = std::max(most, it->size());
    if (most == 0) continue;
    sums.items.push_back({place(own, tile.first_station), sums.stations.size(), static_cast<int>(most),
                          line.first_other, static_cast<int>(sums.others.size() - line.first_other),
                          line.first_node, static_cast<int>(sums.nodes.size() - line.first_node)});
    const auto any = std::find_if(begin, begin + tile.stations, [](const auto& of) { return !of.empty(); });
    for (std::size_t k = 0; k < most; ++k) {
      StationLink& link = sums.stations.emplace_back();
      for (int lane = 0; lane < kLanes; ++lane) {
        const bool linked = lane < tile.stations && !begin[lane].empty();
        const std::vector<StationShare>& of = linked ? begin[lane] : *any;
        const bool has_share = linked && k < of.size();
        const StationShare& share = has_share ? of[k] : of.front();  // is read without a share, too
        link.at[lane] = place(other, share.station);
        if (!has_share) continue;
        link.share[lane] = share.share;
        link.cosine[lane] = share.share * std::cos(share.turn);
        link.sine[lane] = share.share * std::sin(share.turn);
      }
    }
  }
}

/// Calls visit(own slot, other slot, weight) for every link with a weight.
template <class Visit>
void for_each_link(const TieSums& sums, const Visit& visit) {
  for (const TieSums::Item& item : sums.items)
    for (int n = 0; n < item.node_count; ++n)
      for (int lane = 0; lane < kLanes; ++lane)
        for (int k = 0; k < item.station_count; ++k) {
          const LinkedNode& node = sums.nodes[item.first_node + index(n)];
          const StationLink& station = sums.stations[item.first_station + index(k)];
          for (int i = node.first; i < node.last; ++i) {
            const NodeLink& link = sums.links[index(i)];
            const double weight = link.share * station.share[lane];
            if (weight > 0)
              visit(slot_of(item.own + lane) + std::int64_t{node.node} * kLanes,
                    slot_of(station.at[lane]) +
                        std::int64_t{sums.others[item.first_other + index(link.other)]} * kLanes,
                    weight);
          }
        }
}

/// Replaces the fields' values by the sums, or adds the sums to them. `some`: indices of items, null for all.
void sum_up(const TieSums& sums, const std::vector<std::size_t>* some, bool add,
            std::initializer_list<NodeField> fields) {
  const std::int64_t count = some != nullptr ? std::ssize(*some) : std::ssize(sums.items);
  parallel_ranges(count, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i) {
      const TieSums::Item& item = sums.items[some != nullptr ? (*some)[index(i)] : index(i)];
      TieTile tile;
      tile.own = item.own;
      tile.stations = sums.stations.data() + item.first_station;
      tile.station_count = item.station_count;
      tile.others = sums.others.data() + item.first_other;
      tile.other_count = item.other_count;
      tile.nodes = sums.nodes.data() + item.first_node;
      tile.node_count = item.node_count;
      tile.links = sums.links.data();
      for (const NodeField& field : fields)
        field.visit([&](auto* values) { tile_forces().front()->sum(tile, add, values); });
    }
  });
}

}  // namespace

Ties::Ties(const Mesh& mesh, const std::vector<TieSpec>& specs, const std::vector<FollowingNode>& tied)
    : nodes_(tied) {
  for (const TieSpec& spec : specs) join(mesh, spec);
  require_one_sum_per_node(to_secondary_);
  require_one_sum_per_node(to_primary_);
  list_slots(mesh.slots);
}

void Ties::list_slots(std::int64_t slots) {
  std::vector<bool> secondary(index(slots)), primary(index(slots));
  for_each_pair([&](std::int64_t follower, std::int64_t leader) {
    secondary[index(follower)] = true;
    primary[index(leader)] = true;
  });
  secondary_ = marked(secondary);
  primary_ = marked(primary);
  for (const std::int64_t slot : secondary_)
    if (primary[index(slot)])
      throw InputError("a node is both secondary and primary of a tie; tie its block on another line");
}

void Ties::join(const Mesh& mesh, const TieSpec& spec) {
  const SweptBlock& fine = mesh.blocks[index(spec.secondary)];
  const SweptBlock& coarse = mesh.blocks[index(spec.primary)];
  const auto& fine_path = path_of(fine, spec.secondary_path);
  const auto& coarse_path = path_of(coarse, spec.primary_path);
  const auto points = locate_in_section(fine, fine_path, coarse, coarse_path);
  for (const std::vector<int>* path : {&fine_path, &coarse_path})
    if (path->size() > index(kMostTiedNodes))
      throw InputError(
          fmt::format("tie of '{}' to '{}': {} section nodes on a line, at most {} are possible; make "
                      "the elements larger",
                      fine.name, coarse.name, path->size(), kMostTiedNodes));

  const SharesAlong shares = shares_along(fine, coarse);
  const LinkedLine fine_line = next_line(to_secondary_);
  const LinkedLine coarse_line = next_line(to_primary_);
  const auto across = [](const SectionPoint& point, std::size_t end) {
    return end == 0 ? 1 - point.fraction : point.fraction;
  };
  const auto add_node = [](TieSums& sums, int node, const std::vector<NodeLink>& links) {
    if (links.empty()) return;
    const int first = static_cast<int>(sums.links.size());
    sums.links.insert(sums.links.end(), links.begin(), links.end());
    sums.nodes.push_back({node, first, static_cast<int>(sums.links.size())});
  };
  const auto other_of = [](TieSums& sums, const LinkedLine& line, int node) {
    const auto begin = sums.others.begin() + static_cast<std::ptrdiff_t>(line.first_other);
    const auto known = std::find(begin, sums.others.end(), node);
    const int other = static_cast<int>(known - begin);
    if (known == sums.others.end()) sums.others.push_back(node);
    return other;
  };
  for (std::size_t i = 0; i < fine_path.size(); ++i) {
    std::vector<NodeLink> links;
    for (std::size_t end = 0; end < 2; ++end)
      if (across(points[i], end) > 0)
        links.push_back({other_of(to_secondary_, fine_line, points[i].node[end]), across(points[i], end)});
    add_node(to_secondary_, fine_path[i], links);
  }
  for (const int node : coarse_path) {
    std::vector<NodeLink> links;
    for (std::size_t i = 0; i < fine_path.size(); ++i)
      for (std::size_t end = 0; end < 2; ++end)
        if (points[i].node[end] == node && across(points[i], end) > 0)
          links.push_back({other_of(to_primary_, coarse_line, fine_path[i]), across(points[i], end)});
    add_node(to_primary_, node, links);
  }
  add_items(to_secondary_, fine_line, fine, coarse, shares.of_fine);
  add_items(to_primary_, coarse_line, coarse, fine, shares.of_coarse);
}

void Ties::for_each_pair(FunctionRef<void(std::int64_t, std::int64_t)> visit) const {
  const auto without_weight = [&](std::int64_t secondary, std::int64_t primary, double /*weight*/) {
    visit(secondary, primary);
  };
  for_each_link(to_secondary_, without_weight);
  nodes_.for_each(without_weight);
}

std::vector<TiedSlot> Ties::tied_slots() const {
  std::vector<TiedSlot> slots;
  for_each_pair([&](std::int64_t secondary, std::int64_t primary) { slots.push_back({secondary, primary}); });
  std::stable_sort(slots.begin(), slots.end(),
                   [](const TiedSlot& a, const TiedSlot& b) { return a.secondary < b.secondary; });
  return slots;
}

std::int64_t Ties::bytes() const {
  std::size_t sum = (secondary_.size() + primary_.size()) * sizeof(std::int64_t);
  for (const TieSums* sums : {&to_secondary_, &to_primary_})
    sum += sums->items.size() * sizeof(TieSums::Item) + sums->stations.size() * sizeof(sums->stations[0]) +
           sums->others.size() * sizeof(int) + sums->nodes.size() * sizeof(LinkedNode) +
           sums->links.size() * sizeof(sums->links[0]);
  return static_cast<std::int64_t>(sum) + nodes_.bytes();
}

TieItems Ties::items_in(const std::vector<unsigned char>& groups) const {
  const auto marked = [&](const TieSums& sums) {
    std::vector<std::size_t> items;
    for (std::size_t i = 0; i < sums.items.size(); ++i) {
      const TieSums::Item& item = sums.items[i];
      const auto nodes = std::span(sums.nodes).subspan(item.first_node, index(item.node_count));
      if (std::any_of(nodes.begin(), nodes.end(), [&](const LinkedNode& node) {
            return groups[index(slot_of(item.own) / kLanes + node.node)] != 0;
          }))
        items.push_back(i);
    }
    return items;
  };
  return {marked(to_secondary_), marked(to_primary_)};
}

void Ties::follow(std::initializer_list<NodeField> fields, const TieItems* some) const {
  sum_up(to_secondary_, some != nullptr ? &some->to_secondary : nullptr, false, fields);
  if (some == nullptr)
    for (const NodeField& field : fields) nodes_.follow(field);
}

void Ties::hand_over(NodeField force, const TieItems* some) const {
  sum_up(to_primary_, some != nullptr ? &some->to_primary : nullptr, true, {force});
  if (some == nullptr) nodes_.hand_over(force);
}

void Ties::gather(double* force) const {
  hand_over(force);
  clear(force);
}

void Ties::clear(double* field) const {
  parallel_ranges(secondary_count(), [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i)
      for (int c = 0; c < 3; ++c) field[dof(secondary_[index(i)], c)] = 0;
  });
}

void Ties::gather_diagonal(double* diagonal) const {
  const auto gather = [&](std::int64_t secondary, std::int64_t primary, double weight) {
    for (int c = 0; c < 3; ++c) diagonal[dof(primary, c)] += weight * weight * diagonal[dof(secondary, c)];
  };
  for_each_link(to_primary_, [&](std::int64_t primary, std::int64_t secondary, double weight) {
    gather(secondary, primary, weight);
  });
  nodes_.for_each(gather);
  for (const std::int64_t slot : secondary_)
    for (int c = 0; c < 3; ++c) diagonal[dof(slot, c)] = 0;
}

void Ties::gather_mass(double* mass) const {
  const auto gather = [&](std::int64_t secondary, std::int64_t primary, double weight) {
    mass[primary] += weight * mass[secondary];
  };
  for_each_link(to_primary_, [&](std::int64_t primary, std::int64_t secondary, double weight) {
    gather(secondary, primary, weight);
  });
  nodes_.for_each(gather);
  for (const std::int64_t slot : secondary_) mass[slot] = 0;
}

}  // namespace tread
