#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "core/travel.hpp"
#include "drivers/engine/model/model.hpp"
#include "io/scene/scene_reader.hpp"

namespace tread {
namespace {

Scene scene_of(const std::string& text) {
  return resolve_scene(SceneSource{"scene.toml", text, "."}, {}).scene;
}

/// Scene of the paper's wheelset, which carries 8340 kg; M_a = 340 kg of these moves with the wheelset, and
/// M_c unless it is free along x.
Scene wheelset(const std::string& motion, const std::string& longitudinal = "free") {
  return scene_of(
      "[scene]\nbased_on = \"highspeed-slab-2014\"\nelement_size = \"8 mm\"\n[vehicle]\nlongitudinal = \"" +
      longitudinal + "\"\n[motion]\n" + motion);
}

constexpr double kLoad = (8340 + 586) * 9.81;

TEST(Travel, IsSpeedTimesDurationWithoutTraction) {
  const Travel travel = travel_of(wheelset("speed = \"300 km/h\"\nduration = \"40 ms\""));
  EXPECT_EQ(travel.first, 0);
  EXPECT_NEAR(travel.last, 300 / 3.6 * 0.04, 1e-12);
  EXPECT_EQ(
      travel_of(scene_of("[scene]\nbased_on = \"highspeed-slab-2014\"\n[motion]\npresent = false")).last, 0);
}

TEST(Travel, BeginsARunUpBeforeTheZone) {
  const Travel travel = travel_of(wheelset("speed = \"300 km/h\"\nduration = \"12 ms\"\nrun_up = \"1.1 m\""));
  EXPECT_NEAR(travel.first, 1.3, 1e-12);
  EXPECT_NEAR(travel.last, 2.3, 1e-12);
}

/// The speed gained is a (t - T1/2) from T1 on.
TEST(Travel, TractionAddsToIt) {
  const double ramp = 0.01;
  const double rest = 0.1 - ramp;
  const std::string motion = "speed = \"100 km/h\"\nduration = \"100 ms\"\ntraction.ramp = \"10 ms\"\n";
  for (const auto& [longitudinal, mass] : {std::pair("free", 926.0), std::pair("carried", 8926.0)}) {
    SCOPED_TRACE(longitudinal);
    const double a = 0.3 * kLoad / mass;
    const double gained = a * (ramp * ramp / 6 + ramp / 2 * rest + rest * rest / 2);
    const double way = travel_of(wheelset(motion + "traction.mu = 0.3", longitudinal)).last;
    EXPECT_NEAR(way - 100 / 3.6 * 0.1, gained, 1e-6);
    EXPECT_NEAR(travel_of(wheelset(motion + "traction.mu = -0.3", longitudinal)).last,
                100 / 3.6 * 0.1 - gained, 1e-6);
    const std::string torque = fmt::format("traction.torque = \"{} N m\"", 0.3 * kLoad * 0.43);
    EXPECT_NEAR(travel_of(wheelset(motion + torque, longitudinal)).last, way, 1e-9);
  }
}

TEST(Travel, NoTorqueDrivesBeyondFriction) {
  const std::string motion = "speed = \"100 km/h\"\nduration = \"100 ms\"\n";
  const Travel bounded = travel_of(wheelset(motion + "traction.torque = \"200 kN m\""));
  EXPECT_NEAR(bounded.last, travel_of(wheelset(motion + "traction.mu = 0.5")).last, 1e-9);
}

/// Brakes from 1 m/s at 0.5 g' reverse the wheel: x = 1 t - a t^2/2.
TEST(Travel, BrakesTurnASlowWheelBack) {
  const double a = 0.5 * kLoad / 926;
  const Travel travel = travel_of(
      wheelset("speed = \"1 m/s\"\nduration = \"100 ms\"\ntraction.ramp = \"0 ms\"\ntraction.mu = -0.5"));
  EXPECT_NEAR(travel.last, 0.5 / a, 1e-5);
  EXPECT_NEAR(travel.first, 0.1 - 0.5 * a * 0.01, 1e-12);
}

/// A torque spins the wheel, of 586 kg, up or down, too; its inertia may be any up to that of a thin ring.
TEST(Travel, ATorqueSpinsTheWheelToo) {
  const double a = 0.5 * kLoad / 926, least = 0.5 * kLoad / (926 + 586);
  const auto braked = [](double torque) {
    return travel_of(
        wheelset(fmt::format("speed = \"1 m/s\"\nduration = \"100 ms\"\ntraction.ramp = \"0 "
                             "ms\"\ntraction.torque = \"{} N m\"",
                             torque)));
  };
  const Travel travel = braked(-0.5 * kLoad * 0.43);
  EXPECT_NEAR(travel.last, 0.5 / least, 1e-5);
  EXPECT_NEAR(travel.sure, 0.5 / a, 1e-5);
  EXPECT_NEAR(travel.first, 0.1 - 0.5 * a * 0.01, 1e-9);
  EXPECT_NEAR(braked(-2 * kLoad * 0.43).last, 0.5 / a, 1e-5) << "a locked wheel slides";
  const Travel driven = braked(0.5 * kLoad * 0.43);
  EXPECT_NEAR(driven.last, 0.1 + 0.5 * a * 0.01, 1e-9);
  EXPECT_NEAR(driven.sure, 0.1 + 0.5 * least * 0.01, 1e-9);
}

/// No wheel gets all of the torque where it drives and less where it brakes.
TEST(Travel, ReversalsOfATorqueAreThoseOfAForce) {
  const std::string motion =
      "speed = \"100 km/h\"\nduration = \"200 ms\"\ntraction.ramp = \"5 ms\"\ntraction.reversals = 19\n";
  const Travel force = travel_of(wheelset(motion + "traction.mu = 0.3"));
  const Travel torque =
      travel_of(wheelset(fmt::format("{}traction.torque = \"{} N m\"", motion, 0.3 * kLoad * 0.43)));
  EXPECT_GT(force.last, 100 / 3.6 * 0.2 + 0.01);
  EXPECT_EQ(force.sure, force.last);
  EXPECT_NEAR(torque.last, force.last, 1e-9);
  EXPECT_NEAR(torque.sure - 100 / 3.6 * 0.2, 926.0 / (926 + 586) * (force.last - 100 / 3.6 * 0.2), 1e-9);
}

/// The coefficient of friction falls to 0.2 where the patch slides.
TEST(Travel, FallingFrictionBrakesAndDrivesLess) {
  const auto travel = [](double mu) {
    Scene scene = wheelset(fmt::format(
        "speed = \"1 m/s\"\nduration = \"100 ms\"\ntraction.ramp = \"0 ms\"\ntraction.mu = {}", mu));
    scene.contact->friction_law = "falling";
    scene.contact->friction_fast = 0.2;
    return travel_of(scene);
  };
  const double a = 0.5 * kLoad / 926, least = 0.2 * kLoad / 926;
  EXPECT_NEAR(travel(-0.5).last, 0.5 / least, 1e-5);
  EXPECT_NEAR(travel(-0.5).sure, 0.5 / a, 1e-5);
  EXPECT_NEAR(travel(0.5).last, 0.1 + 0.5 * a * 0.01, 1e-9);
  EXPECT_NEAR(travel(0.5).sure, 0.1 + 0.5 * least * 0.01, 1e-9);
  EXPECT_EQ(travel(-0.2).last, travel(-0.2).sure);
}

/// Braking at its most stops the wheel of 1 m/s at 11 mm.
TEST(Travel, ADurationIsThatOfTheSureWay) {
  Scene scene = wheelset("speed = \"10 m/s\"\nduration = \"10 ms\"\ntraction.ramp = \"0 ms\"");
  scene.motion->traction_torque = -0.5 * kLoad * 0.43;
  scene.motion->duration = duration_to(scene, 0.4).value();
  EXPECT_GE(travel_of(scene).sure, 0.4);
  EXPECT_NEAR(travel_of(scene).sure, 0.4, 1e-3);
  scene.motion->speed = 1;
  ASSERT_GT(travel_of(scene).last, 0.015);
  EXPECT_FALSE(duration_to(scene, 0.015));
}

/// The first thousandth of an hour holds all of the way ahead.
TEST(Travel, ADurationIsFoundBeforeAnEarlyTurn) {
  Scene scene = wheelset("speed = \"10 m/s\"\nduration = \"1 ms\"\ntraction.ramp = \"0 ms\"");
  scene.motion->traction_mu = -0.5;
  scene.motion->duration = 3600;
  const double a = 0.5 * kLoad / 926;
  const double x = 0.9 * 50 / a;
  const double least = (10 - std::sqrt(100 - 2 * a * x)) / a;
  EXPECT_NEAR(duration_to(scene, x).value_or(0), least, 2e-3 * least);
}

/// Mass of the ring of steel [kg].
constexpr double kRing = 7850 * std::numbers::pi * (0.43 * 0.43 - 0.37 * 0.37) * 0.06;

/// Scene of a ring of steel, 60 mm wide and thick, under 10 kN; its bore moves at the motion's speed or is
/// free.
Scene ring(const std::string& bore, const std::string& motion) {
  return scene_of(
      "[scene]\n[material.steel]\ndensity = \"7850 kg/m3\"\nyoungs_modulus = \"210 GPa\"\npoissons_ratio = "
      "0.3\n[rail]\nprofile = \"box\"\nsupport = \"rigid\"\nlength = \"2 m\"\norigin = \"0.5 m\"\n"
      "[solution_zone]\nstart = \"0.1 m\"\nlength = \"0.2 m\"\n"
      "[wheel]\nshape = \"tyre\"\nprofile = \"arc\"\nbore = \"" +
      bore + "\"\n[load]\nwheel_load = \"10 kN\"\n[contact]\n[motion]\nduration = \"20 ms\"\n" + motion);
}

TEST(Travel, RingsKeepTheirSpeedWhenGuided) {
  const std::string driven = "speed = \"10 m/s\"\ntraction.mu = 0.2\ntraction.ramp = \"0 ms\"";
  EXPECT_NEAR(travel_of(ring("guided", driven)).last, 0.2, 1e-12);
  const double a = 0.2 * (10e3 + kRing * 9.81) / kRing;
  EXPECT_NEAR(travel_of(ring("free", driven)).last, 0.2 + 0.5 * a * 0.02 * 0.02, 1e-9);
}

/// The wheel is soon much faster than at its start, and the scene's duration may be longer than needed.
TEST(Travel, ADurationIsTheLeastOfADrivenWheel) {
  Scene scene = ring("free", "speed = \"1 km/h\"\ntraction.mu = 0.2\ntraction.ramp = \"0 ms\"");
  const double v = scene.motion->speed, a = 0.2 * (10e3 + kRing * 9.81) / kRing;
  const double least = (std::sqrt(v * v + 2 * a * 0.4) - v) / a;
  for (const double stated : {1e-3, 0.02, 2.0}) {
    scene.motion->duration = stated;
    EXPECT_NEAR(duration_to(scene, 0.4).value(), least, 2e-3 * least) << stated;
  }
  scene.motion->speed = 0;
  EXPECT_NEAR(duration_to(scene, 0.4).value(), std::sqrt(2 * 0.4 / a), 2e-3 * least);
}

/// The slip of a creepage of 0.5 is two thirds of the speed; a thin ring's spin gives half of it at the most.
TEST(Travel, FrictionAddsTheSlipOfTheStart) {
  const double a = 0.5 * (10e3 + kRing * 9.81) / kRing;  // of sliding friction
  const std::string fast = "speed = \"10 m/s\"\ncreepage = 0.5", slow = "speed = \"1 m/s\"\ncreepage = 0.5";
  EXPECT_NEAR(travel_of(ring("free", fast)).last, 0.2 + 0.5 * a * 0.02 * 0.02, 1e-9);
  const double gained = 1.0 / 3, sliding = gained / a;
  ASSERT_LT(sliding, 0.01);
  EXPECT_NEAR(travel_of(ring("free", slow)).last, 0.02 + gained * (0.02 - 0.5 * sliding), 1e-6);
  EXPECT_NEAR(travel_of(ring("guided", fast)).last, 0.2, 1e-12);
  const Travel locked = travel_of(ring("free", "speed = \"1 m/s\"\ncreepage = -2"));
  EXPECT_EQ(locked.first, 0);
  EXPECT_NEAR(locked.last, 0.02, 1e-12);
  EXPECT_LT(locked.sure, 0.015);
  EXPECT_NEAR(travel_of(ring("free", fast)).sure, 0.2, 1e-12);
}

/// The rail is divided alike at the end of the travel and before it.
TEST(Travel, TheRailIsFineWhereItEnds) {
  const Scene scene = wheelset("speed = \"60 km/h\"\nduration = \"200 ms\"\ntraction.mu = 0.4");
  const Model model(scene);
  const double last = travel_of(scene).last;
  ASSERT_GT(last, 60 / 3.6 * 0.2 + 0.4);
  const SweptBlock& head = model.mesh.blocks[static_cast<std::size_t>(model.index.rail_cap)];
  const auto pitch_at = [&](double x) { return StationFinder(head).find(x).pitch; };
  EXPECT_LE(pitch_at(last), 1.02 * pitch_at(1.5));
  EXPECT_GT(pitch_at(last + 1), 2 * pitch_at(last));
}

}  // namespace
}  // namespace tread
