// A wheel without a rail: conserved quantities of its motion, and its natural modes; small variants of `tread
// verify`.

#include <gtest/gtest.h>

#include "drivers/verify/ring_theory.hpp"
#include "tests/verified_case.hpp"

namespace tread {
namespace {

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
