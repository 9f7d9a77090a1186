#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include "core/error.hpp"
#include "core/mesh/structured.hpp"
#include "kernels/blocks/internal_force.hpp"
#include "kernels/ties/tie.hpp"
#include "tests/refusal.hpp"
#include "tests/swept_samples.hpp"

namespace tread {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

std::size_t index(std::int64_t i) {
  return static_cast<std::size_t>(i);
}

/// A ring of 12 coarse elements inside, `ratio` fine ones per coarse element outside; two fine quads per
/// coarse one.
struct TiedRing {
  Mesh mesh;
  TieSpec spec{1, "bottom", 0, "top"};

  explicit TiedRing(int ratio, double fine_radius = 0.13) {
    Section coarse = rectangle(-0.02, 0.03, 2, 0.1, 0.13, 2);
    Section fine = rectangle(-0.02, 0.03, 4, fine_radius, fine_radius + 0.02, 2);
    mesh.add(make_swept_block("inside", Sweep::revolved, std::move(coarse), {samples::steel()}, 0.2,
                              {{12, kTurn / 12, 0}}));
    mesh.add(make_swept_block("outside", Sweep::revolved, std::move(fine), {samples::steel()}, 0.2,
                              {{12 * ratio, kTurn / (12 * ratio), 0}}));
  }
  const SweptBlock& coarse() const { return mesh.blocks[0]; }
  const SweptBlock& fine() const { return mesh.blocks[1]; }
};

class TieRatio : public testing::TestWithParam<int> {};

TEST_P(TieRatio, SecondaryNodesLieOnTheChords) {
  const int ratio = GetParam();
  TiedRing ring(ratio);
  place_on_chords(ring.mesh, ring.spec);
  const auto& fine_path = ring.fine().section.paths.at("bottom");
  const auto& coarse_path = ring.coarse().section.paths.at("top");
  for (int station = 0; station < ring.fine().station_count(); ++station)
    for (std::size_t i = 0; i < fine_path.size(); ++i) {
      // Every second fine node stands over a coarse one, the others in the middle of an edge.
      const int first = station / ratio;
      const double along = static_cast<double>(station % ratio) / ratio;
      Vec3 expected;
      for (int end = 0; end < 2; ++end)
        for (const std::size_t j : {i / 2, (i + 1) / 2})
          expected += 0.5 * (end == 0 ? 1 - along : along) *
                      position(ring.coarse(), coarse_path[j], (first + end) % ring.coarse().station_count());
      EXPECT_LT(norm(position(ring.fine(), fine_path[i], station) - expected), 1e-15);
    }
  // Nodes off the line are not moved.
  for (const auto& [slot, shift] : ring.fine().node_shift) EXPECT_GT(norm(shift), 1e-12);
  EXPECT_EQ(ring.fine().node_shift.size(), fine_path.size() * index(12 * (ratio - 1)));
}

TEST_P(TieRatio, FollowTurnsBasesAndKeepsLinearFields) {
  TiedRing ring(GetParam());
  place_on_chords(ring.mesh, ring.spec);
  const Ties ties(ring.mesh, {ring.spec});
  const auto exact = samples::sample(ring.mesh, [](const Vec3& x) {
    return Vec3{1 + 2 * x.x - x.y + 3 * x.z, -2 + x.x + x.y - 2 * x.z, 3 - x.x + 4 * x.y + x.z};
  });
  auto field = exact;
  for (const std::int64_t slot : ties.secondary_slots())
    for (int c = 0; c < 3; ++c) field[index(dof(slot, c))] = 1e9;
  ties.follow({field.data()});
  for (std::size_t i = 0; i < field.size(); ++i) EXPECT_NEAR(field[i], exact[i], 1e-14);
}

TEST_P(TieRatio, GatherIsTheTransposeOfFollow) {
  TiedRing ring(GetParam());
  const Ties ties(ring.mesh, {ring.spec});
  auto x = samples::random_field(ring.mesh, 5);
  const auto force = samples::random_field(ring.mesh, 6);
  for (const std::int64_t slot : ties.secondary_slots())
    for (int c = 0; c < 3; ++c) x[index(dof(slot, c))] = 0;
  auto followed = x;
  ties.follow({followed.data()});
  auto gathered = force;
  ties.gather(gathered.data());
  double forward = 0, backward = 0, scale = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    forward += force[i] * followed[i];
    backward += gathered[i] * x[i];
    scale += std::abs(force[i] * followed[i]);
  }
  EXPECT_NEAR(forward, backward, 1e-15 * scale);
  for (const std::int64_t slot : ties.secondary_slots())
    for (int c = 0; c < 3; ++c) EXPECT_EQ(gathered[index(dof(slot, c))], 0);
}

