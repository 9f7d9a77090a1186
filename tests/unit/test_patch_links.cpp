// Cells and nodes of a patch by a team of threads: those of PatchCells, in any order of the threads.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

#include "kernels/contact/patch_cells.hpp"
#include "kernels/device/patch_links.hpp"

namespace tread {
namespace {

constexpr int kStations = 9;
constexpr int kNodes = 8;                                // across
constexpr std::int64_t kSlots = 2 * kStations * kNodes;  // the wheel's after the rail's

std::size_t index(std::int64_t i) {
  return static_cast<std::size_t>(i);
}

/// Threads one after the other, forwards or backwards.
class Team {
 public:
  explicit Team(bool backwards) : backwards_(backwards) {}

  template <class Body>
  void for_each(int n, const Body& body) const {
    for (int i = 0; i < n; ++i) body(backwards_ ? n - 1 - i : i);
  }
  template <class Value, class Take>
  int number(int n, const Value& value, const Take& take) const {
    int before = 0;
    for (int i = 0; i < n; ++i) {
      const int own = value(i);
      take(i, before);
      before += own;
    }
    return before;
  }
  void least(int* at, int value) const { *at = std::min(*at, value); }
  int add(int* at, int value) const { return std::exchange(*at, *at + value); }
  int claim(int* at, int value) const { return *at = *at == 0 ? value : *at; }

 private:
  bool backwards_;
};

/// Nodes about a face; at the ends of a surface the outer ones repeat their neighbours.
void place(SurfaceSupport& support, std::int64_t first_slot, int station, int edge) {
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) {
      const int s = std::clamp(station - 1 + i, 0, kStations - 1);
      const int n = std::clamp(edge - 1 + j, 0, kNodes - 1);
      support.slot[index(4 * i + j)] = first_slot + s * kNodes + n;
    }
  support.along.fill(0.25);
  support.across.fill(0.25);
}

/// Points on faces of the rail, in their order, opposite to any faces of the wheel.
std::vector<ContactPoint> made_up_points() {
  std::mt19937 random(1);
  const auto draw = [&](int below) { return static_cast<int>(random() % static_cast<unsigned>(below)); };
  std::vector<ContactPoint> points;
  for (int station = 0; station + 1 < kStations; ++station)
    for (int edge = 0; edge + 1 < kNodes; ++edge)
      for (int k = draw(4); k > 0; --k) {
        ContactPoint& point = points.emplace_back();
        place(point.rail, 0, station, edge);
        place(point.wheel, kSlots / 2, draw(kStations - 1), draw(kNodes - 1));
        for (std::size_t i = 0; i < 4; ++i) {
          point.wheel_cosine[i] = static_cast<double>(point.wheel.slot[4 * i]);
          point.wheel_sine[i] = -point.wheel_cosine[i];
        }
      }
  return points;
}

/// Room for the links of some points.
struct Room {
  explicit Room(std::size_t points)
      : ints(14, std::vector<int>(4 * kCellNodes * 2 * points)),
        node(index(kSlots)),
        inverse_mass(index(kSlots)) {}

  PatchLinks links() {
    return {ints[0].data(),  ints[1].data(),      ints[2].data(),  ints[3].data(),
            node.data(),     inverse_mass.data(), ints[4].data(),  ints[5].data(),
            ints[6].data(),  ints[7].data(),      ints[8].data(),  ints[9].data(),
            ints[10].data(), ints[11].data(),     ints[12].data(), ints[13].data()};
  }

  std::vector<std::vector<int>> ints;
  std::vector<PatchNode> node;
  std::vector<double> inverse_mass;
};

TEST(LinkedPatch, HasTheNodesAndSumsOfPatchCells) {
  std::vector<ContactPoint> points = made_up_points();
  const int count = static_cast<int>(points.size());
  ASSERT_GT(count, 50);
  std::vector<int> origin(points.size());
  std::iota(origin.begin(), origin.end(), 0);
  PatchCells cells;
  cells.reserve(kSlots, points.size(), index(kSlots));
  std::vector<double> mass(index(kSlots));
  std::iota(mass.begin(), mass.end(), 1.0);
  cells.link(points, mass.data());
  std::vector<PatchVector> numbers(points.size());
  for (int i = 0; i < count; ++i) numbers[index(i)].value[0] = i + 1;
  std::vector<PatchVector> sums(cells.nodes().size());
  cells.to_nodes(numbers, sums);

  for (const bool backwards : {false, true}) {
    Room room(points.size());
    const Team team(backwards);
    LinkedPatch<Team> patch(team, room.links());
    patch.link({points.data(), origin.data()}, count, mass.data());
    const PatchLinks& links = patch.links();
    ASSERT_EQ(patch.nodes(), std::ssize(cells.nodes()));
    for (int n = 0; n < patch.nodes(); ++n) {
      const PatchCells::Node& node = cells.nodes()[index(n)];
      EXPECT_EQ(links.node[n].slot, node.slot);
      EXPECT_EQ(links.node[n].of_wheel != 0, node.of_wheel);
      EXPECT_EQ(links.node[n].cosine, node.cosine);
      EXPECT_EQ(links.node[n].sine, node.sine);
      EXPECT_EQ(links.inverse_mass[n], node.inverse_mass);
      double sum = 0;
      for (int t = links.first_term[n]; t < links.first_term[n + 1]; ++t) {
        EXPECT_TRUE(t == links.first_term[n] || links.term[t - 1] < links.term[t]);
        EXPECT_EQ(links.cell_node[links.term[t]], n);
        const int cell = links.term[t] / kCellNodes;
        for (int e = links.first_entry[cell]; e < links.first_entry[cell + 1]; ++e) {
          EXPECT_EQ(links.cell[links.entry[e]], cell);
          sum += 0.0625 * (links.entry[e] % count + 1);
        }
      }
      EXPECT_DOUBLE_EQ(sum * node.inverse_mass, sums[index(n)].value[0]);
    }
    EXPECT_EQ(links.first_entry[patch.cells()], 2 * count);
    std::vector<int> entries(links.entry, links.entry + 2 * count);
    std::sort(entries.begin(), entries.end());
    for (int e = 0; e < 2 * count; ++e) EXPECT_EQ(entries[index(e)], e);  // each is listed once
  }
}

}  // namespace
}  // namespace tread
