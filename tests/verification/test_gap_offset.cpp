// A corrugation as an offset of the contact gap against one of moved nodes. [theory.md, eq. 9d]

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "drivers/verify/ride.hpp"
#include "tests/measured.hpp"
#include "tests/tyre_scene.hpp"

namespace tread {
namespace {

// The slope is steep enough to show in F_L: at most pi d / L = 6.3e-3.
constexpr double kWavelength = 0.04;  // [m]
constexpr double kDepth = 0.08e-3;    // [m]

RunResults roll(const std::string& apply, const std::vector<std::string>& more) {
  std::vector<std::string> overrides = {"scene.element_size=4 mm",      "motion.duration=1.5 ms",
                                        "solution_zone.start=5 mm",     "solution_zone.length=140 mm",
                                        "corrugation.wavelength=40 mm", "corrugation.depth=0.08 mm",
                                        "corrugation.width=30 mm",      "corrugation.start=30 mm",
                                        "corrugation.length=80 mm",     "corrugation.apply=" + apply};
  overrides.insert(overrides.end(), more.begin(), more.end());
  Model model(samples::tyre_scene(overrides));
  return ride(model, 300, [](const std::string&) {});
}

using Value = double (*)(const Sample&);

double range(const RunResults& results, Value value) {
  const auto [low, high] =
      std::minmax_element(results.samples.begin(), results.samples.end(),
                          [&](const Sample& a, const Sample& b) { return value(a) < value(b); });
  return value(*high) - value(*low);
}

/// Largest difference at equal instants: moved nodes make another step.
double largest_difference(const RunResults& a, const RunResults& b, Value value) {
  double largest = 0;
  std::size_t i = 0;
  for (const Sample& sample : a.samples) {
    while (i + 1 < b.samples.size() && b.samples[i + 1].time < sample.time) ++i;
    if (i + 1 == b.samples.size()) break;
    const Sample& before = b.samples[i];
    const Sample& after = b.samples[i + 1];
    const double share = (sample.time - before.time) / (after.time - before.time);
    const double other = (1 - share) * value(before) + share * value(after);
    largest = std::max(largest, std::abs(value(sample) - other));
  }
  return largest;
}

const Value kNormal = [](const Sample& s) { return s.vertical_force; };
const Value kLongitudinal = [](const Sample& s) { return s.longitudinal_force; };

TEST(GapOffset, IsTheSlopeThatPushesTheWheelWithoutFriction) {
  const RunResults gap = roll("gap", {"contact.friction=0"});
  const RunResults nodes = roll("nodes", {"contact.friction=0"});
  const double slope = std::numbers::pi * kDepth / kWavelength;
  // Without friction F_L comes from the slope alone: on the flank, the pressure acts along the wheel's
  // normal.
  const Value share = [](const Sample& s) { return s.longitudinal_force / s.vertical_force; };
  measured("range of F_L / F_N over that of the slope", range(gap, share) / (2 * slope));
  measured("gap against nodes, F_N over its range",
           largest_difference(gap, nodes, kNormal) / range(nodes, kNormal));
  measured("gap against nodes, F_L over its range",
           largest_difference(gap, nodes, kLongitudinal) / range(nodes, kLongitudinal));
  measured("energy error, gap", gap.energy_error);
  // The patch averages over a third of the wave.
  EXPECT_GT(range(gap, share), 0.8 * 2 * slope);
  EXPECT_LT(range(gap, share), 2 * slope);
  EXPECT_LT(largest_difference(gap, nodes, kNormal), 0.002 * range(nodes, kNormal));
  EXPECT_LT(largest_difference(gap, nodes, kLongitudinal), 0.01 * range(nodes, kLongitudinal));
  EXPECT_LT(gap.energy_error, 0.005);
  EXPECT_LT(gap.momentum_error, 1e-4);
}

TEST(GapOffset, UnderTractionAsWithMovedNodes) {
  const std::vector<std::string> traction = {"motion.traction.torque=13.8 kN m",
                                             "motion.traction.ramp=0.3 ms"};
  const RunResults gap = roll("gap", traction);
  const RunResults nodes = roll("nodes", traction);
  const Value work = [](const Sample& s) { return s.energy.frictional_work; };
  measured("gap against nodes, F_N over its range",
           largest_difference(gap, nodes, kNormal) / range(nodes, kNormal));
  measured("gap against nodes, F_L over its range",
           largest_difference(gap, nodes, kLongitudinal) / range(nodes, kLongitudinal));
  measured("gap against nodes, frictional work at the end - 1",
           work(gap.samples.back()) / work(nodes.samples.back()) - 1);
  measured("energy error, gap", gap.energy_error);
  measured("energy error, nodes", nodes.energy_error);
  EXPECT_LT(largest_difference(gap, nodes, kNormal), 0.002 * range(nodes, kNormal));
  EXPECT_LT(largest_difference(gap, nodes, kLongitudinal), 0.01 * range(nodes, kLongitudinal));
  EXPECT_NEAR(work(gap.samples.back()), work(nodes.samples.back()), 0.003 * work(nodes.samples.back()));
  EXPECT_LT(gap.energy_error, 0.005);
}

}  // namespace
}  // namespace tread
