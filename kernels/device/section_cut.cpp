#include "kernels/device/section_cut.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
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

/// Cuts a section into a number of parts.
SectionCut cut_into(const Section& section, const FrontPlan& plan, int number) {
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
    std::sort(quads.begin(), quads.end(),
              [&](int a, int b) { return std::pair(colour[index(a)], a) < std::pair(colour[index(b)], b); });
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

SectionCut cut_section(const Section& section, const FrontPlan& plan, const MarchCut& sizes) {
  const int quads = static_cast<int>(plan.quads.size());
  const int fewest = (quads + sizes.part_quads - 1) / std::max(1, sizes.part_quads);
  SectionCut best = cut_into(section, plan, fewest);
  for (int number = fewest + 1; number <= std::min(2 * fewest, quads); ++number) {
    SectionCut cut = cut_into(section, plan, number);
    if (rounds(cut, sizes.threads) < rounds(best, sizes.threads)) best = std::move(cut);
  }
  return best;
}

}  // namespace tread
