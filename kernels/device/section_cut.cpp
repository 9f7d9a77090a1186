#include "kernels/device/section_cut.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>

#include "core/index.hpp"

namespace tread {

namespace {

constexpr std::uint32_t kMostPlaces = (1U << 27) - 1;  ///< of MarchQuad

/// Divides a list of quads into a number of parts of one size, by halving it again and again.
void divide(const std::vector<std::array<double, 2>>& centre, std::span<int> quads, std::size_t number,
            std::vector<std::span<int>>& parts) {
  if (number == 1) {
    parts.push_back(quads);
    return;
  }
  std::array<double, 2> extent{};
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const auto [low, high] = std::minmax_element(quads.begin(), quads.end(), [&](int a, int b) {
      return centre[index(a)][axis] < centre[index(b)][axis];
    });
    extent[axis] = centre[index(*high)][axis] - centre[index(*low)][axis];
  }
  const std::size_t axis = extent[0] >= extent[1] ? 0 : 1;
  std::sort(quads.begin(), quads.end(), [&](int a, int b) {
    const double x = centre[index(a)][axis];
    const double y = centre[index(b)][axis];
    return x != y ? x < y : a < b;
  });
  const std::size_t half = number / 2;
  const std::size_t first = quads.size() * half / number;
  divide(centre, quads.first(first), half, parts);
  divide(centre, quads.subspan(first), number - half, parts);
}

/// Colours of the quads by their place: each the first that no quad before it has which shares a node. They
/// do not depend on the cut, so that sums at a node by colour do not either.
std::vector<int> colours_of(const Section& section, const FrontPlan& plan) {
  std::vector<int> colours;
  std::vector<std::uint64_t> taken(index(section.nodes()), 0);
  for (const FrontPlan::Quad& entry : plan.quads) {
    std::uint64_t seen = 0;
    for (const int node : section.quads[index(entry.quad)]) seen |= taken[index(node)];
    const int colour = std::countr_one(seen);
    for (const int node : section.quads[index(entry.quad)]) taken[index(node)] |= std::uint64_t{1} << colour;
    colours.push_back(colour);
  }
  return colours;
}

/// Quads of a colour that a card reads at once: those of a warp.
constexpr int kAtOnce = 4;

/// New numbers of a part's nodes, so that those which a card reads at once lie in different banks
/// [kNodeStride]: at each corner, quads that it takes at once have numbers that differ modulo kAtOnce, pairs
/// of them modulo 2. One node after the other gets the best number that is left, so a few do not differ.
class PartNumbers {
 public:
  PartNumbers(const SectionCut& cut, std::size_t part) : number_(index(cut.parts[part].nodes), -1) {
    const MarchPart& of = cut.parts[part];
    const MarchQuad* const quads = cut.quads.data() + of.first_quad;
    const int* const first = cut.first_of_colour.data() + part * index(cut.colours + 1);
    std::vector<std::vector<Peer>> peers(number_.size());
    for (int c = 0; c < cut.colours; ++c)
      for (int q = first[c]; q < first[c + 1]; ++q) {
        const int begin = q - (q - first[c]) % kAtOnce;
        for (int other = begin; other < std::min(begin + kAtOnce, first[c + 1]); ++other)
          for (int corner = 0; corner < 4 && other != q; ++corner)
            peers[quads[q].node[corner]].push_back(
                {quads[other].node[corner], (q - begin) / 2 == (other - begin) / 2});
      }
    Left of_own;
    Left of_others;
    for (int i = of.nodes; i-- > 0;) (i < of.own_nodes ? of_own : of_others)[index(i % kAtOnce)].push_back(i);
    for (int q = 0; q < of.quads; ++q)
      for (const int node : quads[q].node)
        if (number_[index(node)] < 0)
          number_[index(node)] = best(peers[index(node)], node < of.own_nodes ? of_own : of_others);
  }

  int operator()(int node) const { return number_[index(node)]; }

 private:
  /// A node that is read at once with another.
  struct Peer {
    int node;
    bool beside;  ///< where a value has 8 bytes, too
  };
  /// Numbers that are left, by their rest modulo kAtOnce.
  using Left = std::array<std::vector<int>, kAtOnce>;

  int best(const std::vector<Peer>& peers, Left& left) const {
    std::array<int, kAtOnce> cost{};
    for (const Peer& peer : peers) {
      const int number = number_[index(peer.node)];
      if (number < 0) continue;
      for (int rest = 0; rest < kAtOnce; ++rest) {
        if (number % kAtOnce == rest) ++cost[index(rest)];
        if (peer.beside && number % 2 == rest % 2) cost[index(rest)] += 2;
      }
    }
    std::vector<int>* chosen = nullptr;
    int least = 0;
    for (int rest = 0; rest < kAtOnce; ++rest) {
      std::vector<int>& of = left[index(rest)];
      if (of.empty() ||
          (chosen != nullptr && std::pair(cost[index(rest)], chosen->size()) >= std::pair(least, of.size())))
        continue;
      chosen = &of;
      least = cost[index(rest)];
    }
    const int number = chosen->back();
    chosen->pop_back();
    return number;
  }

