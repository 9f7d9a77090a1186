// The operator of J2 plasticity for one index, beside closed forms.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "kernels/material/j2_plasticity.hpp"
#include "kernels/material/linear_elastic.hpp"

namespace tread {
namespace {

using Law = J2Plasticity<double>;
using State = Law::State<double>;
using Tensor = std::array<std::array<double, 3>, 3>;

constexpr double kYoung = 210e9, kPoisson = 0.3, kYield = 400e6, kIsotropic = 8e9, kKinematic = 12e9;

Material steel(double isotropic = kIsotropic, double kinematic = kKinematic) {
  Material material{"steel", kYoung, kPoisson, 7800};
  material.law = "j2";
  material.yield_stress = kYield;
  material.isotropic_hardening = isotropic;
  material.kinematic_hardening = kinematic;
  return material;
}

double von_mises(const double (&s)[6]) {
  const double xy = s[0] - s[1], yz = s[1] - s[2], zx = s[2] - s[0];
  return std::sqrt(0.5 * (xy * xy + yz * yz + zx * zx) + 3 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]));
}

/// Axial stress of an axial strain that leaves the sides free of stress; advances the state.
double uniaxial(const Law& law, double axial, State& state) {
  double across = -kPoisson * axial;
  double e[6];
  double s[6];
  for (int i = 0; i < 200; ++i) {
    State trial = state;
    const double strain[6] = {axial, across, across, 0, 0, 0};
    std::copy_n(strain, 6, e);
    law.stress(e, trial, s);
    if (std::abs(s[1]) < 1e-9 * kYield) break;
    across -= s[1] / (2 * (law.bulk_modulus + law.shear_modulus / 3));
  }
  law.stress(e, state, s);
  EXPECT_NEAR(s[1], 0, 1e-6 * kYield);
  EXPECT_NEAR(s[2], 0, 1e-6 * kYield);
  return s[0];
}

TEST(J2Plasticity, IsLinearElasticBelowYield) {
  const Law law = Law::of(steel());
  const auto elastic = LinearElastic<double>::of(steel());
  State state{};
  const double e[6] = {4e-4, -3e-4, 1e-4, 5e-4, -2e-4, 3e-4};
  double s[6];
  double expected[6];
  law.stress(e, state, s);
  elastic.stress(e, expected);
  ASSERT_LT(von_mises(expected), kYield);
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(s[i], expected[i], 1e-14 * kYoung * 1e-3);
  for (const double strain : state.plastic_strain) EXPECT_EQ(strain, 0);
  EXPECT_EQ(state.equivalent, 0);
  EXPECT_EQ(law.dissipated(state), 0);
  EXPECT_NEAR(law.energy(e, state), elastic.energy(e, {}), 1e-12 * elastic.energy(e, {}));
}

TEST(J2Plasticity, AnUndeformedElementKeepsItsZeros) {
  const Law law = Law::of(steel());
  State state{};
  const double e[6] = {};
  double s[6];
  law.stress(e, state, s);
  for (const double stress : s) EXPECT_EQ(stress, 0);
}

// Loaded to three times the yield strain, unloaded, loaded backwards: slopes E and E H / (E + H); the range
// without yield is twice the yield stress of that moment.
TEST(J2Plasticity, BarInTensionHasTheTangentModulus) {
  const double h = kIsotropic + kKinematic;
  const double tangent = kYoung * h / (kYoung + h);
  const double yield_strain = kYield / kYoung;
  const Law law = Law::of(steel());
  State state{};
  EXPECT_NEAR(uniaxial(law, 0.999 * yield_strain, state), 0.999 * kYield, 1e-9 * kYield);
  EXPECT_EQ(state.equivalent, 0);
  const double peak = kYield + tangent * 2 * yield_strain;
  for (int step = 1; step <= 20; ++step) {
    const double strain = (1 + 0.1 * step) * yield_strain;
    EXPECT_NEAR(uniaxial(law, strain, state), kYield + tangent * (strain - yield_strain), 1e-8 * kYield);
  }
  const double plastic = (peak - kYield) / h;
  EXPECT_NEAR(state.equivalent, plastic, 1e-9 * plastic);
  EXPECT_NEAR(state.plastic_strain[0], plastic, 1e-9 * plastic);
  EXPECT_NEAR(law.dissipated(state), kYield * plastic, 1e-9 * kYield * plastic);
  // Unloading is elastic; the residual strain is the plastic one.
  const State loaded = state;
  EXPECT_NEAR(uniaxial(law, plastic, state), 0, 1e-8 * kYield);
  EXPECT_EQ(state.equivalent, loaded.equivalent);
  const double range = 2 * (kYield + kIsotropic * plastic);
  const double reversed = 3 * yield_strain - range / kYoung;
  EXPECT_NEAR(uniaxial(law, reversed, state), peak - range, 1e-8 * kYield);
  EXPECT_NEAR(uniaxial(law, reversed - yield_strain, state), peak - range - tangent * yield_strain,
              1e-8 * kYield);
}

