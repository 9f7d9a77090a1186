// Small variants of those cases of `tread verify` that have friction.

#include <gtest/gtest.h>

#include <cmath>

#include "tests/verified_case.hpp"

namespace tread {
namespace {

TEST(FrictionCases, SpherePushedAndPulled) {
  const CaseResult result =
      run_case("cattaneo_mindlin", {{"element_size", "4 mm"}, {"push", "0.7"}, {"ramp", "1 ms"}});
  EXPECT_LT(std::abs(error_of(result, "shift")), 0.06);
  EXPECT_LT(std::abs(error_of(result, "shift at half of the force")), 0.06);
  EXPECT_LT(std::abs(error_of(result, "stick radius")), 2);
  EXPECT_LT(std::abs(error_of(result, "work of the loop")), 0.25);
  EXPECT_LT(error_of(result, "energy residual / frictional work"), 1e-3);
}

TEST(FrictionCases, ShiftThenRolling) {
  const CaseResult result =
      run_case("transient", {{"element_size", "3.6 mm"}, {"way", "1"}, {"growth", "0.3"}});
  EXPECT_LT(error_of(result,
                     "largest difference of the creepages from the curve scaled to the limit of fine "
                     "grids / steady value"),
            0.3);
  EXPECT_LT(std::abs(error_of(result, "smallest F_L / F_N under the full torque")), 0.1);
}

TEST(FrictionCases, StressOfSurfaceElements) {
  const CaseResult result =
      run_case("von_mises", {{"element_size", "3.4 mm"}, {"speed", "15 m/s"}, {"ramp", "0.6 ms"}});
  EXPECT_LT(std::abs(error_of(result, "Von Mises stress at rest, no friction")), 0.06);
  EXPECT_LT(std::abs(error_of(result, "Von Mises stress, rolling")), 0.1);
}

}  // namespace
}  // namespace tread