  std::vector<int> number_;  ///< by node
};

void spread_over_banks(SectionCut& cut) {
  for (std::size_t part = 0; part < cut.parts.size(); ++part) {
    const PartNumbers number(cut, part);
    const MarchPart& of = cut.parts[part];
    const std::span nodes = std::span(cut.nodes).subspan(index(of.first_node), index(of.nodes));
    const std::vector<int> before(nodes.begin(), nodes.end());
    for (int node = 0; node < of.nodes; ++node) nodes[index(number(node))] = before[index(node)];
    for (MarchQuad& quad : std::span(cut.quads).subspan(index(of.first_quad), index(of.quads)))
      for (std::uint16_t& node : quad.node) node = static_cast<std::uint16_t>(number(node));
  }
}

/// Cuts a section into a number of parts.
SectionCut cut_into(const Section& section, const FrontPlan& plan, const std::vector<int>& moved,
                    int number) {
  std::vector<std::array<double, 2>> centre;
  for (const FrontPlan::Quad& entry : plan.quads) {
    std::array<double, 2>& at = centre.emplace_back();
    for (const int node : section.quads[index(entry.quad)]) {
      at[0] += section.p[index(node)] / 4;
      at[1] += section.q[index(node)] / 4;
    }
  }
  std::vector<int> places(plan.quads.size());
  std::iota(places.begin(), places.end(), 0);
  std::vector<std::span<int>> spans;
  divide(centre, places, index(number), spans);

  const auto corners_of = [&](int place) -> const std::array<int, 4>& {
    return section.quads[index(plan.quads[index(place)].quad)];
  };
  std::vector<int> part_of_quad(plan.quads.size());
  std::vector<int> owner(index(section.nodes()), -1);
  std::vector<std::vector<int>> places_at(index(section.nodes()));
  for (std::size_t part = 0; part < spans.size(); ++part)
    for (const int place : spans[part]) {
      part_of_quad[index(place)] = static_cast<int>(part);
      for (const int node : corners_of(place))
        if (owner[index(node)] < 0) owner[index(node)] = static_cast<int>(part);
    }
  for (int place = 0; place < static_cast<int>(plan.quads.size()); ++place)
    for (const int node : corners_of(place)) places_at[index(node)].push_back(place);

  const std::vector<int> colour = colours_of(section, plan);
  SectionCut cut;
  cut.colours = 1 + *std::max_element(colour.begin(), colour.end());
  for (int part = 0; part < static_cast<int>(spans.size()); ++part) {
    MarchPart& at = cut.parts.emplace_back();
    at.first_node = static_cast<int>(cut.nodes.size());
    at.first_quad = static_cast<int>(cut.quads.size());
    std::vector<int> quads(spans[index(part)].begin(), spans[index(part)].end());
    std::vector<int> local(index(section.nodes()), -1);
    const auto add_node = [&](int node) {
      if (local[index(node)] >= 0) return;
      local[index(node)] = static_cast<int>(cut.nodes.size()) - at.first_node;
      cut.nodes.push_back(node);
    };
    for (int node = 0; node < section.nodes(); ++node)
      if (owner[index(node)] == part) {
        add_node(node);
        quads.insert(quads.end(), places_at[index(node)].begin(), places_at[index(node)].end());
      }
    at.own_nodes = static_cast<int>(cut.nodes.size()) - at.first_node;
    const auto order = [&](int a) {
      return std::tuple(colour[index(a)], moved.empty() ? 0 : moved[index(a)], a);
    };
    std::sort(quads.begin(), quads.end(), [&](int a, int b) { return order(a) < order(b); });
    quads.erase(std::unique(quads.begin(), quads.end()), quads.end());
    at.quads = static_cast<int>(quads.size());
    std::vector<char> begun(index(section.nodes()), 0);
    for (const int place : quads) {
      MarchQuad quad{};
      quad.place = static_cast<unsigned>(place) & kMostPlaces;
      quad.own = part_of_quad[index(place)] == part ? 1 : 0;
      for (unsigned corner = 0; corner < 4; ++corner) {
        const int node = corners_of(place)[corner];
        add_node(node);
        quad.node[corner] = static_cast<std::uint16_t>(local[index(node)]);
        if (std::exchange(begun[index(node)], 1) == 0) quad.begins |= 1U << corner;
      }
      cut.quads.push_back(quad);
    }
    for (int c = 0; c <= cut.colours; ++c) {
      const auto before = [&](int place) { return colour[index(place)] < c; };
      cut.first_of_colour.push_back(static_cast<int>(std::count_if(quads.begin(), quads.end(), before)));
    }
    at.nodes = static_cast<int>(cut.nodes.size()) - at.first_node;
  }
  return cut;
}

/// Time of a tile over all parts, by the rounds of a team: elements of a colour, then nodes, which take half
/// as long.
int rounds(const SectionCut& cut, int threads) {
  const auto taken = [&](int items) { return (kLanes * items + threads - 1) / threads; };
  int sum = 0;
  for (std::size_t part = 0; part < cut.parts.size(); ++part) {
    const int* const first = cut.first_of_colour.data() + part * index(cut.colours + 1);
    for (int c = 0; c < cut.colours; ++c) sum += 2 * taken(first[c + 1] - first[c]);
    sum += taken(cut.parts[part].nodes);
  }
  return sum;
}

}  // namespace

SectionCut cut_section(const Section& section, const FrontPlan& plan, const MarchCut& sizes,
                       const std::vector<int>& moved) {
  const int quads = static_cast<int>(plan.quads.size());
  const int fewest = (quads + sizes.part_quads - 1) / std::max(1, sizes.part_quads);
  SectionCut best = cut_into(section, plan, moved, fewest);
  for (int number = fewest + 1; number <= std::min(2 * fewest, quads); ++number) {
    SectionCut cut = cut_into(section, plan, moved, number);
    if (rounds(cut, sizes.threads) < rounds(best, sizes.threads)) best = std::move(cut);
  }
  spread_over_banks(best);
  return best;
}

}  // namespace tread
