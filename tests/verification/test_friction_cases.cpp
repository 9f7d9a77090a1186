// Small variants of the cases of tread verify that rub.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "drivers/verify/verify_case.hpp"
#include "tests/measured.hpp"

namespace tread {
namespace {

using Changes = std::vector<std::pair<std::string, std::string>>;

class FrictionCases : public ::testing::Test {
 protected:
  void run(const std::string& name, const Changes& changes) {
    const std::vector<VerifyCase>& cases = verify_cases();
    const auto found =
        std::find_if(cases.begin(), cases.end(), [&](const VerifyCase& c) { return c.name == name; });
    ASSERT_NE(found, cases.end());
    VerifyInputs inputs(found->inputs);
    for (const auto& [input, value] : changes) ASSERT_TRUE(inputs.set(input, value)) << input;
    result_ = found->run(inputs, [](const std::string&) {});
    for (const Finding& f : result_.findings) measured(f.quantity + ", error", f.error());
  }
  double error(const std::string& quantity) const {
    for (const Finding& f : result_.findings)
      if (f.quantity == quantity) return f.error();
    ADD_FAILURE() << quantity;
    return 0;
  }

 private:
  CaseResult result_;
};

TEST_F(FrictionCases, SpherePushedAndPulled) {
  run("cattaneo_mindlin", {{"element_size", "4 mm"}, {"push", "0.7"}, {"ramp", "1 ms"}});
  EXPECT_LT(std::abs(error("shift")), 0.06);
  EXPECT_LT(std::abs(error("shift at half of the force")), 0.06);
  EXPECT_LT(std::abs(error("stick radius")), 2);
  EXPECT_LT(std::abs(error("work of the loop")), 0.25);
  EXPECT_LT(error("energy residual / frictional work"), 1e-3);
}

TEST_F(FrictionCases, ShiftThenRolling) {
  run("transient", {{"element_size", "3.6 mm"}, {"way", "1"}, {"growth", "0.3"}});
  EXPECT_LT(error("largest difference of the creepages / steady value"), 0.3);
  EXPECT_LT(std::abs(error("smallest F_L / F_N under the full torque")), 0.1);
}

TEST_F(FrictionCases, StressOfSurfaceElements) {
  run("von_mises", {{"element_size", "3.4 mm"}, {"speed", "15 m/s"}, {"ramp", "0.6 ms"}});
  EXPECT_LT(std::abs(error("Von Mises stress at rest, no friction")), 0.06);
  EXPECT_LT(std::abs(error("Von Mises stress, rolling")), 0.1);
}

}  // namespace
}  // namespace tread