TEST_P(TieRatio, MassAndItsCentreAreKept) {
  TiedRing ring(GetParam());
  place_on_chords(ring.mesh, ring.spec);
  const Ties ties(ring.mesh, {ring.spec});
  const InternalForce internal(ring.mesh);
  std::vector<double> mass(index(ring.mesh.slots), 0.0);
  internal.lumped_mass(mass.data());
  const auto moments = [&] {
    double sum = 0;
    Vec3 first;
    samples::for_each_node(ring.mesh, [&](const SweptBlock& block, int node, int station, std::int64_t slot) {
      sum += mass[index(slot)];
      first += mass[index(slot)] * position(block, node, station);
    });
    return std::pair(sum, first);
  };
  const auto before = moments();
  ties.gather_mass(mass.data());
  const auto after = moments();
  EXPECT_NEAR(after.first, before.first, 1e-14 * before.first);
  EXPECT_LT(norm(after.second - before.second), 1e-14 * before.first);
  for (const std::int64_t slot : ties.secondary_slots()) EXPECT_EQ(mass[index(slot)], 0);
}

INSTANTIATE_TEST_SUITE_P(Ratios, TieRatio, testing::Values(1, 2, 3, 4));

TEST(Tie, ListsWhoFollowsWhom) {
  TiedRing ring(3);
  const Ties ties(ring.mesh, {ring.spec});
  std::map<std::int64_t, std::size_t> primaries;
  std::int64_t last = -1;
  for (const auto& [secondary, primary] : ties.tied_slots()) {
    EXPECT_GE(secondary, last);
    last = secondary;
    EXPECT_LT(primary, ring.fine().base);
    ++primaries[secondary];
  }
  ASSERT_EQ(primaries.size(), index(ties.secondary_count()));
  EXPECT_EQ(ties.secondary_count(), 36 * 5);
  std::size_t alone = 0;
  for (const auto& [secondary, count] : primaries) {
    EXPECT_LE(count, 4U);
    if (count == 1) ++alone;
  }
  EXPECT_EQ(alone, 12U * 3U);  // nodes that stand on a primary node
}

TEST(Tie, DiagonalIsThatOfTheReducedOperator) {
  // Extruded: bases do not turn, the diagonal of T^T D T is exact.
  Mesh mesh;
  mesh.add(make_swept_block("coarse", Sweep::extruded, rectangle(0, 0.04, 2, -0.02, 0, 1), {samples::steel()},
                            0, {{3, 0.03, 0}}));
  mesh.add(make_swept_block("fine", Sweep::extruded, rectangle(0, 0.04, 4, 0, 0.01, 1), {samples::steel()}, 0,
                            {{9, 0.01, 0}}));
  const Ties ties(mesh, {{1, "bottom", 0, "top"}});
  auto d = samples::random_field(mesh, 7);
  auto reduced = d;
  ties.gather_diagonal(reduced.data());
  for (const int node : mesh.blocks[0].section.paths.at("top"))
    for (int station = 0; station < 4; ++station) {
      const std::size_t unknown = index(dof(mesh.blocks[0].slot(node, station), 1));
      AlignedVector<double> unit(d.size(), 0.0);
      unit[unknown] = 1;
      ties.follow({unit.data()});
      for (std::size_t i = 0; i < d.size(); ++i) unit[i] *= d[i];
      ties.gather(unit.data());
      EXPECT_NEAR(unit[unknown], reduced[unknown], 1e-20);
    }
}

TEST(Tie, LinesThatDoNotMeetAreRefused) {
  TiedRing apart(2, 0.1301);
  samples::expect_part(samples::refusal<InputError>([&] { Ties(apart.mesh, {apart.spec}); }),
                       "tie of 'outside' to 'inside'");
  TiedRing ring(2);
  EXPECT_THROW(Ties(ring.mesh, {{1, "nowhere", 0, "top"}}), InputError);
  // A line that is secondary to one block cannot lead another.
  TiedRing chain(2);
  chain.mesh.add(make_swept_block("third", Sweep::revolved, rectangle(-0.02, 0.03, 4, 0.13, 0.14, 1),
                                  {samples::steel()}, 0.2, {{48, kTurn / 48, 0}}));
  EXPECT_THROW(Ties(chain.mesh, {chain.spec, {2, "bottom", 1, "bottom"}}), InputError);
}

}  // namespace
}  // namespace tread
