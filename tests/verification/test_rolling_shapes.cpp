// A tyre that rolls slowly over a dip of the rail and its own flat against the depth that a rigid wheel
// traces. [theory.md, Surfaces]

#include <gtest/gtest.h>

#include <string>

#include "drivers/engine/model/surfaces.hpp"
#include "drivers/verify/ride.hpp"
#include "tests/measured.hpp"
#include "tests/tyre_scene.hpp"

namespace tread {
namespace {

/// Share of the traced depth by which the axle sinks between two places [m], by least squares [-].
double followed(const RunResults& results, const Scene& scene, double first, double last) {
  const RunningSurface rail = rail_surface(scene), wheel = wheel_surface(scene);
  const double start = results.samples.front().wheel_z;
  double both = 0, square = 0;
  for (const Sample& sample : results.samples) {
    if (sample.wheel_x < first || sample.wheel_x > last) continue;
    const double depth = traced_depth(rail, wheel, 0.5 * scene.wheel->diameter, sample.wheel_x, 0);
    both += depth * (start - sample.wheel_z);
    square += depth * depth;
  }
  return both / square;
}

TEST(RollingShapes, LowerTheAxleByTheTracedDepth) {
  const Scene scene = samples::tyre_scene(
      {"scene.element_size=8 mm", "scene.gravity=0 m/s2", "solution_zone.start=-10 mm",
       "solution_zone.length=200 mm", "wheel.bore=guided", "wheel.overhang=40 mm", "contact.friction=0",
       "motion.speed=10 m/s", "motion.duration=17.5 ms", "surface.dip.kind=dip", "surface.dip.at=60 mm",
       "surface.dip.length=80 mm", "surface.dip.depth=0.2 mm", "surface.flat.kind=flat",
       "surface.flat.at=145 mm", "surface.flat.length=40 mm"});
  Model model(scene);
  const RunResults results = ride(model, 1000, [](const std::string&) {});
  const double over_dip = followed(results, scene, 0.02, 0.1),
               over_flat = followed(results, scene, 0.125, 0.165);
  measured("axle over a dip of the rail, share of the traced depth", over_dip);
  measured("axle over a flat of the wheel, share of the traced depth", over_flat);
  // The axle swings on the contact's spring. Places 10 mm off give 0.87 and 0.53, half the depths 2.
  EXPECT_NEAR(over_dip, 1, 0.1);
  EXPECT_NEAR(over_flat, 1, 0.15);
}

}  // namespace
}  // namespace tread
