// Bounds of verification cases that depend on the inputs, and the free rolling that they subtract.

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "drivers/verify/cases.hpp"
#include "drivers/verify/roll_tyre.hpp"

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

TEST(FreeCreepage, LiesMidwayBetweenDrivingAndBraking) {
  TyreOnBlock bodies = driven_tyre(VerifyInputs(driven_inputs(3.5e-3)));
  const auto silent = [](const std::string&) {};
  const double observed = 4 * bodies.hertz_patch().semi_axis_x;
  constexpr double speed = 60, way = 60e-3, ramp = 0.4e-3;  // [m/s, m, s]
  const auto creepage = [&](double mu) {
    bodies.roll_on(speed, way, observed, smooth_traction(mu, ramp));
    return roll_tyre(bodies, observed, silent).creepage;
  };
  const double driven = creepage(0.1);
  const double braked = creepage(-0.1);
  // The spin at the start lies further off.
  EXPECT_NEAR(free_creepage(bodies, speed, way, observed, silent), 0.5 * (driven + braked),
              0.01 * (driven - braked));
}

}  // namespace
}  // namespace tread
