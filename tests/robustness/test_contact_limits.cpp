// Contact at the ends of its range is refused with the reason.

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "drivers/engine/start/preload.hpp"
#include "drivers/results/rail_ends.hpp"
#include "tests/refusal.hpp"
#include "tests/tyre_scene.hpp"

namespace tread {
namespace {

using samples::expect_part;

Preload preload_of(Model& model) {
  return solve_preload(model, steady_motion(model), [](const std::string&) {});
}

/// The message of building and preloading the tyre; empty where nothing is wrong.
std::string outcome(const std::vector<std::string>& overrides) {
  return samples::refusal([&] {
    Model model(samples::tyre_scene(overrides));
    preload_of(model);
  });
}

TEST(ContactLimits, TooStiffAPenaltyIsRefusedWithTheLeastRatio) {
  const Model model(samples::tyre_scene());
  const HertzPatch& patch = model.hertz_patch;
  const double ratio = patch.max_pressure / (patch.approach * model.contact->options().penalty);
  const auto key = [&](double times) { return "contact.penetration_ratio=" + std::to_string(ratio / times); };
  EXPECT_NO_THROW(Model(samples::tyre_scene({key(9)})));
  expect_part(outcome({key(12)}), "the penalty is 12 times as stiff as suits elements of 5 mm");
}

TEST(ContactLimits, AnythingThatPressesMustBeThere) {
  expect_part(outcome({"load.present=false", "scene.gravity=0 m/s2"}),
              "nothing presses the wheel on the rail");
  expect_part(
      outcome({"load.present=false", "scene.gravity=0 m/s2", "vehicle.sprung_mass=8000 kg",
               "vehicle.unsprung_mass=300 kg", "vehicle.stiffness=1 MN/m", "vehicle.damping=1 kN s/m"}),
      "a vehicle without weight presses no wheel on the rail");
  EXPECT_EQ(outcome({"load.wheel_load=10 kN"}), "");
}

TEST(ContactLimits, CreepageNeedsASpeedAndARimThatHolds) {
  expect_part(outcome({"motion.speed=0 m/s", "motion.creepage=0.1"}), "a wheel that stands has no creepage");
  expect_part(outcome({"motion.creepage=1.9"}), "the wheel's rim moves at 3250 m/s");
}

TEST(ContactLimits, LoadsThatBendTheRingTooFarAreNamed) {
  expect_part(outcome({"load.wheel_load=4 MN"}), "under the wheel load of 4001 kN");
}

TEST(ContactLimits, LoadTooSmallForTheMeshIsNamed) {
  const std::string message = outcome({"load.wheel_load=0.01 N", "scene.gravity=0 m/s2"});
  expect_part(message, "the wheel load of 0.01 N");
}

TEST(ContactLimits, DepthsThatKeepTheBodiesApartAreNamed) {
  const std::string message =
      outcome({"motion.speed=0 m/s", "surface.worn.kind=polygon", "surface.worn.at=0 m",
               "surface.worn.order=1000", "surface.worn.depth=0.5 mm"});
  expect_part(message, "no integration point of the rail touches the wheel");
  expect_part(message, "or the depths of surface.worn keep rail and wheel apart");
}

TEST(ContactLimits, ARimThatIsTooThinIsNamed) {
  EXPECT_EQ(
      outcome({"wheel.thickness=1 mm"}),
      "wheel.thickness = 1 mm: the running surface falls by 1.504 mm to its ends; state 11.6 mm at least, "
      "which leaves room for 2 layers of 5 mm");
  expect_part(outcome({"wheel.thickness=5 mm"}),
              "an element_size of 1.748 mm at most fits, or wheel.thickness = 11.6 mm at least");
  expect_part(outcome({"rail.height=1 mm", "rail.crown_radius=0.3 m"}), "rail.height = 1 mm: the running");
}

TEST(ContactLimits, HeavyLoadsAreSearchedForFarEnough) {
  // Hertz: semi-axes grow with the cube root of the load, here to 17 mm along the rail, where the undeformed
  // surfaces are 0.35 mm apart.
  Model model(samples::tyre_scene({"load.wheel_load=1.5 MN", "motion.speed=0 m/s", "wheel.thickness=200 mm",
                                   "rail.width=120 mm", "wheel.width=120 mm"}));
  const Preload preload = preload_of(model);
  EXPECT_NEAR(-preload.contact.force_on_rail.z, model.wheel_load(), 1e-6 * model.wheel_load());
  const HertzPatch& patch = model.hertz_patch;
  EXPECT_NEAR(preload.contact.area, M_PI * patch.semi_axis_x * patch.semi_axis_y, 0.1 * preload.contact.area);
}

/// Carter's half width a: the window ends where the gap is three times a^2 / 2R.
TEST(ContactLimits, NarrowLineContactsAreSearchedForFarEnough) {
  Scene disc =
      samples::tyre_scene({"wheel.diameter=0.4 m", "wheel.width=10 mm", "rail.width=10 mm",
                           "load.wheel_load=400 kN", "scene.gravity=0 m/s2", "scene.element_size=3 mm"});
  disc.wheel->profile = "cylinder";
  const Model model(disc);
  ASSERT_NEAR(model.line_load(), 400e3 / 0.01, 1);
  const double half_width = model.line_semi_axis();
  ASSERT_GT(half_width, 9e-3);
  EXPECT_NEAR(model.contact->reach(), std::sqrt(3) * half_width, 1e-6);
}

/// The scene's check leaves 20 mm to the rail's end, x = 0.3 m.
TEST(ContactLimits, AWayNeedsRailForTheSearch) {
  const auto scene_of = [](std::vector<std::string> overrides) {
    overrides.insert(overrides.end(), {"scene.element_size=12 mm", "motion.duration=3.35 ms"});
    return samples::tyre_scene(overrides);
  };
  const auto refusal = [](const Scene& scene) {
    return samples::refusal<InputError>([&] { require_way_on_rail(Model(scene)); });
  };
  EXPECT_EQ(refusal(scene_of({})), "");
  const std::string large = refusal(scene_of({"wheel.diameter=1.2 m"}));
  expect_part(large, "rolls to x = 0.279167 m, but its axis has to stay within x = -0.0780911 to 0.278091 m");
  expect_part(large, "state a shorter motion.duration, or rail.length = \"0.6 m\"");
  expect_part(refusal(scene_of({"surface.dip.kind=dip", "surface.dip.at=75 mm", "surface.dip.depth=2 mm",
                                "surface.dip.length=0.2 m"})),
              "rolls to x = 0.279167 m");
  expect_part(refusal(scene_of({"wheel.diameter=1.2 m", "rail.origin=21 mm"})),
              "the wheel stands at x = 0 m");

  const Model wide(scene_of({"wheel.diameter=1.2 m"}));
  EXPECT_EQ(keys_for_way(wide, 0.278), "");
  EXPECT_EQ(keys_for_way(wide, 0.2785), "rail.length = \"0.6 m\"");
  EXPECT_EQ(refusal(scene_of({"wheel.diameter=1.2 m", "rail.length=0.6 m"})), "");

  const Scene rough =
      scene_of({"corrugation.start=55 mm", "corrugation.length=40 mm", "corrugation.wavelength=40 mm"});
  expect_part(refusal(rough), "rolls to x = 0.279167 m");
  const Model smooth(rough), corrugated(rough, 0.0);
  EXPECT_EQ(searched_reach(smooth), corrugated.contact->reach());
  EXPECT_GT(searched_reach(smooth), 1.1 * smooth.contact->reach());
}

TEST(ContactLimits, AWheelThatTurnsBackNeedsAnotherOrigin) {
  Scene scene = samples::tyre_scene({"scene.element_size=12 mm", "motion.traction.mu=-0.4"});
  scene.motion->speed = 0;
  scene.motion->ramp = 0;
  scene.motion->duration = 20e-3;
  const Model model(scene);
  expect_part(samples::refusal<InputError>([&] { require_way_on_rail(model); }), "or a larger rail.origin");
  for (const double x : {-0.09, 0.29}) {
    BodyFrame wheel;
    wheel.origin.x = x;
    expect_part(samples::refusal<NumericalError>([&] { model.contact->searching().aim(wheel, 1e-7); }),
                x < 0 ? "or state a larger rail.origin" : "or lengthen rail.length");
  }
}

TEST(ContactLimits, PatchAtTheEndOfTheSearchedSurfaceStops) {
  Model model(samples::tyre_scene());
  const Preload preload = preload_of(model);
  ContactOptions narrow = model.contact->options();
  narrow.reach_gap = 2e-5;  // the patch's own border is 5e-5 m from closing
  Contact contact(model.mesh, narrow, Corrugation{});
  contact.find_static({preload.displacement.data(), nullptr, &preload.wheel});
  EXPECT_THROW(contact.require_room(preload.wheel), NumericalError);
  model.contact->require_room(preload.wheel);
  // The force is said to be too large only where it is.
  const auto refusal = [&](double expected, bool yields) {
    narrow.static_force = expected;
    narrow.yields = yields;
    Contact other(model.mesh, narrow, Corrugation{});
    other.find_static({preload.displacement.data(), nullptr, &preload.wheel});
    return samples::refusal<NumericalError>([&] { other.require_room(preload.wheel); });
  };
  expect_part(refusal(0.3 * model.wheel_load(), false), "is beyond what the wheel load of");
  for (const bool yields : {false, true}) {
    const std::string message = refusal(model.wheel_load(), yields);
    expect_part(message, "is no reason for that");
    expect_part(message, "wheel.crown_radius");
    EXPECT_EQ(message.find("yield_stress") != std::string::npos, yields) << message;
  }
  EXPECT_EQ(model.contact->options().static_force, model.wheel_load());
}

TEST(ContactLimits, AFlatCrownIsNotTakenForALargeForce) {
  const std::string message = outcome({"wheel.crown_radius=1000 m"});
  expect_part(message, "is no reason for that: the surfaces touch over more of their length or width");
  EXPECT_EQ(message.find("is beyond what"), std::string::npos) << message;
}

TEST(ContactLimits, ALoadTooLargeForTheBlockAtRestIsNamed) {
  const std::string message =
      outcome({"motion.present=false", "solution_zone.start=-12 mm", "solution_zone.length=24 mm",
               "load.wheel_load=10 MN", "rail.length=0.1 m", "rail.origin=0.05 m"});
  expect_part(message, "state a lower load");
  EXPECT_EQ(message.find("motion.duration"), std::string::npos) << message;
}

}  // namespace
}  // namespace tread
