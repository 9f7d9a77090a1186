// Steps that several ranks share have the bits of one process. Ranks are threads here.

#include <gtest/gtest.h>

#include <fstream>
#include <span>
#include <string>
#include <vector>

#include "drivers/results/run_results.hpp"
#include "tests/temporary_folder.hpp"
#include "tests/thread_ranks.hpp"
#include "tests/tyre_scene.hpp"

namespace tread {
namespace {

/// A scene on one process, and on several ranks from there on.
class Case {
 public:
  explicit Case(const Scene& scene) : of_(scene), one_(of_.start(nullptr)) {}

  /// Steps on `count` ranks are those of one process; all fields are compared at these steps. `shares`: of
  /// the work, by rank; none: the expected ones.
  void expect_same_steps(int count, const std::vector<std::int64_t>& looks,
                         const std::vector<double>& shares = {}) {
    const samples::SharedRun shared(of_, *one_, count, shares);
    for (const std::int64_t look : looks) {
      const std::int64_t steps = one_->steps() + look;
      shared.roll_on(steps);
      while (one_->steps() < steps) one_->step();
      EXPECT_EQ(samples::differences(one_->state(), shared.front().state()), "")
          << count << " ranks, " << steps;
      for (const auto& simulation : shared.simulations())
        EXPECT_EQ(history_row(of_.model(), one_->sample()), history_row(of_.model(), simulation->sample()));
      const std::vector<double> measured = measurements(shared.front());
      if (measured.empty()) continue;  // the ranks have not sampled as yet
      EXPECT_EQ(measurements(*one_), measured) << count << " ranks, " << steps;
    }
    EXPECT_EQ(measurements(shared.front()).size(), one_->measurements().channels().size());
  }

 private:
  static std::vector<double> measurements(const Simulation& simulation) {
    const std::span<const double> values = simulation.measurements().values();
    return {values.begin(), values.end()};
  }

