// Nodes and elements in mixed and single precision beside double: kernels, and whole runs.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "core/parallel/parallel.hpp"
#include "drivers/engine/simulation.hpp"
#include "drivers/engine/start/preload.hpp"
#include "drivers/engine/start/step_limit.hpp"
#include "kernels/blocks/internal_force.hpp"
#include "tests/field_differences.hpp"
#include "tests/measured.hpp"
#include "tests/swept_samples.hpp"
#include "tests/tyre_scene.hpp"

namespace tread {
namespace {

/// Runs of tiles with equal elements, which the loop may take two at a time, and others; swept and moved.
Mesh long_blocks() {
  constexpr double kTurn = 6.283185307179586;
  const Section section = samples::grid_section({3, 2, -0.01, 0.05, 0.03, 0.02, 0.2});
  Mesh mesh;
  for (const bool moved : {false, true})
    for (const Sweep sweep : {Sweep::extruded, Sweep::revolved, Sweep::revolved}) {
      const bool closed = sweep == Sweep::revolved && mesh.blocks.size() % 3 == 2;
      std::vector<Segment> segments = {{21, 0.01, 0}, {37, 0.004, 1}};         // [m]
      if (sweep == Sweep::revolved) segments = {{21, 0.06, 0}, {37, 0.1, 1}};  // [rad]
      if (closed) segments = {{48, kTurn / 48, 0}};
      SweptBlock block = make_swept_block("block", sweep, section, samples::materials(), -0.1, segments);
      if (moved) samples::shift_nodes(block, 3e-4, 1);
      mesh.add(std::move(block));
    }
  return mesh;
}

/// Sets damping and finite rotation in some blocks.
template <class Force>
void choose_laws(Force& force) {
  for (const int block : {1, 3, 5}) force.set_finite_rotation(block, true);
  for (const int block : {0, 2, 4}) force.set_beta(block, 1e-7);
}

/// Largest error of forces over the largest force, over all instruction sets; unused lanes must hold zero.
template <class U>
double force_error(const Mesh& mesh, const AlignedVector<double>& u, const AlignedVector<double>& v) {
  InternalForce force(mesh);
  BasicInternalForce<float, U> rounded(mesh);
  choose_laws(force);
  choose_laws(rounded);
  const AlignedVector<U> u_rounded(u.begin(), u.end());
  const AlignedVector<float> v_rounded(v.begin(), v.end());
  AlignedVector<double> f(u.size());
  force.internal_force(u.data(), v.data(), f.data());
  double error = 0;
  for (const char* set : InternalForce::instruction_sets()) {
    rounded.use_instruction_set(set);
    AlignedVector<float> found(u.size(), 1e30F);
    rounded.internal_force(u_rounded.data(), v_rounded.data(), found.data());
    error = std::max(error, samples::difference(found, f));
    for (std::size_t i = 0; i < f.size(); ++i)
      if (f[i] == 0) {
        EXPECT_EQ(found[i], 0) << set;
      }
  }
  return error / samples::largest(f);
}

TEST(PrecisionOfForces, DifferencesAreFormedBeforeTheyAreRounded) {
  const Mesh mesh = long_blocks();
  const auto deformed = samples::random_field(mesh);
  const auto v = samples::random_field(mesh, 4);
  constexpr double kCarried = 1e-3;  // a hundred times the deformation [m]
  auto u = samples::sample(mesh, [](const Vec3&) { return Vec3{kCarried, -kCarried, kCarried}; });
  for (std::size_t i = 0; i < u.size(); ++i) u[i] += deformed[i];
  const double at_rest = force_error<float>(mesh, deformed, v);
  const double mixed = force_error<double>(mesh, u, v);
  const double single = force_error<float>(mesh, u, v);
  measured("error of forces, single, not carried", at_rest);
  measured("error of forces, mixed, carried", mixed);
  measured("error of forces, single, carried", single);
  EXPECT_LT(at_rest, 2e-6);
  EXPECT_LT(mixed, 2e-6);
  EXPECT_LT(single, 1e-4);
  EXPECT_GT(single, 5 * mixed);
}

template <class U>
void expect_same_bits() {
  const Mesh mesh = long_blocks();
  BasicInternalForce<float, U> force(mesh);
  choose_laws(force);
  const auto u_double = samples::random_field(mesh);
  const auto v_double = samples::random_field(mesh, 4);
  const AlignedVector<U> u(u_double.begin(), u_double.end());
  const AlignedVector<float> v(v_double.begin(), v_double.end());
  AlignedVector<float> one(u.size());
  for (const char* set : InternalForce::instruction_sets()) {
    force.use_instruction_set(set);
    set_threads(1);
    force.internal_force(u.data(), v.data(), one.data());
    for (const int count : {2, 3, 5, 16}) {
      set_threads(count);
      AlignedVector<float> many(u.size(), 1e30F);
      force.internal_force(u.data(), v.data(), many.data());
      EXPECT_EQ(std::memcmp(one.data(), many.data(), one.size() * sizeof(float)), 0) << set << ' ' << count;
    }
  }
  set_threads(1);
}

TEST(PrecisionOfForces, SameBitsForAnyNumberOfThreads) {
  expect_same_bits<double>();
  expect_same_bits<float>();
}

TEST(PrecisionOfEnergy, IsThatOfDouble) {
  const Mesh mesh = long_blocks();
  const auto u = samples::random_field(mesh);
  const AlignedVector<float> u_single(u.begin(), u.end());
  InternalForce force(mesh);
  BasicInternalForce<float, double> mixed(mesh);
  BasicInternalForce<float> single(mesh);
  choose_laws(force);
  choose_laws(mixed);
  choose_laws(single);
  for (int block = 0; block < static_cast<int>(mesh.blocks.size()); ++block) {
    const DeformationEnergy expected = force.energy(block, u.data());
    for (const DeformationEnergy& found :
         {mixed.energy(block, u.data()), single.energy(block, u_single.data())}) {
      EXPECT_NEAR(found.strain / expected.strain, 1, 1e-6);
      EXPECT_NEAR(found.hourglass / expected.hourglass, 1, 1e-6);
    }
  }
}

/// A tyre under torque, rolled for a while from one static state.
class Rolled {
 public:
  explicit Rolled(const std::vector<std::string>& overrides)
      : model_(samples::tyre_scene(overrides)),
        preload_(solve_preload(model_, steady_motion(model_), [](const std::string& /*text*/) {})),
        dt_(model_.scene.motion->step_safety * step_limit(model_).stable_step) {
    if (model_.scene.corrugation) model_.apply_corrugation(preload_.contact.pressure_peak.y);
  }

