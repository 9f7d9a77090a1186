// Steps on the card of this machine are those of the processor, with the same bits from run to run. Without a
// card each test is skipped and says why.

#include <gtest/gtest.h>

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "tests/device_cases.hpp"
#include "tests/thread_ranks.hpp"

namespace tread {
namespace {

using namespace samples;

class Gpu : public testing::Test {
 protected:
  static std::shared_ptr<Device> card() { return open_gpu(gpu_numbers().front()); }
  void SetUp() override {
    if (gpus().empty()) GTEST_SKIP() << "not tested on a card: " << why_no_gpu();
  }

  /// In double: fields and contact of the processor's steps. In less: displacements within 1e-5 of their
  /// range, and no more noise of velocities than the processor's steps have.
  template <class SceneOf>
  static void expect_same_steps(const SceneOf& scene, std::int64_t steps,
                                const std::vector<std::string>& precisions = kPrecisions) {
    PreloadedScene exact(scene("double"));
    const auto in_double = roll(exact.start(nullptr), steps);
    PreloadedScene at(scene("double"));
    for (const std::string& precision : precisions) {
      SCOPED_TRACE(precision);
      at.set_precision(precision);
      const auto on_card = roll(at.start(card()), steps);
      const StateBytes state = bytes(on_card->state());
      const Apart error = expect_same_fields(*in_double, at, *on_card, precision);
      std::printf("%s: displacements differ by %.2g, velocities by %.2g of their range\n", precision.c_str(),
                  error.displacement, error.velocity);
      EXPECT_EQ(differences(state, bytes(roll(at.start(card()), steps)->state())), "");
    }
  }
};

TEST_F(Gpu, TractionOverCorrugation) {
  std::vector<std::string> overrides = corrugated(kTraction);
  overrides.insert(overrides.end(), {"corrugation.apply=gap", "scene.element_size=8 mm"});
  expect_same_steps(tyre(overrides), 1000);
}

TEST_F(Gpu, MovedNodesAndFacets) {
  expect_same_steps(tyre(corrugated({"contact.surface=facets", "corrugation.apply=nodes"})), 300);
}

TEST_F(Gpu, MaxwellBranches) {
  const auto scene = [](const std::string& precision) {
    return tyre_with_maxwell_branches(
        {"scene.element_size=10 mm", "motion.duration=0.5 ms", "scene.precision=" + precision});
  };
  expect_same_steps(scene, 300);
}

TEST_F(Gpu, PlasticMaterial) {
  expect_same_steps(tyre({"material.steel.law=j2", "material.steel.yield_stress=300 MPa",
                          "material.steel.isotropic_hardening=20 GPa",
                          "material.steel.damping={ kind = \"rayleigh_beta\", value = \"1e-8 s\" }"}),
                    300);
}

TEST_F(Gpu, GuidedBoreAndFallingFriction) {
  expect_same_steps(
      tyre({"wheel.bore=guided", "motion.traction.torque=5 kN m", "motion.traction.ramp=0.05 ms",
            "contact.friction_law=falling", "contact.friction_memory=0.2 mm"}),
      600, {"double"});
}

TEST_F(Gpu, FlatOnTheWheel) {
  expect_same_steps(tyre({"surface.flat.kind=flat", "surface.flat.at=10 mm", "surface.flat.length=30 mm"}),
                    300, {"double"});
}

TEST_F(Gpu, HammerOnARailOnFastenings) {
  expect_same_steps(file("hammer", {}), 300, {"double"});
}

TEST_F(Gpu, WheelsetWithAVehicleOnASlab) {
  expect_same_steps(file("smooth", kHalfWheelset), 300);
}

/// Two ranks that share the card.
TEST_F(Gpu, RanksWithADeviceEach) {
  for (const std::string precision : {"double", "mixed"}) {
    const PreloadedScene of(tyre(corrugated(kTraction))(precision));
    const auto one = of.start(nullptr);
    const SharedRun two(of, *one, 2, {0.4, 0.6}, [] { return card(); });
    two.roll_on(300);
    roll_on(*one, 300);
    const Apart error = apart(of.values(), *one, two.front());
    EXPECT_LT(error.displacement, precision == "double" ? 1e-9 : 1e-5);
    if (precision == "double") {
      EXPECT_LT(error.velocity, 1e-9);
    }
  }
}

TEST_F(Gpu, CardsAreListedByTheirNumbers) {
  const std::string first = "gpu:" + std::to_string(gpu_numbers().front()) + " ";
  EXPECT_EQ(gpus().front(), first + card()->name());
}

TEST_F(Gpu, ACardThatIsNotThereIsRefused) {
  EXPECT_THROW(open_gpu(gpu_numbers().back() + 1), ResourceError);
}

}  // namespace
}  // namespace tread
