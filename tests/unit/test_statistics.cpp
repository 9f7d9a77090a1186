#include <gtest/gtest.h>

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

}  // namespace
}  // namespace tread
