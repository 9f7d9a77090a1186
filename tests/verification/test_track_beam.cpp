// The beam on fastenings against closed forms.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "drivers/engine/beam/beam_passage.hpp"
#include "drivers/engine/beam/beam_section.hpp"
#include "drivers/engine/beam/track_beam.hpp"
#include "drivers/engine/start/rail_beam.hpp"
#include "drivers/engine/start/run_in.hpp"
#include "io/scene/scene_reader.hpp"
#include "tests/beam_frequency.hpp"
#include "tests/measured.hpp"

namespace tread {
namespace {

constexpr double kBending = 205.9e9 * 3217e-8;  // E I of CN60 [N m2]
constexpr double kArea = 77.45e-4;              // [m2]
constexpr double kShear = 205.9e9 / 2.6 * kArea;
constexpr double kMass = 60.64;  // [kg/m]
const BeamProperties kEuler = {kBending, 0, kMass, 0};

BeamProperties timoshenko_rail(double kappa) {
  return {kBending, kappa * kShear, kMass, kMass * 3217e-8 / kArea};
}

/// Section of n x n quads of a rectangle.
Section rectangle_section(double width, double height, int n) {
  Section section;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      section.p.push_back(width * i / n);
      section.q.push_back(height * j / n);
      const int node = j * (n + 1) + i;
      if (i < n && j < n) section.quads.push_back({node, node + 1, node + n + 2, node + n + 1});
    }
  return section;
}

TEST(BeamSectionProperties, OfARectangle) {
  const double nu = 0.3;
  const Section narrow = rectangle_section(0.02, 0.2, 16);
  const BeamSection s = beam_section({&narrow}, nu);
  EXPECT_NEAR(s.area, 0.004, 1e-15);
  EXPECT_NEAR(s.height, 0.1, 1e-15);
  EXPECT_NEAR(s.vertical, 0.02 * 0.2 * 0.2 * 0.2 / 12, 1e-12);
  // Cowper (1966): a rectangle that bends in its plane, whatever its width.
  EXPECT_NEAR(s.shear_coefficient, 10 * (1 + nu) / (12 + 11 * nu), 3e-3);
  const Section square = rectangle_section(0.2, 0.2, 16);
  EXPECT_NEAR(beam_section({&square}, nu).shear_coefficient, 10 * (1 + nu) / (12 + 11 * nu), 3e-3);
  EXPECT_NEAR(beam_section({&square}, 0).shear_coefficient, 5.0 / 6, 3e-3);
}

TEST(BeamSectionProperties, OfARectangleInTwoTiedParts) {
  const double nu = 0.3;
  Section lower = rectangle_section(0.02, 0.08, 16);
  Section upper = rectangle_section(0.02, 0.12, 12);
  for (double& q : upper.q) q += 0.08;
  for (int i = 0; i <= 16; ++i) lower.paths["tie"].push_back(16 * 17 + i);
  for (int i = 0; i <= 12; ++i) upper.paths["tie"].push_back(i);
  const BeamSection s = beam_section({&upper, &lower}, nu);
  const Section whole = rectangle_section(0.02, 0.2, 16);
  const BeamSection one = beam_section({&whole}, nu);
  EXPECT_NEAR(s.area, one.area, 1e-15);
  EXPECT_NEAR(s.vertical, one.vertical, 1e-12);
  EXPECT_NEAR(s.shear_coefficient, one.shear_coefficient, 3e-3);
  EXPECT_NEAR(s.foot_warping / one.foot_warping, 1, 0.02);
}

/// A force p along the bottom has the shear stress p (1 - 4 s + 3 s^2) / b at s H from it, whose energy is
/// that of a compliance 2 H / (15 G b). A shear force has a parabola, which warps the bottom by V / (10 G b).
TEST(BeamSectionProperties, FootOfARectangle) {
  for (const double width : {0.02, 0.2}) {
    const Section rectangle = rectangle_section(width, 0.2, 32);
    const BeamSection s = beam_section({&rectangle}, 0);
    EXPECT_NEAR(s.foot_shear / (2 * 0.2 / (15 * width)), 1, 4e-3);
    EXPECT_NEAR(s.foot_warping * 10 * width, 1, 6e-3);
  }
}

TEST(BeamSectionProperties, OfCN60) {
  const Scene scene =
      resolve_scene(SceneSource{"x.toml", "[scene]\nbased_on = \"highspeed-slab-2014\"\n", {}}, {}).scene;
  const BeamSection s = rail_beam_section(scene);
  measured("A", 1e4 * s.area, "cm2");
  measured("I vertical", 1e8 * s.vertical, "cm4");
  measured("I lateral", 1e8 * s.lateral, "cm4");
  measured("kappa", s.shear_coefficient);
  measured("G times the foot's motion by a force per length", s.foot_shear);
  measured("by a shear force", s.foot_warping, "1/m");
  EXPECT_NEAR(s.area, 77.45e-4, 0.005 * 77.45e-4);
  EXPECT_NEAR(s.vertical, 3217e-8, 0.005 * 3217e-8);
  EXPECT_NEAR(s.lateral, 524e-8, 0.01 * 524e-8);
  EXPECT_NEAR(s.shear_coefficient, 0.41, 0.01);  // in the known range, 0.34 to 0.53
}

/// Under the paper's wheel, where the rail of solid elements sinks by 1.194 mm, its foot held. A free foot
/// gives way by more than Euler's beam on an elastic foundation.
TEST(TrackBeam, OfCN60OnItsFastenings) {
  const auto deflection = [](const std::vector<std::string>& overrides) {
    const SceneSource source{"x.toml", "[scene]\nbased_on = \"highspeed-slab-2014\"\n", {}};
    return loaded_deflection(resolve_scene(source, overrides).scene, 0, 8926 * 9.81);
  };
  const double held = deflection({}), free = deflection({"fastenings.along=free"});
  measured("deflection, foot held [mm]", 1e3 * held);
  measured("deflection, foot free [mm]", 1e3 * free);
  EXPECT_NEAR(held, 1.194e-3, 0.005 * 1.194e-3);
  EXPECT_GT(free, 1.375e-3);
}

TEST(TrackBeam, RestsOnAWinklerFoundation) {
  const double k = 22e6 / 0.65;
  const double force = 8926 * 9.81;
  TrackBeam beam(kEuler, -20, 40, BeamEnds::guided, 0.05, false);
  for (int i = 0; i <= 1600; ++i) beam.support(-20 + 0.025 * i, k * 0.025 * (i % 1600 == 0 ? 0.5 : 1), 0);
  const double beta = std::pow(k / (4 * kBending), 0.25);
  const double theory = force * beta / (2 * k);
  EXPECT_NEAR(theory, 1.375e-3, 1e-6);
  EXPECT_NEAR(beam.deflection(beam.static_state(0, force), 0), theory, 1e-4 * theory);
  EXPECT_NEAR(std::abs(beam.receptance(0, 0.3, 0.001)), beam.deflection(beam.static_state(0, 1), 0.3), 1e-12);
}

TEST(TrackBeam, PinnedPinnedFrequency) {
  const double k = std::numbers::pi / 0.65;
  EXPECT_NEAR(wave_frequency(kEuler, k), 1229, 1);
  const double wanted[][2] = {{0.34, 916}, {0.40, 945}, {0.45, 964}, {0.53, 989}};
  for (const auto& [kappa, frequency] : wanted)
    EXPECT_NEAR(wave_frequency(timoshenko_rail(kappa), k), frequency, 1) << kappa;
  EXPECT_NEAR(eigenfrequency(TrackBeam(kEuler, 0, 0.65, BeamEnds::pinned, 0.01, false), 0), 1229, 1);
  EXPECT_NEAR(eigenfrequency(TrackBeam(timoshenko_rail(0.4), 0, 0.65, BeamEnds::pinned, 0.01, false), 0), 945,
              1);
}

TEST(TrackBeam, FreeAndGuidedBeamsHaveTheirFrequencies) {
  const double length = 2;
  const double scale = std::sqrt(kBending / kEuler.mass) / (2 * std::numbers::pi * length * length);
  const TrackBeam free(kEuler, 0, length, BeamEnds::free, 0.01, false);
  EXPECT_LT(eigenfrequency(free, 1), 0.1);  // two rigid motions
  EXPECT_NEAR(eigenfrequency(free, 2), scale * std::pow(4.730040745, 2), 1e-3);
  EXPECT_NEAR(eigenfrequency(free, 3), scale * std::pow(7.853204624, 2), 1e-2);
  // Between guided ends the modes are pure cosines.
  const BeamProperties rail = timoshenko_rail(0.4);
  const TrackBeam guided(rail, 0, length, BeamEnds::guided, 0.01, false);
  for (int n = 1; n < 8; ++n) {
    const double theory = wave_frequency(rail, n * std::numbers::pi / length);
    const double error = eigenfrequency(guided, n) / theory - 1;
    EXPECT_NEAR(error, 0, 6e-4) << n;
    // The error is of second order in the element.
    const TrackBeam coarse(rail, 0, length, BeamEnds::guided, 0.02, false);
    if (n > 4) {
      EXPECT_NEAR((eigenfrequency(coarse, n) / theory - 1) / error, 4, 0.1);
    }
    EXPECT_NEAR(wave_number(rail, theory), n * std::numbers::pi / length, 1e-9);
  }
}

/// A foot that moves freely leaves the bending as it is.
TEST(TrackBeam, FreeFootDoesNotActOnBending) {
  BeamProperties line = timoshenko_rail(0.4);
  BeamProperties rail = line;
  rail.axial_stiffness = 205.9e9 * kArea;
  rail.foot = 0.081;
  std::vector<double> deflection;
  for (const BeamProperties& properties : {line, rail}) {
    TrackBeam beam(properties, -1, 2, BeamEnds::guided, 0.01, false);
    for (const double x : {-0.65, 0.0, 0.65}) beam.support(x, 22e6, 0);
    deflection.push_back(beam.deflection(beam.static_state(0.3, 1e5), 0.3));
  }
  EXPECT_NEAR(deflection[1] / deflection[0], 1, 1e-9);
}

/// A beam whose foot is held all along bends about the foot: E I + E A h^2, rho I + rho A h^2.
TEST(TrackBeam, HeldFootIsTheAxisOfBending) {
  const double length = 2;
  BeamProperties rail = timoshenko_rail(0.4);
  rail.axial_stiffness = 205.9e9 * kArea;
  rail.foot = 0.081;
  TrackBeam held(rail, 0, length, BeamEnds::guided, 0.01, false);
  held.hold_foot(0, length);
  BeamProperties about_foot = rail;
  about_foot.bending_stiffness += rail.axial_stiffness * rail.foot * rail.foot;
  about_foot.rotary_inertia += rail.mass * rail.foot * rail.foot;
  for (int n = 1; n < 5; ++n)
    EXPECT_NEAR(eigenfrequency(held, n) / wave_frequency(about_foot, n * std::numbers::pi / length), 1, 1e-3)
        << n;
}

TEST(TrackBeam, FootMovesAlongAsABar) {
  BeamProperties rail = timoshenko_rail(0.4);
  rail.axial_stiffness = 205.9e9 * kArea;
  rail.foot = 0.081;
  // No deflection: stiff in bending and shear, so that the lowest modes are those of the bar held at its
  // ends.
  rail.bending_stiffness *= 1e6;
  rail.shear_stiffness *= 1e6;
  const TrackBeam beam(rail, 0, 15, BeamEnds::guided, 0.01, false);
  const double sound = std::sqrt(rail.axial_stiffness / rail.mass);
  EXPECT_NEAR(eigenfrequency(beam, 1) / (sound / 30), 1, 1e-3);
  TrackBeam sprung = beam;
  sprung.support_foot(7.5, 1e15, 0);  // in the middle: as if held there
  EXPECT_NEAR(eigenfrequency(sprung, 1) / (sound / 15), 1, 1e-3);
  TrackBeam held = beam;
  held.hold_foot(7.5, 7.5);
  EXPECT_NEAR(eigenfrequency(held, 1) / eigenfrequency(sprung, 1), 1, 1e-6);
}

TEST(TrackBeam, ReceptanceOfAFreeRigidBeam) {
  // A short, stiff beam is a mass: a force in the middle moves it by -1 / (m omega^2).
  const TrackBeam beam(kEuler, -0.1, 0.2, BeamEnds::free, 0.01, false);
  const double omega = 2 * std::numbers::pi * 5;
  EXPECT_NEAR(beam.receptance(0, 0, 5).real() * -omega * omega * 0.2 * kEuler.mass, 1, 1e-4);
}

BeamVehicle wheel() {
  BeamVehicle v;
  v.unsprung_mass = 926;
  v.sprung_mass = 8000;
  v.stiffness = 880e3;
  v.damping = 4e3;
  v.contact = 9.1e10;
  return v;
}

/// Long waves: the rest of the strip's Poisson strains, which Cowper's coefficient of the mean deflection
/// leaves. [theory.md, eq. B5]
TEST(HeadSpread, OfLongWaves) {
  const double nu = 0.3;
  const double limit = 0.2 * std::sqrt(11 * nu / 30);
  EXPECT_NEAR(head_spread(0.2, nu, 0.5), limit, 1e-3 * limit);
  measured("of CN60's depth, waves of 0.65 m", head_spread(0.176, nu, 2 * std::numbers::pi / 0.65), "m");
  measured("waves of 0.325 m", head_spread(0.176, nu, 4 * std::numbers::pi / 0.65), "m");
  // Without Poisson's ratio only the effect of depth over wavelength remains.
  EXPECT_LT(head_spread(0.2, 0, 0.5), 0.05 * limit);
}

/// The head feels a wave of deflection as the spread load averages it: times exp(-(k s)^2 / 2).
TEST(TrackBeam, SpreadsAForceOnTheHead) {
  const double spread = 0.06;
  TrackBeam beam(kEuler, -2, 4, BeamEnds::free, 0.01, false);
  beam.spread_head_load(spread);
  for (const double k : {0.0, 9.7, 19.3}) {
    std::vector<double> wave;
    for (int i = 0; i < beam.nodes(); ++i) {
      const double x = beam.left() + i * beam.pitch();
      wave.push_back(std::cos(k * x));
      wave.push_back(-k * std::sin(k * x));
      wave.push_back(0);
    }
    for (const double x : {0.0, 0.0137, 0.1}) {
      const std::vector<double> load = beam.head_load(x);
      double felt = 0;
      for (std::size_t i = 0; i < load.size(); ++i) felt += load[i] * wave[i];
      // The tolerance is the load beyond three deviations.
      EXPECT_NEAR(felt, std::exp(-0.5 * k * k * spread * spread) * std::cos(k * x), 0.01) << k << ' ' << x;
    }
  }
}

TEST(BeamPassage, StaysInEquilibrium) {
  TrackBeam beam(timoshenko_rail(0.4), -3, 6, BeamEnds::guided, 0.05, false);
  for (int i = 0; i < 9; ++i) beam.support(-2.6 + 0.65 * i, 22e6, 200e3);
  BeamPassage passage(beam, wheel(), 0, 2e-5);
  for (int i = 0; i < 500; ++i) passage.step(0);
  EXPECT_NEAR(passage.force(), wheel().load(), 1e-6 * wheel().load());
}

TEST(BeamPassage, WheelOnAStiffBeamOscillatesOnItsContact) {
  // The beam hardly moves: the wheel oscillates on the Hertz spring alone, displaced a little by a step of
  // roughness.
  const BeamProperties stiff = {1e16, 0, 1e9, 0};
  TrackBeam beam(stiff, -1, 2, BeamEnds::guided, 0.1, false);
  beam.support(0, 1e16, 0);
  BeamVehicle v = wheel();
  v.stiffness = v.damping = 0;
  v.sprung_mass = 0;
  const double dt = 1e-6;
  BeamPassage passage(beam, v, 0, dt);
  const double still = passage.wheel();
  // Period of small oscillations about the static approach d: k = 3/2 C sqrt(d).
  const double d = std::pow(v.load() / v.contact, 2.0 / 3);
  const double period = 2 * std::numbers::pi * std::sqrt(v.unsprung_mass / (1.5 * v.contact * std::sqrt(d)));
  double turned = 0;
  double before = passage.wheel();
  bool falling = false;
  for (int i = 0; i < 20000 && turned == 0; ++i) {
    passage.step(0, 0.01 * d);
    if (falling && passage.wheel() < before) turned = passage.time();
    falling = passage.wheel() > before;
    before = passage.wheel();
  }
  EXPECT_GT(before, still);
  EXPECT_NEAR(turned, 0.5 * period, 0.01 * period);
}

/// A wheel that has been run in goes on unchanged: the suspension bears the sprung mass in the mean of a
/// span, F_N repeats.
TEST(RunningWheel, IsPeriodic) {
  const BeamVehicle vehicle = {926, {}, 8000, 880e3, 4e3, 0, 9e10, 9.81};
  for (const char* keys : {"[motion]\nspeed = \"300 km/h\"", "[motion]\nspeed = \"500 km/h\"",
                           "[motion]\nspeed = \"300 km/h\"\n[fastenings]\nstiffness = \"5 MN/m\""}) {
    SCOPED_TRACE(keys);
    const Scene scene =
        resolve_scene(
            SceneSource{"x.toml", std::string("[scene]\nbased_on = \"highspeed-slab-2014\"\n") + keys, {}},
            {})
            .scene;
    RunningWheel running = running_wheel(scene, vehicle);
    EXPECT_LT(running.change, 0.01);
    BeamPassage& passage = running.passage;
    constexpr int kSteps = 400;
    const double spacing = scene.fastenings->spacing;
    const double start = passage.force();
    double carried = 0;
    for (int i = 1; i <= 2 * kSteps; ++i) {
      passage.step(i * spacing / kSteps);
      carried += passage.suspension() / (2 * kSteps);
      if (i % kSteps == 0) {
        EXPECT_NEAR(passage.force(), start, 1e-3 * vehicle.load());
      }
    }
    measured("suspension / weight - 1", carried / (vehicle.sprung_mass * vehicle.gravity) - 1);
    EXPECT_NEAR(carried, vehicle.sprung_mass * vehicle.gravity, 5e-4 * vehicle.load());
  }
}

/// The last span of a short rail is like no other; the way before it is long enough all the same.
TEST(RunningWheel, SettlesOnAShortRail) {
  const BeamVehicle vehicle = {926, {}, 8000, 880e3, 4e3, 0, 9e10, 9.81};
  const Scene scene = resolve_scene(SceneSource{"x.toml",
                                                "[scene]\nbased_on = \"highspeed-slab-2014\"\n"
                                                "[rail]\nlength = \"1.3 m\"\norigin = \"0.3 m\"\n"
                                                "[fastenings]\ncount = 2\nfirst = \"0.2 m\"\n"
                                                "[solution_zone]\nstart = \"0 m\"\nlength = \"20 mm\"\n"
                                                "[motion]\nspeed = \"40 km/h\"\n",
                                                {}},
                                    {})
                          .scene;
  const RunningWheel running = running_wheel(scene, vehicle);
  EXPECT_GT(running.beam->left(), -20 * scene.fastenings->spacing);
  EXPECT_NEAR(running.passage.force(), vehicle.load(), 0.01 * vehicle.load());
  EXPECT_LT(running.change, 0.01);
}

/// Nothing damps the swinging of the wheel on the soft track.
TEST(RunningWheel, TellsThatItDoesNotSettle) {
  const BeamVehicle vehicle = {926, {}, 8000, 880e3, 4e3, 0, 9e10, 9.81};
  const Scene scene =
      resolve_scene(
          SceneSource{"x.toml",
                      "[scene]\nbased_on = \"highspeed-slab-2014\"\n"
                      "[fastenings]\nspacing = \"0.3 m\"\nstiffness = \"0.1 MN/m\"\ndamping = \"0 kN s/m\"\n"
                      "[motion]\nspeed = \"600 km/h\"\n",
                      {}},
          {})
          .scene;
  EXPECT_GT(running_wheel(scene, vehicle).change, 0.02);
}

}  // namespace
}  // namespace tread
