// Cut of a section into the parts of a march's teams.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>
#include <span>
#include <vector>

#include "core/index.hpp"
#include "kernels/device/section_cut.hpp"
#include "tests/swept_samples.hpp"

namespace tread {
namespace {

Section section_of_squares() {
  return samples::grid_section({.columns = 23, .rows = 17, .width = 0.23, .height = 0.17, .jitter = 0});
}

std::span<const MarchQuad> quads_of(const SectionCut& cut, const MarchPart& part) {
  return std::span(cut.quads).subspan(index(part.first_quad), index(part.quads));
}
std::span<const int> nodes_of(const SectionCut& cut, const MarchPart& part) {
  return std::span(cut.nodes).subspan(index(part.first_node), index(part.nodes));
}

/// Calls visit(quads of a colour) for each part and colour.
template <class Visit>
void for_each_colour(const SectionCut& cut, const Visit& visit) {
  for (std::size_t part = 0; part < cut.parts.size(); ++part)
    for (int colour = 0; colour < cut.colours; ++colour) {
      const int* const first = cut.first_of_colour.data() + part * index(cut.colours + 1) + colour;
      visit(quads_of(cut, cut.parts[part]).subspan(index(first[0]), index(first[1] - first[0])));
    }
}

TEST(SectionCut, PartsHoldTheSection) {
  const Section section = section_of_squares();
  const FrontPlan plan = make_front_plan(section);
  const SectionCut cut = cut_section(section, plan, {192, 90, 4});
  ASSERT_GT(cut.parts.size(), 3U);
  std::multiset<int> owned;
  for (const MarchPart& part : cut.parts) {
    const std::span<const int> nodes = nodes_of(cut, part);
    EXPECT_EQ(std::set<int>(nodes.begin(), nodes.end()).size(), nodes.size());
    owned.insert(nodes.begin(), nodes.begin() + part.own_nodes);
    for (const MarchQuad& quad : quads_of(cut, part))
      for (std::size_t corner = 0; corner < 4; ++corner)
        EXPECT_EQ(nodes[quad.node[corner]], section.quads[index(plan.quads[quad.place].quad)][corner]);
  }
  EXPECT_EQ(owned.size(), index(section.nodes()));
  EXPECT_EQ(std::set<int>(owned.begin(), owned.end()).size(), owned.size());
}

/// Two quads after one another are read at once where a value has 8 bytes, four of them where it has 4.
TEST(SectionCut, NodesReadAtOnceLieInDifferentBanks) {
  const Section section = section_of_squares();
  const SectionCut cut = cut_section(section, make_front_plan(section), {192, 90, 4});
  int pairs = 0;
  int same = 0;
  int fours = 0;
  int reads = 0;
  for_each_colour(cut, [&](std::span<const MarchQuad> quads) {
    for (std::size_t first = 0; first < quads.size(); first += 4)
      for (std::size_t corner = 0; corner < 4; ++corner) {
        std::array<int, 4> of_bank{};
        const std::size_t end = std::min(first + 4, quads.size());
        for (std::size_t q = first; q < end; ++q) ++of_bank[quads[q].node[corner] % 4];
        for (std::size_t q = first; q + 1 < end; q += 2) {
          ++pairs;
          same += (quads[q].node[corner] - quads[q + 1].node[corner]) % 2 == 0 ? 1 : 0;
        }
        ++fours;
        reads += *std::max_element(of_bank.begin(), of_bank.end());
      }
  });
  EXPECT_LT(same, 0.1 * pairs);
  EXPECT_LT(reads, 1.3 * fours);
}

TEST(SectionCut, QuadsWithMovedNodesComeTogether) {
  const Section section = section_of_squares();
  const FrontPlan plan = make_front_plan(section);
  std::vector<int> moved;
  for (const FrontPlan::Quad& quad : plan.quads) moved.push_back(quad.quad % 3 == 0 ? 5 : 0);
  const SectionCut cut = cut_section(section, plan, {192, 90, 4}, moved);
  for_each_colour(cut, [&](std::span<const MarchQuad> quads) {
    EXPECT_TRUE(std::is_sorted(quads.begin(), quads.end(), [&](const MarchQuad& a, const MarchQuad& b) {
      return moved[a.place] < moved[b.place];
    }));
  });
}

}  // namespace
}  // namespace tread
