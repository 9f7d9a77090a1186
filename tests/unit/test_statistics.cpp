#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "core/math/interpolation.hpp"
#include "core/math/statistics.hpp"

namespace tread {
namespace {

TEST(LineFit, PassesBetweenScatteredPoints) {
  LineFit line;
  // y = 3 + 2 x, with deviations that sum to zero alone and weighted with x.
  const double deviation[] = {0.5, -0.5, -0.5, 0.5};
  for (int i = 0; i < 4; ++i) line.add(i, 3 + 2 * i + deviation[i]);
  EXPECT_DOUBLE_EQ(line.slope(), 2);
  EXPECT_DOUBLE_EQ(line.rise(3), 6);
}

TEST(LineFit, KeepsItsDigitsFarFromZero) {
  LineFit line;
  for (int i = 0; i < 4; ++i) line.add(1e9 + i, 3 + 2 * i);
  EXPECT_DOUBLE_EQ(line.slope(), 2);
  EXPECT_DOUBLE_EQ(line.mean(), 6);
}

TEST(LineFit, HasNoRiseAtOneAbscissa) {
  LineFit line;
  for (int i = 0; i < 7; ++i) line.add(0.1, i);
  EXPECT_TRUE(std::isnan(line.rise(1)));
}

TEST(Statistics, SmallScatterAboutALargeMeanKeepsItsDigits) {
  std::vector<double> values;
  for (int i = 0; i < 1000; ++i) values.push_back(8e7 + (i % 2 == 0 ? 0.25 : -0.25));
  EXPECT_DOUBLE_EQ(statistics(values).deviation, 0.25);
}

TEST(Statistics, MedianOfAnEvenNumberIsTheMeanOfTheMiddleTwo) {
  EXPECT_EQ(median({3, 1, 2}), 2);
  EXPECT_EQ(median({4, 1, 7, 2}), 3);
}

TEST(Statistics, AConstantCurveHasNoCorrelation) {
  std::vector<double> varying, constant, rounded;
  for (int i = 0; i < 1000; ++i) {
    varying.push_back(std::sin(0.1 * i));
    constant.push_back(0.1);
    rounded.push_back(0.1 * (i + 1) / (i + 1));
  }
  for (const std::vector<double>& flat : {constant, rounded}) {
    EXPECT_FALSE(correlation(varying, flat));
    EXPECT_FALSE(correlation(flat, varying));
  }
  EXPECT_FALSE(correlation({}, {}));
  std::vector<double> above;
  for (const double value : varying) above.push_back(1e6 + 1e-3 * value);
  EXPECT_NEAR(correlation(varying, above).value(), 1, 1e-9);
}

TEST(Interpolation, APlaceThatIsNanHasNoValue) {
  const double missing = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(value_at({0, 1}, {2, 4}, missing)));
  EXPECT_TRUE(std::isnan(value_at({0, 1}, {2, 4}, 1.01)));
  EXPECT_EQ(value_at({0, 1}, {2, 4}, 1), 4);
  EXPECT_EQ(value_at({0, 1}, {2, 4}, 0.5), 3);
}

}  // namespace
}  // namespace tread
