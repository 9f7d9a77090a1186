#include <gtest/gtest.h>

#include "core/error.hpp"
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

TEST(Floor, JudgesWhereAShareOfTheReferenceIsLess) {
  const Finding tiny = judged_above_floor({"amplitude", "%", 0.22, 0.1}, 0.15, 0.3);
  EXPECT_NEAR(tiny.error(), 0.12, 1e-12);
  EXPECT_TRUE(tiny.pass());
  EXPECT_FALSE(judged_above_floor({"amplitude", "%", 0.42, 0.1}, 0.15, 0.3).pass());
  const Finding large = judged_above_floor({"amplitude", "%", 3.71, 4.64}, 0.15, 0.3);
  EXPECT_NEAR(large.error(), -0.2, 1e-3);
  EXPECT_FALSE(large.pass());
}

TEST(Refusal, CountsWithItsPartsAlone) {
  const auto act = [] { throw InputError("mu cannot be reached"); };
  EXPECT_TRUE(refused(act, {"mu", "cannot be reached"}));
  EXPECT_FALSE(refused(act, {"times as stiff"}));
}

TEST(BesideRecord, JudgesTheDistanceFromTheRecordedDifference) {
  const Finding finding = beside_record({"force", "%", 2.1, 2.4, 0.15}, -0.12, 0.03);
  EXPECT_EQ(finding.quantity, "force, against the reference -12 %");
  EXPECT_DOUBLE_EQ(finding.reference, 0.88 * 2.4);
  EXPECT_TRUE(finding.pass());
  const Finding overshoot = beside_record({"overshoot", "-", 0.08, 0.08, 0.05, true}, -0.04, 0.01);
  EXPECT_DOUBLE_EQ(overshoot.reference, 0.04);
  EXPECT_FALSE(overshoot.pass());
}

}  // namespace
}  // namespace tread