  struct Run {
    std::uint64_t hash;
    double mean_force;  ///< mean force of the samples [N]
    Sample last;
  };
  Run run(const std::string& precision, int threads = 1, std::string_view by = "openmp",
          std::int64_t interval = 10) {
    set_backend(by);
    set_threads(threads);
    model_.scene.precision = precision;
    Simulation simulation(model_, preload_, dt_);
    simulation.set_sampling_interval(interval);
    double sum = 0;
    int samples = 0;
    while (simulation.time() < model_.scene.motion->duration) {
      simulation.step();
      if (!simulation.sampled()) continue;
      sum += simulation.sample().vertical_force;
      ++samples;
    }
    set_threads(1);
    set_backend(backends().front());
    return {simulation.state_hash(), sum / samples, simulation.sample()};
  }

 private:
  Model model_;
  Preload preload_;
  double dt_;
};

const std::vector<std::string> kDriven = {"scene.element_size=8 mm", "motion.duration=0.2 ms",
                                          "motion.traction.torque=13.8 kN m", "motion.traction.ramp=0.05 ms",
                                          "solution_zone.start=5 mm"};

TEST(PrecisionOfRuns, ForcesAndWorkAreThoseOfDouble) {
  Rolled tyre(kDriven);
  const Rolled::Run expected = tyre.run("double");
  for (const auto& [precision, bound] : {std::pair("mixed", 1e-5), std::pair("single", 1e-3)}) {
    const Rolled::Run found = tyre.run(precision);
    const auto compare = [&, name = precision, most = bound](const char* what, double a, double b) {
      measured(std::string(name) + ": " + what + " / double - 1", a / b - 1);
      EXPECT_NEAR(a / b, 1, most) << name << ' ' << what;
    };
    compare("mean F_N", found.mean_force, expected.mean_force);
    compare("F_L", found.last.longitudinal_force, expected.last.longitudinal_force);
    compare("largest pressure", found.last.max_pressure, expected.last.max_pressure);
    compare("frictional work", found.last.energy.frictional_work, expected.last.energy.frictional_work);
    compare("strain energy", found.last.energy.strain, expected.last.energy.strain);
    compare("kinetic energy", found.last.energy.kinetic, expected.last.energy.kinetic);
    EXPECT_NE(found.hash, expected.hash);
  }
}

TEST(PrecisionOfRuns, SameBitsForAnyThreadsAndWayToMove) {
  std::vector<std::string> overrides = kDriven;
  overrides[1] = "motion.duration=0.03 ms";
  for (const char* more :
       {"corrugation.kind=sine", "corrugation.wavelength=20 mm", "corrugation.depth=0.04 mm",
        "corrugation.width=30 mm", "corrugation.start=5 mm", "corrugation.length=40 mm"})
    overrides.emplace_back(more);
  Rolled tyre(overrides);
  for (const char* precision : {"mixed", "single"}) {
    const Rolled::Run one = tyre.run(precision);
    EXPECT_GT(one.mean_force, 1e4);
    for (const auto& [threads, by] : {std::pair(2, "openmp"), std::pair(3, "tbb")}) {
      const Rolled::Run more = tyre.run(precision, threads, by);
      EXPECT_EQ(more.hash, one.hash) << precision << ' ' << threads << ' ' << by;
      EXPECT_EQ(more.last.energy.residual, one.last.energy.residual);
    }
    // Sampled steps move all nodes after the elements.
    EXPECT_EQ(tyre.run(precision, 1, "openmp", 1).hash, one.hash) << precision;
  }
}

}  // namespace
}  // namespace tread
