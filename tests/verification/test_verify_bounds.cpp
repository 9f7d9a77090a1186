// Bounds of verification cases that depend on the inputs.

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "drivers/verify/cases.hpp"

namespace tread {
namespace {

std::vector<Finding> findings(const VerifyCase& verified,
                              const std::vector<std::pair<std::string, std::string>>& changes) {
  VerifyInputs inputs(verified.inputs);
  for (const auto& [name, value] : changes) EXPECT_TRUE(inputs.set(name, value)) << name;
  return verified.run(inputs, [](const std::string&) {}).findings;
}

TEST(VerifyBounds, AreATenthOfWhatABridgedTroughTakesFromTheDepth) {
  const Finding gain =
      findings(contact_filter_case(),
               {{"wavelength", "50 mm"}, {"depth", "1 mm"}, {"load", "300 kN"}, {"element_size", "5.4 mm"}})
          .front();
  EXPECT_NEAR(gain.reference, 0.454, 1e-3);
  constexpr double kFineness = 5.4 / 1.1 * 5.25 / 7.915;  // the patch's shorter semi-axis is 7.915 mm
  EXPECT_NEAR(gain.bound.value(), 0.1 * (1 - gain.reference) * kFineness, 1e-3);
  EXPECT_TRUE(gain.pass()) << gain.value;
}

TEST(VerifyBounds, AreAbsentWhereElementsDoNotResolveThePatch) {
  int judged = 0;
  for (const Finding& finding :
       findings(profiles_in_contact_case(), {{"element_size", "8 mm"}, {"first", "8 mm"}, {"last", "8 mm"}}))
    judged += finding.bound.has_value() ? 1 : 0;
  EXPECT_EQ(judged, 2);  // the force and the pressure's middle
}

}  // namespace
}  // namespace tread