  samples::PreloadedScene of_;
  std::unique_ptr<Simulation> one_;
};

const std::vector<std::int64_t> kLooks = {1, 63, 36, 170};  // the wheel is anchored after 256 steps
const std::vector<int> kCounts = {2, 3, 4, 7};

/// The runs of all numbers of ranks follow one another.
void expect_same_bits_on(const std::vector<int>& counts, const Scene& scene,
                         const std::vector<std::int64_t>& looks = kLooks) {
  Case of(scene);
  for (const int count : counts) of.expect_same_steps(count, looks);
}

/// On three ranks in less than double: the cut does not depend on the precision.
void expect_same_bits(const Scene& scene, const std::vector<std::int64_t>& looks = kLooks) {
  expect_same_bits_on(scene.precision == "double" ? kCounts : std::vector{3}, scene, looks);
}

Scene tyre(const std::string& precision, std::vector<std::string> overrides) {
  overrides.insert(overrides.end(), {"scene.element_size=10 mm", "motion.duration=1 ms",
                                     "solution_zone.start=5 mm", "scene.precision=" + precision});
  return samples::tyre_scene(overrides);
}

Scene file(const std::string& name, const std::string& precision, std::vector<std::string> overrides) {
  overrides.push_back("scene.precision=" + precision);
  return read_scene(std::string(TREAD_SOURCE_DIR) + "/scenes/" + name + ".toml", overrides);
}

constexpr const char* kPrecisions[] = {"double", "mixed", "single"};

TEST(Ranks, TractionOverCorrugation) {
  for (const char* precision : kPrecisions)
    expect_same_bits_on(kCounts, tyre(precision, {"motion.traction.torque=13.8 kN m",
                                                  "motion.traction.ramp=0.05 ms", "corrugation.kind=sine",
                                                  "corrugation.wavelength=20 mm", "corrugation.depth=0.04 mm",
                                                  "corrugation.width=30 mm", "corrugation.start=5 mm",
                                                  "corrugation.length=40 mm", "corrugation.apply=nodes"}));
}

TEST(Ranks, MaxwellBranches) {
  for (const char* precision : kPrecisions)
    expect_same_bits(samples::tyre_with_maxwell_branches(
        {"scene.element_size=10 mm", "motion.duration=0.5 ms", std::string("scene.precision=") + precision}));
}

const std::vector<std::string> kPlastic = {
    "material.steel.law=j2", "material.steel.yield_stress=300 MPa",
    "material.steel.isotropic_hardening=20 GPa",
    "material.steel.damping={ kind = \"rayleigh_beta\", value = \"1e-8 s\" }"};

TEST(Ranks, PlasticMaterialWithDamping) {
  for (const char* precision : kPrecisions) expect_same_bits(tyre(precision, kPlastic));
}

/// Samples alone read the state of laws. Rank 0 gets all of it at the end of each stretch.
TEST(Ranks, LooksAtTheEnergiesFetchNoStateOfLaws) {
  const samples::PreloadedScene of(tyre("double", kPlastic));
  const samples::SharedRun shared(of, *of.start(nullptr), 2);
  const auto received_until = [&](std::int64_t steps) {
    const std::int64_t before = shared.received();
    shared.roll_on(steps);
    return shared.received() - before;
  };
  received_until(20);
  const std::int64_t without = received_until(30);
  const std::int64_t with_look = received_until(40);  // after 35 steps
  EXPECT_GT(without, 0);
  EXPECT_LT(with_look, 1.1 * static_cast<double>(without));
}

TEST(Ranks, GuidedBoreAndFallingFriction) {
  expect_same_bits(
      tyre("double", {"wheel.bore=guided", "motion.traction.torque=5 kN m", "motion.traction.ramp=0.05 ms",
                      "contact.friction_law=falling", "contact.friction_memory=0.2 mm"}));
}

/// Rank 0 measures all over the mesh.
TEST(Ranks, MeasurementsOnSleepers) {
  const samples::TemporaryFolder folder;
  const std::string friction = (folder.path / "friction.txt").string();
  std::ofstream(friction) << "# x [mm]  f [-]\n0 0.5\n20 0.1\n";
  const std::string map = (folder.path / "map.txt").string();
  std::ofstream(map) << "# x [mm]  y [mm]  d [um]\n-20 -5 0\n30 -5 10\n-20 9 0\n30 9 20\n";
  expect_same_bits_on({2, 4},
                      tyre("double", samples::on_sleepers({"motion.start=rigid",
                                                           "motion.traction.torque=5 kN m",
                                                           "motion.traction.ramp=0.05 ms",
                                                           "fastenings.damping=20 kN s/m",
                                                           "support.soft.fastening=2",
                                                           "support.soft.stiffness=0.5",
                                                           "surface.squat.kind=map",
                                                           "surface.squat.at=4 mm",
                                                           "surface.squat.file=" + map,
                                                           "contact.friction_law=table",
                                                           "contact.friction_file=" + friction,
                                                           "contact.friction_start=-5 mm",
                                                           "probe.head.x=20 mm",
                                                           "probe.head.quantity=all",
                                                           "probe.far.x=0.6 m",
                                                           "probe.far.depth=30 mm",
                                                           "probe.rim.body=wheel",
                                                           "probe.rim.quantity=stress",
                                                           "probe.box.body=axle_box",
                                                           "output.fastening_forces=true",
                                                           "output.stress_depth=20 mm"})),
                      {1, 63, 36});
}

TEST(Ranks, HammerOnARailOnFastenings) {
  expect_same_bits(file("hammer", "double", {}));
}

TEST(Ranks, WheelsetWithAVehicleOnASlab) {
  for (const char* precision : kPrecisions)
    expect_same_bits(
        file("smooth", precision,
             {"scene.element_size=10 mm", "motion.duration=0.3 ms", "motion.start=moving",
              "rail.length=2.6 m", "rail.origin=1.3 m", "fastenings.count=4", "fastenings.first=0.325 m",
              "solution_zone.start=20 mm", "solution_zone.length=50 mm"}));
}

/// Steps go on with other shares where those before ended.
TEST(Ranks, OtherSharesOnTheWay) {
  for (const char* precision : kPrecisions) {
    Case of(tyre(precision, {"motion.traction.torque=5 kN m", "motion.traction.ramp=0.05 ms"}));
    of.expect_same_steps(3, {20});
    of.expect_same_steps(3, {70}, {0.05, 0.25, 0.7});
    of.expect_same_steps(3, {20}, {0.6, 0.3, 0.1});
  }
}

/// Between two looks at the energies the wheel leaves the points of the last one behind.
TEST(Ranks, FastWheelOnLargeElements) {
  expect_same_bits(tyre("double", {"scene.element_size=20 mm", "motion.speed=1000 km/h",
                                   "solution_zone.length=0.1 m", "rail.length=1 m", "rail.origin=0.2 m"}),
                   {1, 140});
}

/// A tile more or less for a rank does not show, and ranks without a tile are idle.
TEST(Ranks, MoreRanksThanTiles) {
  Case of(tyre("double", {"scene.element_size=20 mm"}));
  of.expect_same_steps(40, {1, 20});
}

}  // namespace
}  // namespace tread
