// A wheel without a rail: what it keeps while it moves, and its natural modes; small variants of `tread
// verify`.

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "drivers/verify/ring_theory.hpp"
#include "drivers/verify/verify_case.hpp"
#include "tests/measured.hpp"

namespace tread {
namespace {

using Setting = std::pair<const char*, const char*>;

void expect_bounds_hold(const std::string& name, const std::vector<Setting>& settings) {
  for (const VerifyCase& c : verify_cases()) {
    if (c.name != name) continue;
    VerifyInputs inputs(c.inputs);
    for (const auto& [input, value] : settings) ASSERT_TRUE(inputs.set(input, value)) << input;
    const CaseResult result = c.run(inputs, [](const std::string&) {});
    EXPECT_FALSE(result.findings.empty());
    EXPECT_FALSE(result.figures.empty());
    for (const Finding& f : result.findings) {
      measured(f.quantity, f.value, f.unit);
      EXPECT_TRUE(f.pass()) << f.quantity << ": " << f.value << " against " << f.reference;
    }
    return;
  }
  FAIL() << "no case " << name;
}

TEST(FreeWheel, DoesNotDriftInItsFrame) {
  expect_bounds_hold("moving_frames", {{"steps", "3000"},
                                       {"rolling_steps", "2000"},
                                       {"radius", "0.25 m"},
                                       {"rolling_element_size", "4 mm"},
                                       {"semi_axis", "12 mm"}});
}

TEST(FreeWheel, RingHasTheModesOfElasticity) {
  expect_bounds_hold("ring_modes", {{"element_size", "12 mm"}, {"thickness", "80 mm"}});
}

TEST(FreeWheel, WheelsetKeepsItsModesUnderRefinement) {
  expect_bounds_hold("wheelset_modes",
                     {{"element_size", "6.5 mm"}, {"coarse_element_size", "8.5 mm"}, {"modes", "8"}});
}

TEST(FreeWheel, ThickRingTheoryEndsInTheThinRing) {
  for (const int waves : {2, 3, 5}) {
    const PlaneRing thin{0.43 - 0.002, 0.43, 205.9e9, 0.3, 7790};
    EXPECT_NEAR(exact_ring_frequency(thin, waves) / thin_ring_frequency(thin, waves), 1, 1e-3);
    const PlaneRing thick{0.43 - 0.06, 0.43, 205.9e9, 0.3, 7790};
    EXPECT_LT(exact_ring_frequency(thick, waves), thin_ring_frequency(thick, waves));
  }
}

}  // namespace
}  // namespace tread
