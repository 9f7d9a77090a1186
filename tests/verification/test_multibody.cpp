// The multi-body model against closed forms, the beam's finite elements and itself on finer steps.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "drivers/engine/start/rail_beam.hpp"
#include "drivers/studies/multibody/multibody_run.hpp"
#include "io/scene/scene_reader.hpp"
#include "tests/beam_frequency.hpp"
#include "tests/field_differences.hpp"
#include "tests/measured.hpp"
#include "tests/refusal.hpp"

namespace tread {
namespace {

using samples::difference;
using samples::expect_part;

Scene scene(double speed_km_h, const std::string& corrugation) {
  return resolve_scene(SceneSource{"test",
                                   "[scene]\ntitle = \"t\"\nbased_on = \"highspeed-slab-2014\"\n[motion]\n"
                                   "speed = \"" +
                                       std::to_string(speed_km_h) + " km/h\"\n" + corrugation,
                                   {}})
      .scene;
}

const char* const kCorrugationD = "[corrugation]\nwavelength = \"80 mm\"\ndepth = \"0.14 mm\"\n";
// A tenth of D's depth: the wheel stays on the rail and answers almost linearly.
const char* const kShallow = "[corrugation]\nwavelength = \"80 mm\"\ndepth = \"0.014 mm\"\n";

TEST(ModalBeam, HasTheModesOfTheFiniteElements) {
  BeamProperties rail = multibody_model(scene(300, ""), BeamTheory::timoshenko).rail;
  rail.axial_stiffness = 0;
  const ModalBeam modal(rail, -1, 3, 12);
  const TrackBeam elements(rail, -1, 3, BeamEnds::guided, 0.01, false);
  for (int n = 1; n < 12; ++n)
    EXPECT_NEAR(
        modal.omega()[static_cast<std::size_t>(n)] / (2 * std::numbers::pi) / eigenfrequency(elements, n), 1,
        2e-3)
        << n;
  // Scaled to a modal mass of 1: the rigid motion is 1 / sqrt(mass of the beam).
  std::vector<double> values(12);
  modal.shapes(0.3, values);
  EXPECT_NEAR(values[0], 1 / std::sqrt(3 * rail.mass), 1e-12);
}

TEST(ModalTrack, StaticDeflectionIsThatOfTheBeam) {
  for (const BeamTheory theory : {BeamTheory::euler, BeamTheory::timoshenko, BeamTheory::spread}) {
    const MultibodyModel model = multibody_model(scene(300, ""), theory);
    const TrackBeam beam = rail_beam(model.scene, model.rail);
    const double load = model.vehicle.load();
    // A held foot sees waves shorter than those of bending: the modes lack more of it.
    for (const auto& [modes, bound] : {std::pair(60, 6e-3), std::pair(120, 2e-3), std::pair(480, 1e-3)}) {
      const ModalTrack track = modal_track(model, modes);
      for (const double x : {-0.325, 0.0, 0.11}) {
        const ModalPassage still(track, model.vehicle, x, 1e-6);
        EXPECT_NEAR(still.force(), load, 1e-9 * load);
        const double wanted = BeamPassage(beam, model.vehicle, x, 1e-6).rail();
        EXPECT_NEAR(still.rail() / wanted, 1, bound) << name_of(theory) << " " << modes << " at " << x;
      }
    }
    // On a Winkler foundation of the same stiffness an Euler beam gives way by 1.375 mm.
    if (theory == BeamTheory::euler) {
      const ModalPassage still(modal_track(model, {}), model.vehicle, 0, 1e-6);
      measured("static deflection of the Euler rail [mm]", 1e3 * still.rail());
      EXPECT_NEAR(still.rail(), 1.375e-3, 0.02e-3);
    }
  }
}

TEST(ModalTrack, SleepersAreThoseOfTheBeam) {
  const Scene ballasted =
      resolve_scene(
          SceneSource{"test",
                      "[scene]\nbased_on = \"ballasted-cn60\"\n[support.hanging]\nfastening = "
                      "12\nbed = 0\nstiffness = 0.5\nshift = \"40 mm\"\n[motion]\nspeed = \"140 km/h\"\n",
                      {}})
          .scene;
  for (const BeamTheory theory : {BeamTheory::euler, BeamTheory::spread}) {
    const MultibodyModel model = multibody_model(ballasted, theory);
    EXPECT_TRUE(model.supports.empty());
    ASSERT_EQ(model.sleepers.size(), 28U);
    const TrackBeam beam = rail_beam(model.scene, model.rail);
    // A held foot sees short waves, as above.
    for (const auto& [modes, bound] : {std::pair(240, 6e-3), std::pair(480, 3e-3)}) {
      const ModalTrack track = modal_track(model, modes);
      for (const double x : {-0.325, 0.0, 0.11}) {
        const ModalPassage still(track, model.vehicle, x, 1e-6);
        const double wanted = BeamPassage(beam, model.vehicle, x, 1e-6).rail();
        EXPECT_NEAR(still.rail() / wanted, 1, bound) << name_of(theory) << " " << modes << " at " << x;
      }
    }
  }
  // Over a step in height wheel, rail and sleepers move alike in both models.
  const MultibodyModel model = multibody_model(ballasted, BeamTheory::euler);
  const TrackBeam beam = rail_beam(model.scene, model.rail);
  const double dt = passage_step(modal_track(model, 120), model.vehicle);
  const ModalTrack track = modal_track(model, 120);
  ModalPassage modal(track, model.vehicle, 0.1, dt);
  BeamPassage elements(beam, model.vehicle, 0.1, dt);
  double worst = 0;
  for (int i = 0; i < static_cast<int>(0.03 / dt); ++i) {
    modal.step(0.1, 1e-5);
    elements.step(0.1, 1e-5);
    worst = std::max(worst, std::abs(modal.force() - elements.force()));
  }
  measured("largest difference of F_N after a step of 10 um [kN]", 1e-3 * worst);
  EXPECT_LT(worst, 0.01 * model.vehicle.load());
}

TEST(ModalPassage, StaysInEquilibrium) {
  const MultibodyModel model = multibody_model(scene(300, ""), BeamTheory::euler);
  const ModalTrack track = modal_track(model, {});
  ModalPassage passage(track, model.vehicle, 0.2, passage_step(track, model.vehicle));
  for (int i = 0; i < 2000; ++i) passage.step(0.2);
  EXPECT_NEAR(passage.force(), model.vehicle.load(), 1e-6 * model.vehicle.load());
}

TEST(ModalPassage, WheelOscillatesOnItsContact) {
  // On a rail that hardly moves, the wheel is a mass on the linearised Hertz spring.
  const BeamProperties stiff = {1e13, 0, 1e7, 0};
  const ModalTrack track(ModalBeam(stiff, -1, 2, 4), {{0, 1e14, 0}});
  BeamVehicle wheel;
  wheel.unsprung_mass = 926;
  wheel.contact = 9.1e10;
  const double dt = 2e-6;
  ModalPassage passage(track, wheel, 0, dt);
  const double approach = std::pow(wheel.load() / wheel.contact, 2.0 / 3);
  const double k = 1.5 * wheel.contact * std::sqrt(approach);
  const double period = 2 * std::numbers::pi * std::sqrt(wheel.unsprung_mass / k);
  // A rail lower by a little makes F_N oscillate about the weight; the period is the time between two upward
  // crossings.
  std::vector<double> crossings;
  double before = passage.force();
  while (crossings.size() < 3 && passage.time() < 5 * period) {
    passage.step(0, 0.01 * approach);
    if (before < wheel.load() && passage.force() >= wheel.load())
      crossings.push_back(passage.time() -
                          dt * (passage.force() - wheel.load()) / (passage.force() - before));
    before = passage.force();
  }
  ASSERT_EQ(crossings.size(), 3U);
  EXPECT_NEAR(crossings[2] - crossings[1], period, 1e-3 * period);
}

/// F_N over the corrugation at a step, at the evenly spaced places of `x`.
std::vector<double> force_at(const MultibodyModel& model, const MultibodyStep& step,
                             const std::vector<double>& x) {
  const MultibodyResult r = run_multibody(model, step);
  std::vector<double> force;
  std::size_t i = 0;
  for (const double at : x) {
    while (r.samples[i + 1].x < at) ++i;
    const double share = (at - r.samples[i].x) / (r.samples[i + 1].x - r.samples[i].x);
    force.push_back((1 - share) * r.samples[i].force + share * r.samples[i + 1].force);
  }
  return force;
}

constexpr double kNear = 1.8;  // a wheel that starts at rest here shows every error, too [m]

std::vector<double> places() {
  std::vector<double> x;
  for (int i = 0; i <= 400; ++i) x.push_back(2.4 + 0.0013 * i);
  return x;
}

TEST(Multibody, ConvergesWithTheStepInSecondOrder) {
  MultibodyModel model = multibody_model(scene(300, kShallow), BeamTheory::euler);
  model.start = kNear;
  const std::vector<double> x = places();
  const double load = model.vehicle.load();
  const auto at = [&](double dt) { return force_at(model, {60, dt}, x); };
  const std::vector<double> finest = at(1e-6);
  const double coarse = difference(at(8e-6), finest) / load;
  const double fine = difference(at(4e-6), finest) / load;
  measured("step 8 and 4 us, error of F_N / static", coarse);
  measured("order", std::log2(coarse / fine));
  EXPECT_LT(coarse, 2e-3);
  EXPECT_NEAR(std::log2(coarse / fine), 2, 0.25);
}

TEST(Multibody, ConvergesWithTheModes) {
  const std::vector<double> x = places();
  for (const BeamTheory theory : {BeamTheory::euler, BeamTheory::timoshenko, BeamTheory::spread}) {
    MultibodyModel model = multibody_model(scene(300, kCorrugationD), theory);
    model.start = kNear;
    const double load = model.vehicle.load();
    const std::vector<double> many = force_at(model, {theory == BeamTheory::euler ? 140 : 500, {}}, x);
    const std::vector<double> own = force_at(model, {}, x);
    measured(name_of(theory), difference(own, many) / load);
    EXPECT_LT(difference(own, many), 0.01 * load) << name_of(theory);
  }
}

TEST(Multibody, AgreesWithImplicitFiniteElements) {
  // Newmark's average acceleration on the beam's elements, the contact solved within the step.
  const std::vector<double> x = places();
  for (const BeamTheory theory : {BeamTheory::euler, BeamTheory::timoshenko, BeamTheory::spread}) {
    MultibodyModel model = multibody_model(scene(300, kCorrugationD), theory);
    model.start = kNear;
    const std::vector<double> ours = force_at(model, {}, x);
    // Under a force at a point inside of a shear-flexible element the deflection ripples: short elements.
    const bool kinked = theory == BeamTheory::timoshenko;
    TrackBeam beam(model.rail, -6.1, 15.2, BeamEnds::guided, kinked ? 0.003 : 0.01, false);
    beam.spread_head_load(head_spread(model.scene, model.rail));
    for (const BeamSupport& s : model.supports) beam.support(s.x, s.stiffness, s.damping);
    for (const FootStretch& s : model.foot_holds) beam.hold_foot(s.first, s.last);
    constexpr double kStep = 1e-5;
    BeamPassage passage(beam, model.vehicle, model.start, kStep);
    std::vector<double> theirs;
    double x_before = model.start;
    double before = passage.force();
    for (std::size_t i = 0; i < x.size();) {
      const double now = model.start + model.speed * (passage.time() + kStep);
      passage.step(now, model.roughness(now));
      for (; i < x.size() && x[i] <= now; ++i)
        theirs.push_back(before + (passage.force() - before) * (x[i] - x_before) / (now - x_before));
      x_before = now;
      before = passage.force();
    }
    measured(name_of(theory), difference(ours, theirs) / model.vehicle.load());
    // Around kinks both modes and elements converge with their first power only.
    EXPECT_LT(difference(ours, theirs), (kinked ? 0.02 : 0.005) * model.vehicle.load()) << name_of(theory);
  }
}

TEST(Multibody, PassingOfFastenings) {
  // [a shear-flexible modal beam with forces at points, fastenings without length: about 6.5 % at 300, 11 %
  // at 500 km/h]
  for (const auto& [speed, wanted] : {std::pair{300.0, 0.065}, std::pair{500.0, 0.11}}) {
    Scene smooth = scene(speed, "");
    smooth.fastenings->columns = 1;
    smooth.fastenings->along.kind = "free";
    const auto part = [&](BeamTheory theory) {
      const MultibodyModel model = multibody_model(smooth, theory);
      const MultibodyResult r = run_multibody(model, {});
      EXPECT_NEAR(r.force.mean / model.vehicle.load(), 1, 0.01);
      measured(std::string(name_of(theory)) + ", half range over a span / static",
               r.passing.value() / model.vehicle.load());
      return r.passing.value() / model.vehicle.load();
    };
    const double sheared = part(BeamTheory::timoshenko);
    EXPECT_NEAR(sheared / wanted, 1, 0.1) << speed;
    // The head's depth spreads the force; without shear the rail dips least between the fastenings.
    const double spread = part(BeamTheory::spread);
    EXPECT_LT(spread, 0.9 * sheared);
    EXPECT_LT(part(BeamTheory::euler), 0.5 * spread);
  }
}

TEST(Multibody, PassingIsThatOfAWholeSpanWithoutSurfaces) {
  const auto rolled = [](const std::string& more) {
    MultibodyModel model = multibody_model(scene(300, more), BeamTheory::euler);
    model.end = model.corrugation.last();
    return std::pair(model, run_multibody(model, {20, 20e-6}));
  };
  // The span begins before x = 0.
  const std::string early =
      std::string(kCorrugationD) + "start = \"60 mm\"\n[solution_zone]\nstart = \"50 mm\"\n";
  const auto [model, r] = rolled(early);
  const double begin = model.corrugation.first() - model.scene.fastenings->spacing;
  EXPECT_LT(begin, 0);
  EXPECT_NEAR(r.samples.front().x, begin, 1.01 * model.speed * r.dt);
  EXPECT_TRUE(r.passing.has_value());
  const std::string dip =
      "[surface.dip]\nkind = \"dip\"\nat = \"-200 mm\"\ndepth = \"0.1 mm\"\nlength = \"100 mm\"\n";
  EXPECT_FALSE(rolled(early + dip).second.passing.has_value());
  EXPECT_TRUE(rolled(std::string(kCorrugationD) + dip).second.passing.has_value());
  // The wheel starts within the span.
  MultibodyModel late = model;
  late.start = begin + 0.1;
  EXPECT_FALSE(run_multibody(late, {20, 20e-6}).passing.has_value());
}

TEST(Multibody, ShiftFallsWithSpeed) {
  std::vector<double> shifts;
  for (const double speed : {100.0, 180.0, 300.0, 500.0}) {
    const MultibodyResult r =
        run_multibody(multibody_model(scene(speed, kCorrugationD), BeamTheory::euler), {});
    ASSERT_EQ(r.peaks.size(), 6U);
    shifts.push_back(r.peaks.front().shift / std::numbers::pi);
    measured("shift at the first crest [pi]", shifts.back());
  }
  // [paper, Fig. 26: 0.55 pi at 100 and 0.21 pi at 500 km/h by the transient model]
  EXPECT_TRUE(std::is_sorted(shifts.rbegin(), shifts.rend()));
}

TEST(Multibody, ContactIsLostAndFoundAgain) {
  // [paper, Fig. 28: the multi-body approach loses contact at 500 km/h, 80 mm, 0.18 mm]
  const MultibodyModel model = multibody_model(
      scene(500, "[corrugation]\nwavelength = \"80 mm\"\ndepth = \"0.18 mm\"\n"), BeamTheory::euler);
  const MultibodyResult r = run_multibody(model, {});
  measured("share of the way without contact", r.loss_of_contact);
  measured("largest F_N / static", r.force.max / model.vehicle.load());
  EXPECT_EQ(r.force.min, 0);
  EXPECT_GT(r.loss_of_contact, 0.01);
  EXPECT_LT(r.loss_of_contact, 0.6);
}

TEST(Multibody, ContactFilterIsThatOfTheHalfSpace) {
  MultibodyModel model = multibody_model(scene(300, kCorrugationD), BeamTheory::euler);
  const double gain = contact_filter_gain(model, 0.08);
  measured("gain at 80 mm", gain);
  EXPECT_NEAR(gain, 0.945, 0.003);  // [docs/records/verification.md, contact_filter]
  const double deepest = model.corrugation.deepest();
  apply_contact_filter(model);
  EXPECT_NEAR(model.corrugation.deepest(), gain * deepest, 1e-12);
}

TEST(Multibody, CorrugationIsThatOfTheScene) {
  const MultibodyModel model = multibody_model(scene(300, kCorrugationD), BeamTheory::euler);
  EXPECT_EQ(model.roughness(2.4), 0);
  EXPECT_NEAR(model.roughness(2.44), 0.14e-3, 1e-15);
  EXPECT_NEAR(model.roughness(2.46), 0.07e-3, 1e-15);
  EXPECT_EQ(model.roughness(2.97), 0);
  // The depth off the deepest line follows eq. (7).
  const MultibodyModel aside =
      multibody_model(scene(300, std::string(kCorrugationD) + "centre = \"15 mm\"\n"), BeamTheory::euler);
  const double across = (aside.contact_y - 0.015) / 0.030;
  EXPECT_NEAR(aside.roughness(2.44), 0.14e-3 * (1 - across * across), 1e-15);
}

TEST(Multibody, AnUnstableStepIsAnError) {
  const MultibodyModel model = multibody_model(scene(300, kCorrugationD), BeamTheory::euler);
  const double stable = passage_step(modal_track(model, std::nullopt), model.vehicle);
  EXPECT_NO_THROW(run_multibody(model, {std::nullopt, stable}));
  EXPECT_THROW(run_multibody(model, {std::nullopt, 3 * stable}), NumericalError);
  // A step far beyond the limit is refused at once.
  EXPECT_THROW(run_multibody(model, {std::nullopt, 8 * stable}), InputError);
}

TEST(Multibody, StepIsAtMostAFortiethOfTheShortestWavesPassing) {
  MultibodyModel model = multibody_model(scene(300, ""), BeamTheory::euler);
  const ModalTrack track = modal_track(model, 20);
  const auto step = [&] { return chosen_step(track, model, model.speed); };
  EXPECT_EQ(step(), passage_step(track, model.vehicle));
  CorrugationSpec& corrugation = model.scene.corrugation.emplace();
  const auto expect_wave = [&](double wave) { EXPECT_NEAR(40 * model.speed * step(), wave, 1e-12); };
  expect_wave(corrugation.wavelength);
  corrugation.kind = "random";
  expect_wave(corrugation.shortest);
  corrugation.kind = "table";
  corrugation.table_x = {0, 0.002, 0.005, 0.012};
  expect_wave(20 * 0.004);
  model.scene.corrugation.reset();
  SurfaceSpec& surface = model.scene.surfaces["any"];
  expect_wave(surface.length);
  surface.kind = "waves";
  surface.wavelength = 0.03;
  expect_wave(surface.wavelength);
  surface.kind = "polygon";
  surface.order = 40;
  expect_wave(std::numbers::pi * model.scene.wheel->diameter / 40);
  surface.kind = "profile";
  surface.file_x = {0, 0.001, 0.003};
  expect_wave(20 * 0.0015);
}

TEST(Multibody, AllThatIsEvaluatedIsSampled) {
  const MultibodyModel model = multibody_model(
      scene(300, std::string(kCorrugationD) + "start = \"-5.2 m\"\nlength = \"0.6 m\"\n[solution_zone]\n"
                                              "start = \"-5.3 m\"\nlength = \"0.8 m\"\n"),
      BeamTheory::euler);
  const MultibodyResult r = run_multibody(model, {20, 20e-6});
  EXPECT_LT(r.samples.front().x, r.evaluated_first + 2 * model.speed * r.dt);
  EXPECT_GT(r.force.max, 1.2 * model.vehicle.load());
}

TEST(Multibody, StartsInTheFirstSpanBeyondTheRailsEnd) {
  Scene dense = scene(300, kCorrugationD);
  const auto start = [&] { return multibody_model(dense, BeamTheory::euler).start + dense.rail->origin; };
  EXPECT_DOUBLE_EQ(start(), dense.fastenings->first + 0.5 * dense.fastenings->spacing);
  dense.fastenings->spacing = 0.3;
  EXPECT_DOUBLE_EQ(start(), dense.fastenings->first + 1.5 * 0.3);
}

TEST(Multibody, AStartWithinTheCorrugationOrTheStretchIsRefused) {
  Scene near = scene(300, std::string(kCorrugationD) +
                              "start = \"60 mm\"\nlength = \"180 mm\"\n[solution_zone]\nstart = \"0 m\"\n");
  EXPECT_NO_THROW(multibody_model(near, BeamTheory::euler));
  near.rail->origin = 0.35;
  const auto refused = [&] {
    return samples::refusal<InputError>([&] { multibody_model(near, BeamTheory::euler); });
  };
  for (const char* place : {"begins at x = 0.060 m", "begins at x = 0.000 m"}) {
    expect_part(refused(), "the wheel would start at x = 0.100 m");
    expect_part(refused(), place);
    near.corrugation.reset();
  }
  near.motion->start = "rigid";
  near.zone_start = -0.02;
  expect_part(refused(), "state a longer motion.run_up, or a later");
}

TEST(Multibody, ScenesWithoutItsPartsAreRefused) {
  Scene rigid = scene(300, "");
  rigid.fastenings.reset();
  EXPECT_THROW(multibody_model(rigid, BeamTheory::euler), InputError);
  Scene far = scene(300, kCorrugationD);
  far.corrugation->start = 8.6;
  EXPECT_THROW(multibody_model(far, BeamTheory::euler), InputError);
}

}  // namespace
}  // namespace tread
