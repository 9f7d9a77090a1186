// Inputs of verification cases that leave nothing to compare.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/error.hpp"
#include "drivers/verify/verification.hpp"
#include "tests/refusal.hpp"

namespace tread {
namespace {

std::string refusal(const std::string& name, const std::vector<std::string>& overrides) {
  VerifyOptions options;
  options.names = {name};
  options.overrides = overrides;
  options.quiet = true;
  return samples::refusal<InputError>([&] { verify(options); });
}

TEST(VerifyInputs, ThatLeaveNoPlaceOfTheProfilesAreRefused) {
  const std::string offsets = "verify: none of the offsets, 1, 2, 4, 5, 6, 8, 10 mm, lies between ";
  const std::string advice = "; state a smaller first or a larger last";
  EXPECT_EQ(refusal("profiles_in_contact", {"first=8.5 mm", "last=9.5 mm"}),
            offsets + "first = 8.5 mm and last = 9.5 mm" + advice);
  EXPECT_EQ(refusal("profiles_in_contact", {"first=6 mm", "last=2 mm"}),
            offsets + "first = 6 mm and last = 2 mm" + advice);
}

TEST(VerifyInputs, ThatTheModelCannotShowAreRefused) {
  const std::string brief = refusal("rail_waves", {"length=10 m"});
  EXPECT_TRUE(brief.starts_with("verify: duration = 20 ms is shorter than half a period, 96.")) << brief;
  EXPECT_TRUE(brief.ends_with(" of length = 10 m; state a longer duration or a shorter rail")) << brief;
  EXPECT_EQ(
      refusal("contact_filter", {"wavelength=10 mm"}),
      "verify: at depth = 0.14 mm and wavelength = 10 mm the wheel in a trough touches further waves, which "
      "the finite elements do not have; state a longer wavelength or a smaller depth or load");
}

TEST(VerifyInputs, BeyondTheirRangeAreRefusedWithTheRange) {
  EXPECT_EQ(refusal("ring_modes", {"thickness=20 mm", "element_size=10 mm"}),
            "verify: thickness = 20 mm must lie between 33.3 mm, for which the elements of 10 mm are small "
            "enough, and 258 mm, 0.6 of the radius");
  EXPECT_EQ(refusal("ring_modes", {"thickness=2 m"}),
            "--set thickness = 2 m: the ring's thickness must lie between 1 mm and 1000 mm");
}

TEST(VerifyInputs, ThatMakeTheReferenceZeroAreRefused) {
  EXPECT_EQ(refusal("carter", {"exploitation=0"}), "verify: exploitation is zero: no traction to compare");
  EXPECT_EQ(refusal("steady_rolling", {"mu=0"}),
            "verify: mu = 0 is zero or not below 0.95 of friction = 0.5");
  EXPECT_EQ(refusal("sliding", {"creepage=0"}), "verify: creepage is zero: the wheel does not slide");
}

}  // namespace
}  // namespace tread
