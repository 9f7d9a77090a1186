#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "core/error.hpp"
#include "core/geometry/profiles.hpp"
#include "core/mesh/rail_section.hpp"
#include "core/mesh/structured.hpp"
#include "core/mesh/wheel_section.hpp"
#include "kernels/contact/contact_surface.hpp"
#include "tests/measured.hpp"
#include "tests/swept_samples.hpp"

namespace tread {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kCrown = 0.3;

std::size_t index(std::int64_t i) {
  return static_cast<std::size_t>(i);
}

SectionSize size_of(double surface, double band = 20e-3) {
  SectionSize size;
  size.surface = surface;
  size.band_centre = 0;
  size.band_half_width = band;
  return size;
}

TEST(SurfaceProfile, EdgeUnderAPointIsFound) {
  // A graded surface: fine in the middle, coarse outside.
  const Section section = make_rail_sections(cn60(), 1.0 / 40, size_of(2e-3, 10e-3)).cap;
  const SurfaceProfile profile(section);
  const auto brute = [&](double p) {
    for (int edge = 0; edge < profile.edges(); ++edge)
      if (p <= profile.edge_p(edge, 1)) return edge;
    return profile.edges() - 1;
  };
  std::mt19937 random(1);
  std::uniform_real_distribution<double> value(profile.first_p() - 0.01, profile.last_p() + 0.01);
  for (int i = 0; i < 20000; ++i) {
    const double p = value(random);
    ASSERT_EQ(profile.edge_at(p), brute(p)) << p;
  }
  for (int edge = 0; edge < profile.edges(); ++edge) {
    EXPECT_EQ(profile.edge_at(profile.edge_p(edge, 1)), edge);
    EXPECT_EQ(profile.edge_at(0.5 * (profile.edge_p(edge, 0) + profile.edge_p(edge, 1))), edge);
  }
}

/// Largest distance of the curve from the circle of the crown, and largest difference of their directions.
std::array<double, 2> distance_to_circle(double element_size, SurfaceKind kind) {
  const Section section =
      make_tyre_section(crowned(0.06, kCrown), 0.86, 0, 0.06, size_of(element_size, 30e-3));
  const SurfaceProfile profile(section);
  std::array<double, 2> worst{};
  for (int edge = 0; edge < profile.edges(); ++edge)
    for (int k = 0; k <= 10; ++k) {
      const auto at = profile.evaluate(edge, 0.1 * k, kind);
      const double down = at.q - (0.43 - kCrown);
      worst[0] = std::max(worst[0], std::abs(std::hypot(at.p, down) - kCrown));
      worst[1] = std::max(worst[1], std::abs(at.p * at.dp + down * at.dq) /
                                        (std::hypot(at.p, down) * std::hypot(at.dp, at.dq)));
    }
  return worst;
}

TEST(SurfaceProfile, HermiteCurvesAreTheCircleToFourthOrder) {
  const auto coarse = distance_to_circle(4e-3, SurfaceKind::exact);
  const auto fine = distance_to_circle(2e-3, SurfaceKind::exact);
  measured("crown of 0.3 m, edges of 4 mm: Hermite curve off the circle", coarse[0], "m");
  measured("crown of 0.3 m, edges of 2 mm: Hermite curve off the circle", fine[0], "m");
  EXPECT_LT(coarse[0], 1e-10);
  EXPECT_LT(coarse[1], 1e-7);
  EXPECT_LT(fine[0], coarse[0] / 10);
  // A chord of 2 mm stands off by h^2 / (8 R) = 1.7 um.
  const auto facets = distance_to_circle(2e-3, SurfaceKind::facets);
  EXPECT_NEAR(facets[0], 4e-6 / (8 * kCrown), 0.2e-6);
}

TEST(SurfaceProfile, DerivativesAreThoseOfTheCurve) {
  const Section section = make_rail_sections(cn60(), 1.0 / 40, size_of(2e-3)).cap;
  const SurfaceProfile profile(section);
  for (const SurfaceKind kind : {SurfaceKind::exact, SurfaceKind::facets})
    for (int edge = 0; edge < profile.edges(); edge += 3)
      for (const double eta : {0.1, 0.5, 0.8}) {
        const auto at = profile.evaluate(edge, eta, kind);
        const auto ahead = profile.evaluate(edge, eta + 1e-4, kind);
        const auto behind = profile.evaluate(edge, eta - 1e-4, kind);
        EXPECT_NEAR(at.dp, (ahead.p - behind.p) / 2e-4, 1e-9);
        EXPECT_NEAR(at.dq, (ahead.q - behind.q) / 2e-4, 1e-9);
      }
}

TEST(SurfaceProfile, VerticalPartsAndMissingSurfacesAreRefused) {
  Section section = rectangle(0, 0.02, 2, 0, 0.01, 1);
  EXPECT_THROW(SurfaceProfile{section}, InputError);
  section.surface.push_back(
      {0, {section.paths.at("right")[0], section.paths.at("right")[1]}, {{{0, 1}, {0, 1}}}});
  EXPECT_THROW(SurfaceProfile{section}, InputError);
}

/// A line of nodes of uneven spacing.
struct Line {
  std::vector<double> at = {0, 0.1, 0.3, 0.4, 0.8, 0.9, 1.5};
  LineCell cell(int i) const {
    const int last = static_cast<int>(at.size()) - 1;
    const auto length = [&](int k) { return k >= 0 && k < last ? at[index(k + 1)] - at[index(k)] : 0.0; };
    return {std::max(i - 1, 0), i, i + 1, std::min(i + 2, last), length(i - 1), length(i), length(i + 1)};
  }
};

TEST(LineWeights, ReproduceQuadraticsInsideAndLinesAtTheEnds) {
  const Line line;
  const auto square = [](double x) { return 2 - 3 * x + 5 * x * x; };
  for (int i = 0; i + 1 < static_cast<int>(line.at.size()); ++i) {
    const LineCell cell = line.cell(i);
    const bool inside = cell.length_before > 0 && cell.length_after > 0;
    for (const double t : {0.0, 0.2, 0.5, 0.9, 1.0})
      for (const SurfaceKind kind : {SurfaceKind::exact, SurfaceKind::facets}) {
        const LineWeights w = line_weights(cell, t, kind);
        const double x = line.at[index(i)] + t * cell.length;
        double one = 0, flat = 0, linear = 0, slope = 0, quadratic = 0, quadratic_slope = 0;
        for (std::size_t k = 0; k < 4; ++k) {
          const double node = line.at[index(w.ordinal[k])];
          one += w.value[k];
          flat += w.slope[k];
          linear += w.value[k] * node;
          slope += w.slope[k] * node;
          quadratic += w.value[k] * square(node);
          quadratic_slope += w.slope[k] * square(node);
        }
        EXPECT_NEAR(one, 1, 1e-14);
        EXPECT_NEAR(flat, 0, 1e-14);
        EXPECT_NEAR(linear, x, 1e-14);
        EXPECT_NEAR(slope, cell.length, 1e-14);
        if (kind == SurfaceKind::facets || !inside) continue;
        EXPECT_NEAR(quadratic, square(x), 1e-13);
        EXPECT_NEAR(quadratic_slope, cell.length * (10 * x - 3), 1e-13);
      }
  }
}

TEST(LineWeights, ValuesAndSlopesAreContinuous) {
  const Line line;
  std::vector<double> value;
  std::mt19937 random(5);
  for (std::size_t i = 0; i < line.at.size(); ++i)
    value.push_back(std::uniform_real_distribution<double>(-1, 1)(random));
  const auto sum = [&](const LineWeights& w, const std::array<double, 4>& weights) {
    double total = 0;
    for (std::size_t k = 0; k < 4; ++k) total += weights[k] * value[index(w.ordinal[k])];
    return total;
  };
  for (int i = 0; i + 2 < static_cast<int>(line.at.size()); ++i) {
    const LineWeights end = line_weights(line.cell(i), 1, SurfaceKind::exact);
    const LineWeights start = line_weights(line.cell(i + 1), 0, SurfaceKind::exact);
    EXPECT_NEAR(sum(end, end.value), value[index(i + 1)], 1e-14);
    EXPECT_NEAR(sum(start, start.value), value[index(i + 1)], 1e-14);
    EXPECT_NEAR(sum(end, end.slope) / line.cell(i).length, sum(start, start.slope) / line.cell(i + 1).length,
                1e-12);
    const LineWeights before = line_weights(line.cell(i), 0.3 - 1e-5, SurfaceKind::exact);
    const LineWeights after = line_weights(line.cell(i), 0.3 + 1e-5, SurfaceKind::exact);
    const LineWeights middle = line_weights(line.cell(i), 0.3, SurfaceKind::exact);
    EXPECT_NEAR((sum(after, after.value) - sum(before, before.value)) / 2e-5, sum(middle, middle.slope),
                1e-8);
  }
}

TEST(LineWeights, CellsOfBlocksKnowTheirNeighbours) {
  const SweptBlock ring = samples::revolved_closed();
  const LineCell seam = station_cell(ring, 18);
  EXPECT_EQ(seam.before, 17);
  EXPECT_EQ(seam.second, 0);
  EXPECT_EQ(seam.after, 1);
  EXPECT_DOUBLE_EQ(seam.length_after, kTurn / 19);
  const SweptBlock bar = samples::extruded();
  const LineCell first = station_cell(bar, 0);
  EXPECT_EQ(first.before, 0);
  EXPECT_EQ(first.length_before, 0);
  EXPECT_EQ(first.after, 2);
  const LineCell last = station_cell(bar, bar.station_count() - 2);
  EXPECT_EQ(last.after, last.second);
  EXPECT_EQ(last.length_after, 0);
  const LineCell graded = station_cell(bar, 5);
  EXPECT_DOUBLE_EQ(graded.length_before, 0.01);
  EXPECT_DOUBLE_EQ(graded.length, 0.004);
}

TEST(StationFinder, FindsTheCellOfOpenGradedBlocks) {
  const SweptBlock block = samples::extruded();
  const StationFinder finder(block);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> value(block.stations.front(), block.stations.back());
  for (int i = 0; i < 20000; ++i) {
    const double x = value(random);
    const auto cell = finder.find(x);
    int brute = 0;
    while (block.stations[index(brute + 1)] <= x) ++brute;
    ASSERT_EQ(cell.station, brute);
    EXPECT_EQ(cell.next, brute + 1);
    EXPECT_NEAR(cell.distance, x - block.stations[index(brute)], 1e-15);
    EXPECT_NEAR(cell.pitch, block.stations[index(brute + 1)] - block.stations[index(brute)], 1e-15);
  }
  EXPECT_EQ(finder.find(block.stations.front() - 1e-9).station, -1);
  EXPECT_EQ(finder.find(block.stations.back() + 1e-9).station, -1);
  // The span is a sum of pitches; ends of a scene's rail are not.
  EXPECT_EQ(finder.find(block.stations.back() + 1e-12).station, block.station_count() - 2);
  EXPECT_EQ(finder.find(block.stations.front() - 1e-12).station, 0);
  EXPECT_EQ(finder.find(block.stations.front()).station, 0);
}

TEST(StationFinder, TakesAnyAngleOfAClosedBlock) {
  // Three pitches around, as in a tread with a fine arc.
  const double fine = 0.01;
  const double rest = (kTurn - 40 * fine - 0.5) / 31;
  const SweptBlock block =
      make_swept_block("ring", Sweep::revolved, rectangle(0, 0.02, 1, 0.1, 0.12, 1), {samples::steel()}, -0.7,
                       {{40, fine, 0}, {31, rest, 0}, {5, 0.1, 0}});
  ASSERT_TRUE(block.closed);
  const StationFinder finder(block);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> value(-30, 30);
  for (int i = 0; i < 20000; ++i) {
    const double phi = value(random);
    double at = phi;
    while (at < -0.7) at += kTurn;
    while (at >= -0.7 + kTurn) at -= kTurn;
    int brute = 0;
    while (brute + 1 < block.station_count() && block.stations[index(brute + 1)] <= at) ++brute;
    const auto cell = finder.find(phi);
    ASSERT_EQ(cell.station, brute) << phi;
    EXPECT_EQ(cell.next, (brute + 1) % block.station_count());
    EXPECT_NEAR(cell.distance, at - block.stations[index(brute)], 1e-13);
    EXPECT_GE(cell.distance, -1e-15);
    EXPECT_LE(cell.distance, cell.pitch + 1e-13);
  }
}

}  // namespace
}  // namespace tread
