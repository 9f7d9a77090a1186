// The solid rail, the modal wheel and the pressed sine of the multi-body model against closed forms, the
// harmonics' receptance and finer meshes.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "core/error.hpp"
#include "core/mesh/rail_section.hpp"
#include "drivers/engine/model/sections.hpp"
#include "drivers/studies/multibody/local_parts.hpp"
#include "drivers/studies/multibody/multibody_run.hpp"
#include "drivers/studies/multibody/solid_rail.hpp"
#include "io/scene/scene_reader.hpp"
#include "kernels/harmonics/harmonic_solid.hpp"
#include "tests/measured.hpp"

namespace tread {
namespace {

Scene scene(const std::string& more) {
  return resolve_scene(SceneSource{"test",
                                   "[scene]\nbased_on = \"highspeed-slab-2014\"\n[motion]\n"
                                   "speed = \"300 km/h\"\n" +
                                       more,
                                   {}})
      .scene;
}

const char* const kCorrugationD = "[corrugation]\nwavelength = \"80 mm\"\ndepth = \"0.14 mm\"\n";

Material steel() {
  Material material;
  material.youngs_modulus = 205.9e9;
  material.poissons_ratio = 0.3;
  material.density = 7790;
  return material;
}

/// Rectangle from (-width / 2, bottom) upwards.
Section rectangle(double width, double bottom, double height, double element) {
  Section section = make_box_rail_section(width, height, 0, {element, element, width / 2, height});
  for (double& q : section.q) q += bottom + height;
  return section;
}

TEST(HarmonicSolid, ThinRingTurnsAsBryans) {
  constexpr double kRadius = 0.4, kThickness = 8e-3, kWidth = 8e-3;
  const HarmonicSolid ring({{rectangle(kWidth, kRadius - 0.5 * kThickness, kThickness, 4e-3), steel()}}, {});
  const std::vector<double> load = ring.surface_load(0, 2, [](double) { return 1; });
  for (const int n : {2, 3, 4}) {
    const HarmonicModes found = ring.modes({n}, {load}, {}, [](int) { return 10; }).front();
    // Rounding also finds waves out of the ring's plane.
    const HarmonicMode& mode =
        *std::find_if(found.modes.begin(), found.modes.end(),
                      [](const HarmonicMode& m) { return std::abs(m.amplitude.front()) > 0.1; });
    const double square = n * n;
    const double bent = 205.9e9 / 7790 * kThickness * kThickness / 12 / std::pow(kRadius, 4);
    const double omega = std::sqrt(bent * square * std::pow(square - 1, 2) / (square + 1));
    EXPECT_NEAR(std::sqrt(mode.stiffness) / omega, 1, 5e-3) << n;
    // [Bryan, On the beats in the vibrations of a revolving cylinder or bell, 1890]
    EXPECT_NEAR(mode.turning / (n * (square - 1) / (square + 1)), 1, 2e-3) << n;
  }
}

TEST(HarmonicSolid, BarSwingsAlongAsARod) {
  constexpr double kLength = 5;
  const HarmonicSolid bar({{rectangle(0.02, 0, 0.02, 5e-3), steel()}}, {}, kLength);
  const HarmonicModes found =
      bar.modes({3}, {bar.path_load(0, 0, "foot")}, {}, [](int) { return 10; }).front();
  const double omega = 3 * std::numbers::pi / kLength * std::sqrt(205.9e9 / 7790);
  const auto nearest =
      std::min_element(found.modes.begin(), found.modes.end(), [&](const auto& a, const auto& b) {
        return std::abs(a.stiffness - omega * omega) < std::abs(b.stiffness - omega * omega);
      });
  EXPECT_NEAR(std::sqrt(nearest->stiffness) / omega, 1, 1e-4);
}

TEST(ForceRegion, LargerBlockIsNearerToAHalfSpace) {
  const ForceRegion region{0, 0.02};
  const auto beyond = [&](double size) {
    HarmonicSolid block({{rectangle(size, -size, size, 6e-3), steel()}}, {}, size);
    block.hold(0, "foot", 2);
    const std::vector<double> load = block.surface_load(0, 2, [&](double p) { return region.density(p); });
    // In the middle of the length only even harmonics answer.
    std::vector<int> waves;
    for (int n = 0; n * std::numbers::pi / size < region.last_wave_number(); n += 2) waves.push_back(n);
    double sum = -half_space_flexibility(region, steel());
    const auto harmonics = block.modes(waves, {load}, {}, [](int) { return 12; });
    for (std::size_t i = 0; i < waves.size(); ++i)
      sum += std::pow(region.coefficient(waves[i] * std::numbers::pi / size), 2) *
             harmonics[i].flexibility.front();
    return sum;
  };
  const double small = beyond(0.1);
  const double large = beyond(0.2);
  const double half_space = half_space_flexibility(region, steel());
  measured("flexibility of a block of 0.2 m beyond a half-space, over its", large / half_space);
  measured("extrapolated to a large block", (2 * large - small) / half_space);
  EXPECT_NEAR((2 * large - small) / half_space, 0, 5e-3);
}

TEST(ModalWheel, HasTheReceptanceOfTheHarmonics) {
  const Scene free = scene("[vehicle]\npresent = false\n[load]\nwheel_load = \"80 kN\"\n");
  const double radius = 0.5 * free.wheel->diameter;
  const ForceRegion region{0, 0.02};
  const ModalWheel wheel = modal_wheel(free, region, 5000, 8e-3);
  EXPECT_NEAR(wheel.mass / free.wheel->mass, 1, 0.01);
  Scene same = free;
  same.quality = "draft";
  same.element_size = 8e-3;
  const MeshSizes sizes = mesh_sizes(same);
  const WheelSections sections = wheel_sections(same, sizes, plan_wheel(radius, {}, sizes)).sections;
  const Material& material = free.wheel_material();
  HarmonicSolid solid({{sections.tread, material}, {sections.disc, material}, {sections.axle, material}},
                      {{0, "tie", 1, "tie_outer"}, {1, "tie_inner", 2, "tie"}});
  solid.hold(2, "symmetry_end", 1);
  const std::vector<double> load = solid.surface_load(0, 2, [&](double p) { return region.density(p); });
  std::vector<std::complex<double>> variables;  // of motions that fade as in `tread verify wheel_receptance`
  for (double f = 100; f <= 3000; f *= 1.01) variables.emplace_back(120, 2 * std::numbers::pi * f);
  std::vector<std::complex<double>> wanted(variables.size());
  const int last = static_cast<int>(region.last_wave_number() * radius);
  for (int n = 0; n <= last; ++n) {
    const HarmonicReceptance receptance = solid.receptances(n, {load}, n <= 12 ? 60 : 12).front();
    for (std::size_t i = 0; i < variables.size(); ++i)
      wanted[i] += std::pow(region.coefficient(n / radius), 2) * receptance.at(variables[i]);
  }
  double apart = 0;
  double whole = 0;
  for (std::size_t i = 0; i < variables.size(); ++i) {
    const std::complex<double> square = variables[i] * variables[i];
    std::complex<double> ours =
        1.0 / (wheel.mass * square) + wheel.flexibility + half_space_flexibility(region, material);
    for (const WheelMode& mode : wheel.modes)
      ours += mode.amplitude * mode.amplitude / (square + mode.omega * mode.omega);
    apart += std::norm(ours - wanted[i]);
    whole += std::norm(wanted[i]);
  }
  measured("difference of the receptance, 100 to 3000 Hz", std::sqrt(apart / whole));
  EXPECT_LT(std::sqrt(apart / whole), 2e-3);
}

/// Expects of flexibility(half the region [m], element [m]) [m/N] that neither matters beside the flexibility
/// of the Hertz spring, 735 pm/N.
template <class Flexibility>
void expect_hardly_depends(const char* name, double element, const Flexibility& flexibility) {
  const double usually = flexibility(0.02, element);
  const double halved = flexibility(0.02, 0.5 * element);
  const double smaller = flexibility(0.014, 0.5 * element);
  measured(name, 1e12 * usually, "pm/N");
  measured("elements halved", 1e12 * halved, "pm/N");
  measured("a smaller region", 1e12 * smaller, "pm/N");
  EXPECT_NEAR(usually, halved, 0.01 * 735e-12);
  EXPECT_NEAR(halved, smaller, 0.01 * 735e-12);
}

TEST(ModalWheel, HardlyDependsOnRegionAndMesh) {
  const Scene usual = scene("");
  const auto flexibility = [&](double half, double element) {
    const ModalWheel wheel = modal_wheel(usual, {0, half}, 5000, element);
    EXPECT_NEAR(wheel.mass, usual.wheel->mass + usual.vehicle->unsprung_mass, 5);
    double sum = wheel.flexibility;
    // Modes that answer at once to a passing frequency of 1 kHz.
    for (const WheelMode& mode : wheel.modes)
      if (mode.omega > 2 * std::numbers::pi * 1900) sum += std::pow(mode.amplitude / mode.omega, 2);
    return sum;
  };
  expect_hardly_depends("flexibility of the wheel above 1.9 kHz beyond a half-space", 6e-3, flexibility);
}

/// Waves of a solid rail with modes below `top` [Hz], the longest first, up to a wave number [1/m].
void expect_waves_of_the_beam(const Scene& of, double top, double element, double longest) {
  const BeamProperties beam = multibody_model(of, BeamTheory::timoshenko).rail;
  const ModalBeam rail = solid_rail(of, {0, 0.02}, top, element);
  // The first family is the bending; the rigid motion comes before.
  for (int n = 1; n * std::numbers::pi / of.rail->length < longest; ++n) {
    const double k = n * std::numbers::pi / of.rail->length;
    const double found = rail.omega()[static_cast<std::size_t>(n)] / (2 * std::numbers::pi);
    EXPECT_NEAR(found / wave_frequency(beam, k), 1, 0.015) << n;
  }
}

TEST(SolidRail, HasTheWavesOfTheBeamWhereTheyAreLong) {
  expect_waves_of_the_beam(scene(""), 2000, 8e-3, 6);
}

/// The longest wave of 60 m bends once in seven seconds.
TEST(SolidRail, HasTheLongestWavesOfALongRail) {
  Scene of = scene("");
  of.rail->length = 60;
  expect_waves_of_the_beam(of, 60, 12e-3, 0.5);
}

TEST(SolidRail, HardlyDependsOnRegionAndMesh) {
  const Scene usual = scene("");
  const auto flexibility = [&](double half, double element) {
    const ModalBeam rail = solid_rail(usual, {0, half}, 8000, element);
    std::vector<double> head(static_cast<std::size_t>(rail.modes()));
    rail.head_shapes(rail.left(), head);
    double sum = rail.residual_flexibility();
    // The mean along the rail of waves shorter than 0.6 m or so, whose share the supports hardly change.
    for (std::size_t i = 0; i < head.size(); ++i)
      if (rail.omega()[i] > 2 * std::numbers::pi * 2500) sum += 0.5 * std::pow(head[i] / rail.omega()[i], 2);
    return sum;
  };
  expect_hardly_depends("flexibility of the rail above 2.5 kHz beyond a half-space", 8e-3, flexibility);
}

TEST(ModalTrack, RollsAlikeInItsOwnModes) {
  const MultibodyModel model = multibody_model(scene(kCorrugationD), BeamTheory::timoshenko);
  const ModalTrack track = modal_track(model, 150);
  const ModalTrack own = track.diagonal(6000);
  EXPECT_LT(own.coordinates(), track.coordinates());
  const double dt = passage_step(track, model.vehicle);
  ModalPassage first(track, model.vehicle, 0.1, dt);
  ModalPassage second(own, model.vehicle, 0.1, dt);
  EXPECT_NEAR(second.rail() / first.rail(), 1, 1e-4);
  double worst = 0;
  while (first.time() < 0.01) {
    const double x = 0.1 + model.speed * (first.time() + dt);
    const double depth = 2e-5 * (1 - std::cos(2 * std::numbers::pi * (x - 0.1) / 0.08));
    first.step(x, depth);
    second.step(x, depth);
    worst = std::max(worst, std::abs(first.force() - second.force()) / model.vehicle.load());
  }
  measured("largest difference of F_N over static", worst);
  EXPECT_LT(worst, 0.01);
}

/// Gain of the contact filter by the pressed sine, whose first trough is at x = 2.44 m [-].
double gain_of_pressed_sine(const MultibodyModel& model) {
  const double s = std::pow(model.vehicle.load(), 2.0 / 3);
  const double rise = model.sine.at(0, 1).at(s);
  const double drop = model.sine.at(std::numbers::pi, 1).at(s);
  return 1 + (drop - rise) / model.roughness(2.44);
}

TEST(SineContact, AgreesWithFilterAndTracedWheel) {
  MultibodyModel model = multibody_model(scene(kCorrugationD), BeamTheory::euler);
  use_half_space_contact(model);
  EXPECT_NEAR(gain_of_pressed_sine(model), contact_filter_gain(model, 0.08), 2e-3);
  // Without load a round wheel on a slope stands on a place before or behind.
  const double middle = model.sine.at(0.5 * std::numbers::pi, 1).at(0);
  const double depth = model.scene.corrugation->depth;
  double traced = 0;
  for (double x = -0.01; x < 0.01; x += 1e-5)
    traced = std::min(traced, 0.5 * depth * std::sin(2 * std::numbers::pi * x / 0.08) +
                                  x * x / model.scene.wheel->diameter);
  EXPECT_NEAR(middle, traced, 0.03 * std::abs(traced) + 1e-7);
  // None on the smooth rail.
  EXPECT_EQ(model.relief(model.corrugation.first() - 0.01).at(std::pow(model.vehicle.load(), 2.0 / 3)), 0);
  MultibodyModel smooth = multibody_model(scene(""), BeamTheory::euler);
  EXPECT_THROW(use_half_space_contact(smooth), InputError);
}

TEST(SineContact, FollowsTheCorrugationsCentre) {
  const auto with_centre = [](double millimetres) {
    MultibodyModel model = multibody_model(
        scene(kCorrugationD + fmt::format("centre = \"{} mm\"\n", millimetres)), BeamTheory::euler);
    use_half_space_contact(model);
    return model;
  };
  // Beside the waves the wheel rolls on the smooth rail.
  const MultibodyModel beside = with_centre(60);
  EXPECT_EQ(beside.roughness(2.44), 0);
  EXPECT_EQ(beside.relief(2.44).at(std::pow(beside.vehicle.load(), 2.0 / 3)), 0);
  EXPECT_EQ(contact_filter_gain(beside, 0.08), 1);
  // Without load the wheel in a trough stands where the slopes across of wheel and rail are the same.
  const MultibodyModel aside = with_centre(15);
  const CorrugationSpec& sine = *aside.scene.corrugation;
  const double bend = 2 * sine.depth / (sine.width * sine.width);
  const double slope = bend * (aside.corrugation.centre() - aside.contact_y);
  const double rise = 0.5 * slope * slope / (1 / aside.radius_y - bend);
  EXPECT_NEAR(aside.relief(2.44).at(0), -rise, 0.02 * rise);
  // On a slope across, the filter takes 9 % of the depth; in the middle of the waves it takes 5.5 %.
  const double gain = contact_filter_gain(aside, 0.08);
  measured("gain 15 mm beside the middle", gain);
  EXPECT_LT(gain, 0.92);
  EXPECT_NEAR(gain_of_pressed_sine(aside), gain, 5e-3);
}

TEST(SineContact, BridgesATroughMoreCurvedAcrossThanTheWheel) {
  const auto narrow = [](double width_mm, double depth_mm) {
    return multibody_model(
        scene(fmt::format("[corrugation]\nwavelength = \"80 mm\"\nwidth = \"{} mm\"\ndepth = \"{} mm\"\n",
                          width_mm, depth_mm)),
        BeamTheory::euler);
  };
  MultibodyModel shallow = narrow(6, 0.05);
  use_half_space_contact(shallow);
  EXPECT_NEAR(gain_of_pressed_sine(shallow), contact_filter_gain(shallow, 0.08), 0.02);
  // The wheel stands on both edges of a deep trough.
  const MultibodyModel deep = narrow(12, 0.5);
  const double sagitta = 0.5 * std::pow(0.012, 2) / deep.radius_y;
  EXPECT_NEAR(contact_filter_gain(deep, 0.08), sagitta / 0.5e-3, 0.03);
}

}  // namespace
}  // namespace tread