/// Shear stress [Pa] of a shear strain 2xy.
double shear(const Law& law, double gamma, State& state) {
  const double e[6] = {0, 0, 0, 0, 0, gamma};
  double s[6];
  law.stress(e, state, s);
  for (int i = 0; i < 5; ++i) EXPECT_EQ(s[i], 0);
  return s[5];
}

struct Hardening {
  double isotropic, kinematic;
};
class CyclicShear : public testing::TestWithParam<Hardening> {};

// Simple shear between +-gamma: after n half cycles the equivalent plastic strain p, the centre X of the
// elastic range and its half width R follow from |tau - X| = R, R = (Y + Hi p) / sqrt 3, X = Hk gp / 3.
TEST_P(CyclicShear, HasTheStressRangeAndShiftOfItsHardening) {
  const auto [isotropic, kinematic] = GetParam();
  const Law law = Law::of(steel(isotropic, kinematic));
  const double root = std::sqrt(3.0);
  const double g = law.shear_modulus;
  const double amplitude = 4 * kYield / (root * g);
  State state{};
  double plastic = 0;  // shear strain
  double equivalent = 0;
  for (int half = 0; half < 6; ++half) {
    const double sign = half % 2 == 0 ? 1 : -1;
    const double gamma = sign * amplitude;
    // One large step: the return is exact for a proportional path.
    const double stress = shear(law, gamma, state);
    const double radius = (kYield + isotropic * equivalent) / root;
    const double excess = std::abs(g * (gamma - plastic) - kinematic * plastic / 3) - radius;
    const double flow = std::max(0.0, excess / (g + (isotropic + kinematic) / 3));
    plastic += sign * flow;
    equivalent += flow / root;
    EXPECT_NEAR(stress, g * (gamma - plastic), 1e-10 * kYield);
    EXPECT_NEAR(state.equivalent, equivalent, 1e-12);
    EXPECT_NEAR(state.plastic_strain[5], plastic, 1e-12);
    // The elastic range about the backstress.
    if (flow > 0) {
      EXPECT_NEAR(stress - kinematic * plastic / 3, sign * (kYield + isotropic * equivalent) / root,
                  1e-10 * kYield);
      State back = state;
      const double width = 2 * (kYield + isotropic * equivalent) / root;
      shear(law, gamma - sign * 0.999 * width / g, back);
      EXPECT_EQ(back.equivalent, state.equivalent);
      shear(law, gamma - sign * 1.001 * width / g, back);
      EXPECT_GT(back.equivalent, state.equivalent);
    }
  }
  // Kinematic hardening alone: a stabilised loop; isotropic: the loop narrows.
  const double last = equivalent;
  shear(law, amplitude, state);
  const double seventh = state.equivalent - last;
  shear(law, -amplitude, state);
  const double eighth = state.equivalent - last - seventh;
  if (isotropic == 0)
    EXPECT_NEAR(eighth, seventh, 1e-12);
  else
    EXPECT_LT(eighth, seventh);
}
INSTANTIATE_TEST_SUITE_P(Hardenings, CyclicShear,
                         testing::Values(Hardening{0, 0}, Hardening{8e9, 0}, Hardening{0, 12e9},
                                         Hardening{8e9, 12e9}));

Tensor rotation(double a, double b) {
  const double ca = std::cos(a), sa = std::sin(a), cb = std::cos(b), sb = std::sin(b);
  return {{{ca, -sa * cb, sa * sb}, {sa, ca * cb, -ca * sb}, {0, sb, cb}}};
}

/// R T R^T of a tensor written as six values whose shear parts are `factor` times the components.
void turned(const Tensor& r, const double (&from)[6], double factor, double (&to)[6]) {
  Tensor t{};
  Tensor result{};
  for (std::size_t i = 0; i < 3; ++i) {
    t[i][i] = from[i];
    t[(i + 1) % 3][(i + 2) % 3] = t[(i + 2) % 3][(i + 1) % 3] = from[3 + i] / factor;
  }
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t l = 0; l < 3; ++l) result[i][j] += r[i][k] * t[k][l] * r[j][l];
  for (std::size_t i = 0; i < 3; ++i) {
    to[i] = result[i][i];
    to[3 + i] = factor * result[(i + 1) % 3][(i + 2) % 3];
  }
}

