// J2 plasticity in elements: uniaxial stress in distorted and in turned blocks, an elastic-plastic wave in a
// bar, first yield under a pressed wheel, and a tyre that rolls on a yielding rail.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "core/error.hpp"
#include "core/parallel/parallel.hpp"
#include "drivers/engine/simulation.hpp"
#include "drivers/engine/start/preload.hpp"
#include "drivers/engine/start/step_limit.hpp"
#include "io/scene/scene_reader.hpp"
#include "kernels/material/laws.hpp"
#include "tests/field_differences.hpp"
#include "tests/measured.hpp"
#include "tests/refusal.hpp"
#include "tests/state_copies.hpp"
#include "tests/swept_samples.hpp"

namespace tread {
namespace {

constexpr double kYield = 400e6, kIsotropic = 8e9, kKinematic = 12e9;
constexpr double kHardening = kIsotropic + kKinematic;

const auto kSilent = [](const std::string&) {};

std::size_t index(std::int64_t i) {
  return static_cast<std::size_t>(i);
}

Material yielding(double yield = kYield) {
  Material material = samples::steel();
  material.law = "j2";
  material.yield_stress = yield;
  material.isotropic_hardening = kIsotropic;
  material.kinematic_hardening = kKinematic;
  return material;
}

/// Axial stress, axial and transverse strain of a bar at a point of a path; `plastic` is its plastic strain.
struct Uniaxial {
  double stress, plastic, equivalent;

