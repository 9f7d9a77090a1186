// Averages and accumulated values at surface nodes, from made-up points on a plane rail.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "kernels/contact/surface_fields.hpp"
#include "tests/swept_samples.hpp"

namespace tread {
namespace {

/// A rectangular section of four quads side by side, 2 + 4 + 4 + 2 mm wide and 5 mm high.
Section strip() {
  Section section;
  const std::vector<double> y = {-6e-3, -4e-3, 0, 4e-3, 6e-3};
  for (const double z : {-5e-3, 0.0})
    for (const double p : y) {
      section.p.push_back(p);
      section.q.push_back(z);
    }
  for (int i = 0; i < 4; ++i) {
    section.quads.push_back({i, i + 1, i + 6, i + 5});
    section.quad_material.push_back(0);
    section.surface.push_back({i, {i + 5, i + 6}, {{{1, 0}, {1, 0}}}});
  }
  return section;
}

/// A rail with elements of 2 mm, then of 4 mm.
SweptBlock rail() {
  return make_swept_block("rail", Sweep::extruded, strip(), {samples::steel()}, 0.0,
                          {{5, 2e-3, 0}, {4, 4e-3, 0}});
}

/// Contact point at the fractions (along, across) of a face of the rail.
ContactPoint point_on(const SweptBlock& block, std::array<int, 2> face, double along, double across) {
  ContactPoint point{};
  point.face = face;
  point.face_share[static_cast<std::size_t>(2 * (along > 0.5) + (across > 0.5))] = 1;
  const auto e = static_cast<std::size_t>(face[1]);
  const double width = block.section.p[e + 6] - block.section.p[e + 5];
  point.area = 0.25 * block.pitch(face[0]) * width;
  return point;
}

class SurfaceFieldsTest : public testing::Test {
 protected:
  /// Two by two points on every face of stations [first, last) and the grid's edges.
  template <class Set>
  std::vector<ContactPoint> points(int first, int last, const Set& set) const {
    std::vector<ContactPoint> out;
    for (int station = first; station < last; ++station)
      for (int edge = 1; edge < 4; ++edge)
        for (const double along : {0.25, 0.75})
          for (const double across : {0.25, 0.75}) {
            out.push_back(point_on(rail_, {station, edge}, along, across));
            set(out.back());
          }
    return out;
  }

