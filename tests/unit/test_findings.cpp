#include <gtest/gtest.h>

#include "drivers/verify/verify_case.hpp"

namespace tread {
namespace {

TEST(SlipZone, BoundGrowsWithTheElementOverTheZone) {
  const Finding work{"work", "J", 1.06, 1.0};
  const Finding fine = judged_by_slip_zone(work, 0.2, 1e-3, 4e-3);
  ASSERT_TRUE(fine.bound);
  EXPECT_DOUBLE_EQ(*fine.bound, 0.05);
  EXPECT_FALSE(fine.pass());
  const Finding coarse = judged_by_slip_zone(work, 0.2, 2e-3, 4e-3);
  EXPECT_DOUBLE_EQ(*coarse.bound, 0.1);
  EXPECT_TRUE(coarse.pass());
}

TEST(SlipZone, NarrowerThanAnElementIsNotResolved) {
  const Finding finding = judged_by_slip_zone({"work", "J", 2.0, 1.0}, 0.2, 4e-3, 2e-3);
  EXPECT_FALSE(finding.bound);
  EXPECT_EQ(finding.quantity, "work, not resolved: 0.50 elements slip");
}

}  // namespace
}  // namespace tread