  double axial() const { return stress / samples::steel().youngs_modulus + plastic; }
  double across() const {
    return -samples::steel().poissons_ratio * stress / samples::steel().youngs_modulus - 0.5 * plastic;
  }
  double stored() const {
    return 0.5 * (stress * stress / samples::steel().youngs_modulus + kIsotropic * equivalent * equivalent +
                  kKinematic * plastic * plastic);
  }
};

/// Loaded beyond yield, unloaded, loaded backwards beyond yield.
std::vector<Uniaxial> uniaxial_path() {
  const double p = 1e-3;
  const double back = 4e-4;
  const double reversed = -(kYield + kIsotropic * (p + back)) + kKinematic * (p - back);
  return {{0.9 * kYield, 0, 0},
          {kYield + kHardening * 0.3 * p, 0.3 * p, 0.3 * p},
          {kYield + kHardening * p, p, p},
          {0, p, p},
          {reversed, p - back, p + back}};
}

template <class Real>
void expect_uniaxial(Mesh& mesh, int axis, double turn, bool finite_rotation, double tolerance) {
  for (Material& material : mesh.blocks[0].materials) material = yielding();
  BasicInternalForce<Real> force(mesh);
  force.set_finite_rotation(0, finite_rotation);
  LawState<Real> state(mesh);
  std::vector<int> around(index(mesh.blocks[0].section.nodes()), 0);
  for (const auto& quad : mesh.blocks[0].section.quads)
    for (const int node : quad) ++around[index(node)];
  double volume = 0;
  for (const Uniaxial& at : uniaxial_path()) {
    // The strain that Green and Lagrange measure, or the linear one; then a rotation about the sweep's axis.
    const auto stretch = [&](double strain) {
      return finite_rotation ? std::sqrt(1 + 2 * strain) : 1 + strain;
    };
    const Vec3 size = axis == 0 ? Vec3{stretch(at.axial()), stretch(at.across()), stretch(at.across())}
                                : Vec3{stretch(at.across()), stretch(at.axial()), stretch(at.across())};
    const AlignedVector<Real> u = samples::sample<Real>(mesh, [&](const Vec3& x) {
      const Vec3 y = {size.x * x.x, size.y * x.y, size.z * x.z};
      const double c = std::cos(turn);
      const double s = std::sin(turn);
      return Vec3{c * y.x + s * y.z - x.x, y.y - x.y, c * y.z - s * y.x - x.z};
    });
    AlignedVector<Real> f(u.size());
    AlignedVector<Real> v(u.size(), 0);
    AlignedVector<Real> moved = u;
    force.internal_force({moved.data(), v.data(), f.data(), nullptr, &state});
    const SweptBlock& block = mesh.blocks[0];
    for (int station = 0; station + 1 < block.station_count(); ++station)
      for (int quad = 0; quad < static_cast<int>(block.section.quads.size()); ++quad) {
        const std::array<double, 6> s = force.stress(0, quad, station, u.data(), nullptr, state);
        for (int i = 0; i < 6; ++i)
          EXPECT_NEAR(s[index(i)], i == axis ? at.stress : 0, tolerance * kYield) << i;
      }
    // A homogeneous stress leaves no force inside.
    double inside = 0;
    double outside = 0;
    for (int station = 1; station + 1 < block.station_count(); ++station)
      for (int node = 0; node < block.section.nodes(); ++node)
        for (int c = 0; c < 3; ++c) {
          const auto value = static_cast<double>(f[index(dof(block.base + block.slot(node, station), c))]);
          double& largest = around[index(node)] == 4 ? inside : outside;
          largest = std::max(largest, samples::magnitude(value));
        }
    EXPECT_TRUE(std::isfinite(outside));
    EXPECT_LT(inside, 10 * tolerance * (outside + kYield * 1e-6));
    const DeformationEnergy energy = force.energy(0, u.data(), &state);
    if (volume == 0) volume = energy.strain / at.stored();
    EXPECT_NEAR(energy.strain / volume, at.stored(), 20 * tolerance * kYield * 2e-3);
    EXPECT_NEAR(energy.dissipated / volume, kYield * at.equivalent, 20 * tolerance * kYield * 2e-3);
  }
}

TEST(PlasticElements, DistortedElementsOfABarHaveTheUniaxialStress) {
  Mesh mesh;
  mesh.add(samples::extruded());
  samples::shift_nodes(mesh.blocks[0], 3e-4);
  expect_uniaxial<double>(mesh, 0, 0, false, 1e-9);
}

TEST(PlasticElements, InSinglePrecisionToo) {
  Mesh mesh;
  mesh.add(samples::extruded());
  expect_uniaxial<float>(mesh, 0, 0, false, 1e-3);
}

TEST(PlasticElements, ElementsThatTurnBySixtyDegreesHaveTheSameStress) {
  Mesh mesh;
  mesh.add(samples::revolved_open());
  expect_uniaxial<double>(mesh, 1, 1.0, true, 1e-9);
}

// A law that never yields computes what the linear law computes, damping and hourglass stiffness included.
TEST(PlasticElements, WithoutYieldTheForceIsThatOfTheLinearLaw) {
  for (const char* set : InternalForce::instruction_sets()) {
    Mesh mesh;
    mesh.add(samples::extruded());
    samples::shift_nodes(mesh.blocks[0], 3e-4);
    for (Material& material : mesh.blocks[0].materials) material = yielding(1e15);
    InternalForce force(mesh);
    force.use_instruction_set(set);
    force.set_beta(0, 1e-5);
    LawState<double> state(mesh);
    AlignedVector<double> u = samples::random_field(mesh);
    AlignedVector<double> v = samples::random_field(mesh, 7);
    for (double& value : v) value *= 1e5;
    AlignedVector<double> linear(u.size());
    AlignedVector<double> law(u.size());
    force.internal_force(u.data(), v.data(), linear.data());
    force.internal_force({u.data(), v.data(), law.data(), nullptr, &state});
    EXPECT_LT(samples::relative_difference(law, linear), 1e-12) << set;
    const DeformationEnergy expected = force.energy(0, u.data());
    const DeformationEnergy energy = force.energy(0, u.data(), &state);
    EXPECT_NEAR(energy.strain, expected.strain, 1e-12 * expected.strain);
    EXPECT_EQ(energy.hourglass, expected.hourglass);
    EXPECT_EQ(energy.dissipated, 0);
  }
}

// Two tiles abreast (single precision, widest registers) and one after the other yield alike.
TEST(PlasticElements, InstructionSetsAgreeToRounding) {
  Mesh mesh;
  mesh.add(samples::extruded());
  for (Material& material : mesh.blocks[0].materials) material = yielding();
  std::vector<AlignedVector<float>> forces;
  std::vector<double> dissipated;
  for (const char* set : InternalForce::instruction_sets()) {
    BasicInternalForce<float> force(mesh);
    force.use_instruction_set(set);
    LawState<float> state(mesh);
    const AlignedVector<double> random = samples::random_field(mesh);
    AlignedVector<float> u(random.size());
    for (const float size : {1.0F, 3.0F, -2.0F}) {
      for (std::size_t i = 0; i < u.size(); ++i) u[i] = size * static_cast<float>(random[i]);
      force.internal_force({u.data(), nullptr, forces.emplace_back(u.size()).data(), nullptr, &state});
      dissipated.push_back(force.energy(0, u.data(), &state).dissipated);
    }
  }
  for (std::size_t at = 3; at < forces.size(); ++at) {
    EXPECT_GT(dissipated[at], 0);
    EXPECT_NEAR(dissipated[at], dissipated[at % 3], 1e-5 * dissipated[at % 3]);
    const float largest = *std::max_element(forces[at].begin(), forces[at].end());
    for (std::size_t i = 0; i < forces[at].size(); ++i)
      EXPECT_NEAR(forces[at][i], forces[at % 3][i], 1e-4F * largest);
  }
}

/// A free square bar whose first half moves at `speed` [m/s] against the rest.
Scene bar_scene(double speed) {
  Scene scene;
  scene.element_size = 2.5e-3;
  scene.gravity = 0;
  scene.materials["steel"] = yielding();
  scene.materials["steel"].poissons_ratio = 0.3;
  scene.rail.emplace();
  scene.rail->profile = "box";
  scene.rail->support = "free";
  scene.rail->inclination = 0;
  scene.rail->length = 1.0;
  scene.rail->origin = 0;
  scene.rail->width = scene.rail->height = 5e-3;
  scene.pulse.emplace();
  scene.pulse->velocity = speed;
  scene.pulse->length = 0.5;
  scene.motion.emplace();
  scene.motion->duration = 80e-6;
  return scene;
}

// Speed 2 w of one half against the other: an elastic precursor of the yield stress, behind it the plastic
// wave of speed sqrt(Et / rho) with stress Y + rho c_p (w - Y / (rho c_0)). [von Karman and Duwez 1950]
TEST(PlasticBar, WaveHasPrecursorAndPlateauOfTheory) {
  const Material steel = yielding();
  const double sound = std::sqrt(steel.youngs_modulus / steel.density);
  const double tangent = steel.youngs_modulus * kHardening / (steel.youngs_modulus + kHardening);
  const double plastic_speed = std::sqrt(tangent / steel.density);
  const double w = 2.5 * kYield / (steel.density * sound);
  const double plateau = kYield + steel.density * plastic_speed * (w - kYield / (steel.density * sound));
  const Scene scene = bar_scene(2 * w);
  Model model(scene);
  Simulation simulation(model, solve_preload(model, {}, kSilent), 0.9 * step_limit(model).stable_step);
  simulation.set_sampling_interval(20);
  const EnergyLedger* ledger = &simulation.sample().energy;
  while (simulation.time() < scene.motion->duration) simulation.step();
  const SweptBlock& bar = model.mesh.blocks[0];
  // Mean stress and plastic strain between two places behind the interface.
  const auto mean = [&](double from, double to, int component) {
    double sum = 0;
    int count = 0;
    for (int station = 0; station + 1 < bar.station_count(); ++station) {
      const double x = bar.stations[index(station)] - bar.stations.front() - 0.5;
      if (x < from || x > to) continue;
      for (int quad = 0; quad < static_cast<int>(bar.section.quads.size()); ++quad, ++count)
        sum += model.internal->stress(0, quad, station, simulation.displacement(), nullptr,
                                      simulation.fields().laws())[index(component)];
    }
    return sum / count;
  };
  const double time = simulation.time();
  const double behind = -mean(0.3 * plastic_speed * time, 0.8 * plastic_speed * time, 0);
  const double ahead = -mean(1.3 * plastic_speed * time, 0.8 * sound * time, 0);
  measured("plastic wave: stress / theory", behind / plateau);
  measured("elastic precursor: stress / yield stress", ahead / kYield);
  EXPECT_NEAR(behind / plateau, 1, 0.02);
  EXPECT_NEAR(ahead / kYield, 1, 0.03);
  // Two fronts travel from the interface: dissipated work of theory.
  const double area = 25e-6;
  const double work =
      2 * area * plastic_speed * simulation.sample().time * kYield * (plateau - kYield) / kHardening;
  measured("plastic work / theory", ledger->plastic_work / work);
  measured("energy balance / plastic work", ledger->residual / ledger->plastic_work);
  EXPECT_NEAR(ledger->plastic_work / work, 1, 0.05);
  EXPECT_LT(std::abs(ledger->residual), 0.01 * ledger->plastic_work);
}

/// A tyre, as curved across as along, on a block.
Scene wheel_on_block(double element_size) {
  Scene scene;
  scene.element_size = element_size;
  scene.zone_start = -0.02;
  scene.zone_length = 0.04;
  scene.gravity = 0;
  scene.materials["steel"] = yielding();
  scene.wheel.emplace();
  scene.wheel->shape = "tyre";
  scene.wheel->profile = "arc";
  scene.wheel->diameter = 0.86;
  scene.wheel->crown_radius = 0.43;
  scene.wheel->width = 0.06;
  scene.wheel->thickness = 0.06;
  scene.wheel->lateral_offset = 0;
  scene.rail.emplace();
  scene.rail->profile = "box";
  scene.rail->support = "rigid";
  scene.rail->inclination = 0;
  scene.rail->length = 0.3;
  scene.rail->origin = 0.12;
  scene.rail->width = 0.06;
  scene.rail->height = 0.05;
  scene.load.emplace();
  scene.load->wheel_load = 80e3;
  scene.contact.emplace();
  return scene;
}

/// Equivalent plastic strain of the rail's elements at u by a law of this yield stress: the largest, its
/// depth, and the number of elements that yield.
struct Yielded {
  int elements = 0;
  double largest = 0;
  double depth = 0;  ///< of the element's centre [m]
};
Yielded yielded(const Model& model, double yield, const AlignedVector<double>& u) {
  Mesh mesh;
  mesh.add(model.mesh.blocks[index(model.index.rail_cap)]);
  mesh.blocks[0].materials = {yielding(yield)};
  const InternalForce force(mesh);
  LawState<double> state(mesh);
  const SweptBlock& rail = model.mesh.blocks[index(model.index.rail_cap)];
  AlignedVector<double> of_rail(u.begin() + 3 * rail.base, u.begin() + 3 * (rail.base + rail.slots()));
  AlignedVector<double> f(of_rail.size());
  force.internal_force({of_rail.data(), nullptr, f.data(), nullptr, &state});
  Yielded found;
  const double top = *std::max_element(rail.section.q.begin(), rail.section.q.end());
  const FrontPlan plan = make_front_plan(rail.section);
  const int values = state_values(force.law(0));
  for (std::size_t tile = 0; tile < rail.tiles.size(); ++tile)
    for (std::size_t place = 0; place < plan.quads.size(); ++place)
      for (int lane = 0; lane < rail.tiles[tile].elements; ++lane) {
        const auto quads = plan.quads.size();
        const double p = state.values(
            0)[((tile * quads + place) * index(values) + index(values - 1)) * kLanes + index(lane)];
        found.elements += p > 0;
        if (p <= found.largest) continue;
        found.largest = p;
        double centre = 0;
        for (const int node : rail.section.quads[index(plan.quads[place].quad)])
          centre += 0.25 * rail.section.q[index(node)];
        found.depth = top - centre;
      }
  return found;
}

// Two equal spheres' worth of Hertz contact: first yield at p0 = 1.60 Y in the depth 0.48 a. [Johnson
// 1985, 6.1]
TEST(PlasticContact, FirstYieldLiesBelowTheSurface) {
  Scene scene = wheel_on_block(1.5e-3);
  scene.load->wheel_load = 270e3;
  Model model(scene);
  const Preload preload = solve_preload(model, {}, kSilent);
  const double a = model.hertz_patch.semi_axis_x;
  const double p0 = model.hertz_patch.max_pressure;
  double below = p0 / 2.2;
  double above = p0 / 1.2;
  ASSERT_GT(yielded(model, below, preload.displacement).elements, 0);
  ASSERT_EQ(yielded(model, above, preload.displacement).elements, 0);
  while (above / below > 1.002) {
    const double middle = std::sqrt(below * above);
    (yielded(model, middle, preload.displacement).elements > 0 ? below : above) = middle;
  }
  const Yielded first = yielded(model, below, preload.displacement);
  measured("element / a", 1.5e-3 / a);
  measured("first yield: p0 / Y", p0 / below);
  measured("first yield: depth / a", first.depth / a);
  EXPECT_NEAR(p0 / below, 1.60, 0.06);
  EXPECT_NEAR(first.depth / a, 0.48, 0.75e-3 / a);
}

Scene rolling_scene(const std::string& precision) {
  Scene scene = wheel_on_block(6e-3);
  scene.precision = precision;
  scene.materials["steel"] = yielding(300e6);
  scene.motion.emplace();
  scene.motion->speed = 30;
  scene.motion->duration = 0.5e-3;
  return scene;
}

class RollingPlasticity : public testing::TestWithParam<std::string> {};

// Wheel and rail yield; energies balance; threads and a copied state give the same bits.
TEST_P(RollingPlasticity, DissipatesAndGoesOnWithTheSameBits) {
  const Scene scene = rolling_scene(GetParam());
  Model model(scene);
  const Preload preload = solve_preload(model, steady_motion(model), kSilent);
  const double dt = 0.9 * step_limit(model).stable_step;
  constexpr int kHalf = 130;
  set_threads(2);
  Simulation whole(model, preload, dt);
  whole.set_sampling_interval(50);
  double before = 0;
  for (int step = 0; step < 2 * kHalf; ++step) {
    whole.step();
    EXPECT_GE(whole.sample().energy.plastic_work, before);
    before = whole.sample().energy.plastic_work;
  }
  const EnergyLedger energy = whole.sample().energy;
  measured("plastic work", energy.plastic_work, "J");
  measured("energy balance / plastic work", energy.residual / energy.plastic_work);
  EXPECT_GT(energy.plastic_work, 0);
  EXPECT_LT(std::abs(energy.residual), 0.05 * energy.plastic_work);

  set_threads(1);
  Model same(scene);
  Model rest(scene);
  Simulation first(same, preload, dt);
  first.set_sampling_interval(50);
  for (int step = 0; step < kHalf; ++step) first.step();
  Simulation resumed(rest, preload.contact.centre.y, dt);
  resumed.set_sampling_interval(50);
  samples::copy(first.state(), resumed.state());
  for (int step = 0; step < kHalf; ++step) resumed.step();
  const StateList expected = whole.state();
  const StateList state = resumed.state();
  ASSERT_EQ(expected.fields().size(), state.fields().size());
  bool laws = false;
  for (std::size_t i = 0; i < state.fields().size(); ++i) {
    EXPECT_EQ(samples::bytes(state.fields()[i]), samples::bytes(expected.fields()[i]))
        << state.fields()[i].name;
    laws = laws || state.fields()[i].name.rfind("law_state/", 0) == 0;
  }
  EXPECT_TRUE(laws);
}
INSTANTIATE_TEST_SUITE_P(Precisions, RollingPlasticity, testing::Values("double", "mixed", "single"));

TEST(PlasticElements, ValuesWithoutMeaningAreRefused) {
  const auto refusal = [](double yield, double hardening) {
    Scene scene = wheel_on_block(6e-3);
    scene.materials["steel"] = yielding(yield);
    scene.materials["steel"].kinematic_hardening = hardening;
    return samples::refusal<InputError>([&] { const Model model(scene); });
  };
  EXPECT_EQ(refusal(1e6, 0), "");
  EXPECT_NE(refusal(0, 0).find("yield_stress must be above 0 Pa"), std::string::npos);
  EXPECT_NE(refusal(std::nan(""), 0).find("yield_stress"), std::string::npos);
  EXPECT_NE(refusal(1e6, -1).find("hardening must be at least 0 Pa"), std::string::npos);
}

// A scene file gives the rail's head a law of its own; wheel, rail and slab stay elastic and have no state.
TEST(PlasticHead, YieldsWhileTheRestStaysElastic) {
  const Scene scene = resolve_scene(SceneSource{"head.toml",
                                                R"(
[scene]
title = "rail head that yields"
based_on = "highspeed-slab-2014"
element_size = "11 mm"
[material.head]
youngs_modulus = "205.9 GPa"
poissons_ratio = 0.3
density = "7790 kg/m3"
law = "j2"
yield_stress = "100 MPa"
isotropic_hardening = "1 GPa"
[rail]
head_material = "head"
length = "2 m"
origin = "1 m"
[fastenings]
count = 3
first = "0.35 m"
[solution_zone]
start = "0 m"
length = "10 mm"
[motion]
start = "moving"
duration = "0.1 ms"
)",
                                                {}})
                          .scene;
  Model model(scene);
  const Preload preload = solve_preload(model, steady_motion(model), kSilent);
  Simulation run(model, preload, 0.9 * step_limit(model).stable_step);
  constexpr int kSteps = 60;
  run.set_sampling_interval(kSteps);
  for (int step = 0; step <= kSteps; ++step) run.step();
  std::vector<std::string> states;
  const StateList state = run.state();
  for (const StateList::Field& field : state.fields())
    if (field.name.starts_with("law_state/")) states.push_back(field.name);
  EXPECT_EQ(states, std::vector<std::string>{"law_state/rail head"});
  const EnergyLedger energy = run.sample().energy;
  measured("plastic work", energy.plastic_work, "J");
  measured("energy balance / plastic work", energy.residual / energy.plastic_work);
  EXPECT_GT(energy.plastic_work, 0);
  EXPECT_LT(std::abs(energy.residual), 0.05 * energy.plastic_work);
}

}  // namespace
}  // namespace tread
