#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "core/corrugation.hpp"

namespace tread {
namespace {

// Corrugation D of the paper, starting at x_s = 2.4 m.
const Corrugation kSine({0.08, 0.14e-3}, 2.4, 0.6, 1e-3, 30e-3);

TEST(Corrugation, CrestStandsAtTheStartAndTroughHalfAWaveLater) {
  EXPECT_DOUBLE_EQ(kSine.depth(2.4, 1e-3), 0);
  EXPECT_NEAR(kSine.depth(2.44, 1e-3), 0.14e-3, 1e-18);
  EXPECT_NEAR(kSine.depth(2.42, 1e-3), 0.07e-3, 1e-17);
  EXPECT_NEAR(kSine.depth(2.48, 1e-3), 0, 1e-17);
  EXPECT_DOUBLE_EQ(kSine.deepest(), 0.14e-3);
  // The surface leaves the crest without a kink.
  EXPECT_LT(kSine.depth(2.4 + 1e-5, 1e-3), 1e-10);
}

TEST(Corrugation, NoSlopeExceedsTheSteepest) {
  EXPECT_DOUBLE_EQ(kSine.steepest(), std::acos(-1.0) * 0.14e-3 / 0.08);
  const Corrugation table({0, 0.02, 0.03, 0.05, 0.08}, {0, 1e-4, 1e-4, 2e-4, 0}, 0, 0, 0.03);
  for (const Corrugation* shape : {&kSine, &table})
    for (double x = shape->first(); x < shape->last() - 1e-5; x += 1e-5)
      EXPECT_LE(std::abs(shape->depth(x + 1e-5, shape->centre()) - shape->depth(x, shape->centre())),
                1e-5 * shape->steepest());
}

TEST(Corrugation, WholeWavesAreCut) {
  EXPECT_DOUBLE_EQ(kSine.first(), 2.4);
  EXPECT_NEAR(kSine.last(), 2.4 + 7 * 0.08, 1e-15);
  EXPECT_EQ(kSine.depth(2.4 - 1e-9, 1e-3), 0);
  EXPECT_EQ(kSine.depth(2.4 + 7.5 * 0.08, 1e-3), 0);
  EXPECT_NEAR(kSine.depth(2.4 + 6.5 * 0.08, 1e-3), 0.14e-3, 1e-17);
  // A length of whole waves up to rounding keeps the last of them.
  EXPECT_NEAR(Corrugation({0.08, 1e-4}, 0, 7 * 0.08, 0, 0.03).last(), 0.56, 1e-15);
  EXPECT_TRUE(Corrugation({0.08, 1e-4}, 0, 0.05, 0, 0.03).smooth());
  EXPECT_TRUE(Corrugation().smooth());
  EXPECT_EQ(Corrugation().depth(0.5, 0), 0);
  EXPECT_FALSE(kSine.smooth());
}

TEST(Corrugation, FadesAcrossAsAParabola) {
  EXPECT_NEAR(kSine.depth(2.44, 1e-3 + 15e-3), 0.75 * 0.14e-3, 1e-18);
  EXPECT_DOUBLE_EQ(kSine.depth(2.44, 1e-3 + 10e-3), kSine.depth(2.44, 1e-3 - 10e-3));
  EXPECT_EQ(kSine.depth(2.44, 1e-3 + 30e-3), 0);
  EXPECT_EQ(kSine.depth(2.44, 1e-3 - 31e-3), 0);
  EXPECT_DOUBLE_EQ(kSine.centre(), 1e-3);
}

TEST(Corrugation, TableIsMetAndDoesNotOvershoot) {
  const std::vector<double> x = {0, 0.02, 0.03, 0.05, 0.08};
  const std::vector<double> depth = {0, 1e-4, 1e-4, 2e-4, 0};
  const Corrugation table(x, depth, 1.5, 0, 0.03);
  EXPECT_DOUBLE_EQ(table.deepest(), 2e-4);
  EXPECT_DOUBLE_EQ(table.last(), 1.58);
  for (std::size_t i = 1; i + 1 < x.size(); ++i) EXPECT_NEAR(table.depth(1.5 + x[i], 0), depth[i], 1e-18);
  for (std::size_t i = 0; i + 1 < x.size(); ++i) {
    const double low = std::min(depth[i], depth[i + 1]);
    const double high = std::max(depth[i], depth[i + 1]);
    double last = depth[i];
    for (int k = 1; k < 100; ++k) {
      const double d = table.depth(1.5 + x[i] + 0.01 * k * (x[i + 1] - x[i]), 0);
      EXPECT_GE(d, low - 1e-18);
      EXPECT_LE(d, high + 1e-18);
      EXPECT_GE((d - last) * (depth[i + 1] - depth[i]), -1e-24);
      last = d;
    }
  }
  EXPECT_EQ(table.depth(1.49, 0), 0);
  EXPECT_NEAR(table.depth(1.55, 15e-3), 0.75 * 2e-4, 1e-18);
}

TEST(Corrugation, TheFirstDifferenceIsFoundWhereverItLies) {
  const auto differ = [](const Corrugation& a, const Corrugation& b, double end) {
    const std::optional<double> one = first_difference(a, b, end, 1e-9);
    EXPECT_EQ(one, first_difference(b, a, end, 1e-9));
    return one;
  };
  EXPECT_FALSE(differ(kSine, kSine, 10));
  EXPECT_FALSE(differ(Corrugation(), Corrugation(), 10));
  EXPECT_FALSE(differ(Corrugation(), kSine, 2.4));
  EXPECT_NEAR(differ(Corrugation(), kSine, 10).value(), 2.4, 2e-4);
  // Two sines of one start differ where the shorter ends; another width, centre or depth shows at once.
  const Corrugation longer({0.08, 0.14e-3}, 2.4, 0.7, 1e-3, 30e-3);
  EXPECT_FALSE(differ(kSine, longer, 2.4 + 7 * 0.08));
  EXPECT_NEAR(differ(kSine, longer, 10).value(), 2.4 + 7 * 0.08, 2e-4);
  EXPECT_NEAR(differ(kSine, Corrugation({0.08, 0.14e-3}, 2.4, 0.6, 1e-3, 29e-3), 10).value(), 2.4, 2e-3);
  EXPECT_NEAR(differ(kSine, Corrugation({0.08, 0.14e-3}, 2.4, 0.6, 1.1e-3, 30e-3), 10).value(), 2.4, 2e-3);
  EXPECT_NEAR(differ(kSine, Corrugation({0.08, 0.13e-3}, 2.4, 0.6, 1e-3, 30e-3), 10).value(), 2.4, 2e-3);
}

TEST(Corrugation, RoughnessIsTheSameForASeedAndFadesAtItsEnds) {
  const Corrugation::Random random{3e-6, 0.03, 0.12, 7};
  const Corrugation rough = Corrugation::rough(random, 2.4, 0.6, 0, 0.03);
  const Corrugation again = Corrugation::rough(random, 2.4, 0.6, 0, 0.03);
  const Corrugation other = Corrugation::rough({3e-6, 0.03, 0.12, 8}, 2.4, 0.6, 0, 0.03);
  EXPECT_FALSE(first_difference(rough, again, 3, 0));
  EXPECT_TRUE(first_difference(rough, other, 3, 1e-9));
  EXPECT_EQ(rough.first(), 2.4);
  EXPECT_DOUBLE_EQ(rough.last(), 3.0);
  EXPECT_NEAR(rough.depth(2.401, 0), 0, 1e-8);
  EXPECT_NEAR(rough.depth(2.999, 0), 0, 1e-8);
  double squares = 0;
  double lowest = 0;
  double deepest = 0;
  int count = 0;
  for (double x = 2.46; x <= 2.94; x += 1e-3, ++count) {
    squares += rough.depth(x, 0) * rough.depth(x, 0);
    lowest = std::min(lowest, rough.depth(x, 0));
    deepest = std::max(deepest, rough.depth(x, 0));
  }
  EXPECT_NEAR(std::sqrt(squares / count), 3e-6, 0.6e-6);
  EXPECT_LT(lowest, 0);
  EXPECT_GE(rough.deepest(), deepest - lowest - 1e-12);
  EXPECT_LT(rough.deepest(), 2 * (deepest - lowest));
}

TEST(Corrugation, WavesOfABandAreWholeNumbers) {
  const auto waves = [](double shortest, double longest, double length) {
    const WaveRange range = waves_of(shortest, longest, length);
    return std::vector<double>{range.first, range.last};
  };
  EXPECT_EQ(waves(0.03, 0.12, 0.6), (std::vector<double>{5, 20}));
  EXPECT_EQ(waves(0.1, 0.11, 0.56), (std::vector<double>{6, 5}));  // none
  EXPECT_EQ(waves(0.08, 0.08, 0.56), (std::vector<double>{7, 7}));
  EXPECT_GT(waves(1e-20, 0.1, 1).back(), 9e19);
}

TEST(Corrugation, RoughnessHoldsTheWavesOfItsBandAlone) {
  const double length = 0.6;
  const Corrugation rough = Corrugation::rough({3e-6, 0.03, 0.12, 7}, 0, length, 0, 0.03);
  const auto line = [&](double wavelength) {
    double real = 0;
    double imaginary = 0;
    for (int i = 0; i < 1200; ++i) {
      const double x = length * i / 1200;
      const double angle = 2 * std::acos(-1.0) * x / wavelength;
      const double window = 1 - std::cos(2 * std::acos(-1.0) * x / length);  // the fading ends count little
      real += window * rough.depth(x, 0) * std::cos(angle) / 600;
      imaginary += window * rough.depth(x, 0) * std::sin(angle) / 600;
    }
    return std::hypot(real, imaginary);
  };
  double inside = 0;
  for (int wave = 5; wave <= 20; ++wave) inside += line(length / wave);
  for (const int outside : {1, 2, 24, 30}) EXPECT_LT(line(length / outside), 0.03 * inside / 16) << outside;
  EXPECT_GT(inside / 16, 0.5e-6);
}

TEST(Corrugation, AMapKeepsItsOwnShapeAcross) {
  const Corrugation sine({0.08, 0.14e-3}, 2.4, 0.56, 2e-3, 30e-3);
  std::vector<double> x, y, depth;
  for (int i = 0; i <= 560; ++i) x.push_back(1e-3 * i);
  for (int j = -20; j <= 20; ++j) y.push_back(1.5e-3 * j);
  for (const double across : y)
    for (const double along : x) depth.push_back(sine.depth(2.4 + along, 2e-3 + across));
  const Corrugation map(measured_map(x, y, depth, 2e-3), 2.4, 2e-3, 30e-3);
  EXPECT_EQ(map.first(), 2.4);
  EXPECT_NEAR(map.last(), 2.96, 1e-12);
  EXPECT_NEAR(map.deepest(), 0.14e-3, 1e-9);
  for (const double at : {2.3999, 2.4103, 2.5555, 2.9601})
    for (const double across : {-0.03, -0.0121, 0.0, 0.002, 0.0177, 0.0321})
      EXPECT_NEAR(map.depth(at, across), sine.depth(at, across), 0.2e-6) << at << " " << across;
  // Another row far from the middle is another surface.
  EXPECT_FALSE(first_difference(map, sine, 3, 0.5e-6));
  for (std::size_t i = 0; i < x.size(); ++i) depth[5 * x.size() + i] += 1e-6 * std::min(1.0, 1e2 * x[i]);
  const Corrugation other(measured_map(x, y, depth, 2e-3), 2.4, 2e-3, 30e-3);
  EXPECT_TRUE(first_difference(map, other, 3, 0.5e-6));
}

TEST(Corrugation, ADifferenceInOneRowOfAMapIsFound) {
  const std::vector<double> x = {0, 1e-3, 2e-3};
  std::vector<double> y;
  for (int j = -40; j <= 40; ++j) y.push_back(0.5e-3 * j);
  const std::vector<double> flat(x.size() * y.size(), 0.0);
  const auto placed = [&](const std::vector<double>& depth) {
    return Corrugation(measured_map(x, y, depth, 1e-3), 2.4, 1e-3, 20e-3);
  };
  for (std::size_t row = 1; row + 1 < y.size(); ++row) {
    std::vector<double> dented = flat;
    dented[row * x.size() + 1] = 50e-6;
    EXPECT_TRUE(first_difference(placed(flat), placed(dented), 2.41, 1e-9)) << row;
  }
}

}  // namespace
}  // namespace tread