// A path of three legs that is not proportional, in turned axes: the stress turns along.
TEST(J2Plasticity, FullTensorTurnsWithTheAxes) {
  const Law law = Law::of(steel());
  const Tensor r = rotation(0.7, -1.1);
  const double path[3][6] = {{3e-3, -1e-3, -2e-3, 1e-3, 0, 2e-3},
                             {1e-3, 2e-3, -1e-3, -3e-3, 2e-3, -1e-3},
                             {-4e-3, 1e-3, 0, 2e-3, 5e-3, 3e-3}};
  State state{};
  State other{};
  for (const auto& e : path) {
    double s[6];
    double s_turned[6];
    double e_turned[6];
    double expected[6];
    law.stress(e, state, s);
    turned(r, e, 2, e_turned);
    law.stress(e_turned, other, s_turned);
    turned(r, s, 1, expected);
    for (int i = 0; i < 6; ++i) EXPECT_NEAR(s_turned[i], expected[i], 1e-10 * kYield);
    EXPECT_NEAR(other.equivalent, state.equivalent, 1e-14);
    EXPECT_NEAR(law.energy(e_turned, other), law.energy(e, state), 1e-10 * law.energy(e, state));
  }
}

// However far a step goes, the stress lies on the yield surface, plastic strain has no volume, and the same
// strain again changes nothing.
TEST(J2Plasticity, LargeStepsEndOnTheYieldSurface) {
  const Law law = Law::of(steel());
  for (const double size : {1.0, 10.0, 1e3}) {
    State state{};
    const double e[6] = {2e-3 * size, -1e-3 * size, 1e-3 * size, 3e-3 * size, -2e-3 * size, 1e-3 * size};
    double s[6];
    law.stress(e, state, s);
    double beyond[6];
    for (int i = 0; i < 3; ++i) {
      beyond[i] = s[i] - 2.0 / 3 * kKinematic * state.plastic_strain[i];
      beyond[3 + i] = s[3 + i] - 1.0 / 3 * kKinematic * state.plastic_strain[3 + i];
    }
    EXPECT_NEAR(von_mises(beyond) / (kYield + kIsotropic * state.equivalent), 1, 1e-9);
    EXPECT_NEAR(state.plastic_strain[0] + state.plastic_strain[1] + state.plastic_strain[2], 0, 1e-15 * size);
    const State once = state;
    law.stress(e, state, s);
    EXPECT_NEAR(state.equivalent, once.equivalent, 1e-12 * once.equivalent);
  }
}

// Work of the stress along a fine path = stored + dissipated; the error of the backward step falls with its
// length.
TEST(J2Plasticity, WorkIsStoredOrDissipated) {
  const Law law = Law::of(steel());
  const auto missing = [&](int steps) {
    State state{};
    double work = 0;
    double before[6] = {};
    double at[6] = {};
    for (int step = 1; step <= steps; ++step) {
      const double turn = 4 * std::numbers::pi * step / steps;
      const double next[6] = {6e-3 * std::sin(turn),       -2e-3 * std::sin(turn),
                              1e-3 * (1 - std::cos(turn)), 0,
                              4e-3 * (1 - std::cos(turn)), 3e-3 * std::sin(0.5 * turn)};
      double s[6];
      law.stress(next, state, s);
      for (int i = 0; i < 6; ++i) work += 0.5 * (s[i] + before[i]) * (next[i] - at[i]);
      std::copy_n(s, 6, before);
      std::copy_n(next, 6, at);
    }
    return work / (law.energy(at, state) + law.dissipated(state)) - 1;
  };
  EXPECT_LT(std::abs(missing(2000)), 2e-3);
  EXPECT_LT(std::abs(missing(4000)), 0.6 * std::abs(missing(2000)));
}

TEST(J2Plasticity, SinglePrecisionIsAsPreciseAsItsNumbers) {
  const Law law = Law::of(steel());
  const auto single = J2Plasticity<float>::of(steel());
  State state{};
  J2Plasticity<float>::State<float> rounded{};
  for (int step = 1; step <= 100; ++step) {
    const double size = 5e-5 * step;
    const double e[6] = {2 * size, -size, 0.5 * size, size, 0, -2 * size};
    const float f[6] = {static_cast<float>(e[0]), static_cast<float>(e[1]), static_cast<float>(e[2]),
                        static_cast<float>(e[3]), static_cast<float>(e[4]), static_cast<float>(e[5])};
    double s[6];
    float r[6];
    law.stress(e, state, s);
    single.stress(f, rounded, r);
    for (int i = 0; i < 6; ++i) EXPECT_NEAR(static_cast<double>(r[i]), s[i], 1e-4 * kYield);
  }
  EXPECT_NEAR(static_cast<double>(rounded.equivalent), state.equivalent, 1e-5 * state.equivalent);
}

}  // namespace
}  // namespace tread