  SweptBlock rail_ = rail();
  SurfaceProfile profile_{rail_.section};
  SurfaceGrid grid_ = make_surface_grid(rail_, profile_, SurfaceKind::exact, {1, 4});
};

TEST_F(SurfaceFieldsTest, GridHasTheNodesOfItsEdgesAndTheirAreas) {
  EXPECT_EQ(grid_.stations(), 10);
  EXPECT_EQ(grid_.rows(), 4);
  EXPECT_EQ(grid_.y, (std::vector<double>{-4e-3, 0, 4e-3, 6e-3}));
  EXPECT_EQ(grid_.quad, (std::vector<int>{1, 2, 3}));
  EXPECT_NEAR(grid_.area(5, 1), 3e-3 * 4e-3, 1e-18);  // between 2 mm and 4 mm
  double sum = 0;
  for (int s = 0; s < grid_.stations(); ++s)
    for (int r = 0; r < grid_.rows(); ++r) sum += grid_.area(s, r);
  EXPECT_NEAR(sum, 26e-3 * 11e-3, 1e-15);
  // A row stands for the same width at the grid's edge and within it.
  const SurfaceGrid whole = make_surface_grid(rail_, profile_, SurfaceKind::exact, {0, 4});
  for (std::size_t r = 0; r < grid_.width.size(); ++r) EXPECT_EQ(grid_.width[r], whole.width[r + 1]) << r;
}

TEST_F(SurfaceFieldsTest, EvenTractionsAreTheirOwnAverage) {
  PatchNodes patch(grid_, 10);
  patch.average(2, 8, points(2, 8, [](ContactPoint& p) {
                  p.pressure = 5e8;
                  p.shear = {-2e8, 1e8};
                  p.slip_speed = {-0.3, 0.1};
                  p.slips = true;
                }));
  for (int station = 3; station < 8; ++station) {
    // A third of what the first row stands for lies beyond the grid.
    EXPECT_NEAR(patch.at(station, 0).pressure, 5e8 * 2 / 3, 1e-3);
    for (int row = 1; row < grid_.rows(); ++row) {
      const NodalContact& node = patch.at(station, row);
      EXPECT_NEAR(node.pressure, 5e8, 1e-3);
      EXPECT_NEAR(node.shear.along, -2e8, 1e-3);
      EXPECT_NEAR(node.shear.across, 1e8, 1e-3);
      EXPECT_NEAR(node.slip_speed.along, -0.3, 1e-12);
      EXPECT_NEAR(node.touching, 1, 1e-12);
      EXPECT_EQ(state_of(node), PatchState::slip);
    }
  }
  // At the patch's end half of the node's area is out of contact; the slip is that of the other half.
  EXPECT_NEAR(patch.at(2, 1).pressure, 2.5e8, 1e-3);
  EXPECT_NEAR(patch.at(2, 1).slip_speed.along, -0.3, 1e-12);
  EXPECT_NEAR(patch.max_pressure(), 5e8, 1e-3);
  EXPECT_NEAR(patch.max_shear(), std::sqrt(5.0) * 1e8, 1e-3);
}

TEST_F(SurfaceFieldsTest, ANodeSlipsWhereMostAboutItSlips) {
  PatchNodes patch(grid_, 10);
  patch.average(2, 8, points(2, 8, [](ContactPoint& p) {
                  p.pressure = 1e8;
                  p.slips = p.face[0] < 4;
                }));
  EXPECT_EQ(state_of(patch.at(3, 1)), PatchState::slip);
  EXPECT_EQ(state_of(patch.at(5, 1)), PatchState::stick);
  patch.average(2, 8, {});
  EXPECT_EQ(state_of(patch.at(3, 1)), PatchState::out);
  EXPECT_EQ(patch.max_pressure(), 0);
}

TEST_F(SurfaceFieldsTest, WorkOverTheNodesIsThatOfThePoints) {
  PatchNodes patch(grid_, 8);
  SurfaceFields fields(grid_);
  double work = 0;
  double sampled = 0;
  constexpr double kInterval = 1e-5;
  for (int step = 0; step < 4; ++step) {
    int count = 0;
    const auto made_up = points(step, step + 5, [&](ContactPoint& p) {
      const double v = std::sin(1.0 + 7 * step + 3 * count++);
      p.pressure = v > -0.5 ? 1e9 * (0.6 + v) : 0;  // some have left contact
      p.shear = {2e8 * v, 1e8};
      p.shear_before = {1e8 * v, 0};
      p.slip_speed = {0.2 * v, -0.1};
      p.frictional_work = 3 + v;
      work += p.area * p.frictional_work;
      if (p.pressure > 0) sampled += kInterval * p.area * p.frictional_power();
    });
    patch.average(step, step + 5, made_up);
    fields.add_step(patch);
    fields.add_sample(patch, kInterval);
  }
  EXPECT_NEAR(fields.sum(fields.frictional_work()), work, 1e-14 * work);
  EXPECT_NEAR(fields.sum(fields.sampled_frictional_work()), sampled, 1e-13 * std::abs(sampled));
}

TEST_F(SurfaceFieldsTest, MaximaAreThoseOfAllSteps) {
  PatchNodes patch(grid_, 6);
  SurfaceFields fields(grid_);
  for (int first = 0; first < 4; ++first) {
    patch.average(first, first + 2, points(first, first + 2, [&](ContactPoint& p) {
                    p.pressure = 1e8 * (1 + first);
                    p.shear = {0, -1e7 * (1 + first)};
                  }));
    fields.add_step(patch);
  }
  for (int station = 1; station < 5; ++station)
    EXPECT_NEAR(fields.max_pressure()[grid_.node(station, 1)], 1e8 * station, 1e-3) << station;
  EXPECT_NEAR(fields.max_shear()[grid_.node(2, 2)], 2e7, 1e-3);
  EXPECT_EQ(fields.max_pressure()[grid_.node(7, 1)], 0);
}

TEST_F(SurfaceFieldsTest, StressIsThatOfTheElementsUnderPressure) {
  Mesh mesh;
  const int block = mesh.add(rail_);
  const InternalForce force(mesh);
  // Uniaxial strain of 1e-3: one Von Mises stress everywhere.
  AlignedVector<double> u(static_cast<std::size_t>(3 * mesh.slots), 0.0);
  const SweptBlock& b = mesh.blocks[0];
  for (int s = 0; s < b.station_count(); ++s)
    for (int n = 0; n < b.section.nodes(); ++n)
      u[static_cast<std::size_t>(dof(b.base + b.slot(n, s), 0))] =
          1e-3 * b.stations[static_cast<std::size_t>(s)];
  PatchNodes patch(grid_, 6);
  patch.average(3, 5, points(3, 4, [](ContactPoint& p) { p.pressure = 1e8; }));
  SurfaceFields fields(grid_);
  fields.add_stress(patch, force, block, {u.data()});
  const double expected = 2 * samples::steel().shear_modulus() * 1e-3;
  for (int row = 0; row < 3; ++row) {
    EXPECT_NEAR(fields.max_von_mises()[grid_.cell(3, row)], expected, 1e-6 * expected);
    EXPECT_NEAR(fields.max_von_mises()[grid_.cell(4, row)], expected, 1e-6 * expected);
    EXPECT_EQ(fields.max_von_mises()[grid_.cell(6, row)], 0);
  }
}

}  // namespace
}  // namespace tread
