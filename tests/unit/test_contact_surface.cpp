#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "core/error.hpp"
#include "core/geometry/profiles.hpp"
#include "core/mesh/rail_section.hpp"
#include "core/mesh/structured.hpp"
#include "core/mesh/wheel_section.hpp"
#include "kernels/contact_surface.hpp"
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

/// Largest distance of the curve from the circle of the crown, and of its direction.
std::array<double, 2> distance_to_circle(double element_size, SurfaceKind kind) {
  const Section section = make_tyre_section(crowned(0.06, kCrown), 0.86, 0, 0.06, size_of(element_size, 30e-3));
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
  // A chord of 2 mm stands off h^2 / (8 R) = 1.7 um.
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
  section.surface.push_back({0, {section.paths.at("right")[0], section.paths.at("right")[1]}, {{{0, 1}, {0, 1}}}});
  EXPECT_THROW(SurfaceProfile{section}, InputError);
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
  EXPECT_EQ(finder.find(block.stations.front()).station, 0);
}

TEST(StationFinder, TakesAnyAngleOfAClosedBlock) {
  // Three pitches around, as a tread with a fine arc has them.
  const double fine = 0.01;
  const double rest = (kTurn - 40 * fine - 0.5) / 31;
  const SweptBlock block = make_swept_block("ring", Sweep::revolved, rectangle(0, 0.02, 1, 0.1, 0.12, 1),
                                            {samples::steel()}, -0.7, {{40, fine, 0}, {31, rest, 0}, {5, 0.1, 0}});
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
