// Steps of ranks that have a device each: the same bits for any number of ranks, and the processor's motion.
// Devices are emulated, with queues that are late in different ways. Their copies of others' tiles, and the
// host's of what they move, hold NaN.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <deque>
#include <functional>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/parallel/ranks.hpp"
#include "drivers/run/followers.hpp"
#include "tests/device_cases.hpp"
#include "tests/refusal.hpp"
#include "tests/thread_ranks.hpp"

namespace tread {
namespace {

using samples::corrugated;
using samples::file;
using samples::kTraction;
using samples::tyre;

/// Broadcasts of rank 0, by call.
using Told = std::deque<std::vector<std::byte>>;

/// One of two ranks: rank 0 notes what it tells, the other one hears it.
class ToldRank final : public Ranks {
 public:
  ToldRank(int rank, Told& told) : rank_(rank), told_(&told) {}
  int rank() const override { return rank_; }
  int count() const override { return 2; }
  void exchange(std::span<const RankSegment> /*sent*/, std::span<const RankSegment> /*received*/) override {}
  void post(std::span<const RankSegment> /*sent*/) override {}
  void receive(std::span<const RankSegment> /*received*/) override {}
  void end_all(int code) override { std::exit(code); }

 private:
  void broadcast_bytes(std::span<std::byte> bytes) override {
    if (rank_ == 0) {
      told_->emplace_back(bytes.begin(), bytes.end());
      return;
    }
    if (told_->empty() || told_->front().size() != bytes.size())
      throw std::logic_error("rank 0 told something else");
    std::copy(told_->front().begin(), told_->front().end(), bytes.begin());
    told_->pop_front();
  }
  void gather_values(std::byte* /*values*/, int /*size*/, std::span<const std::int64_t> /*first*/) override {}

  int rank_;
  Told* told_;
};

/// `order`: of teams, threads and queues.
std::shared_ptr<Device> small_parts(std::uint64_t order) {
  Emulation emulation;
  emulation.order = order;
  emulation.cut.part_quads = 7;
  emulation.cut.run_tiles = 3;
  emulation.spoils_copies = true;
  return emulated_device(emulation);
}

/// Fields after these steps beside those of one process in double; in other precisions, beside its own.
void expect_same_steps(const std::function<Scene(const std::string&)>& scene,
                       const std::vector<std::string>& precisions, std::int64_t steps) {
  for (const std::string& precision : precisions) {
    SCOPED_TRACE(precision);
    const samples::PreloadedScene of(scene(precision));
    const auto start = of.start(nullptr);
    const samples::SharedRun two(of, *start, 2, {0.4, 0.6}, [] { return small_parts(0); });
    two.roll_on(steps);
    const std::vector<int> counts = precision == "double" ? std::vector{3, 4, 7} : std::vector{3};
    for (const int count : counts) {
      const samples::SharedRun more(of, *start, count, {},
                                    [count] { return small_parts(static_cast<std::uint64_t>(count)); });
      more.roll_on(steps);
      EXPECT_EQ(samples::differences(two.front().state(), more.front().state()), "") << count << " ranks";
    }
    samples::roll_on(*start, steps);
    const samples::Apart apart = samples::apart(of.values(), *start, two.front());
    EXPECT_LT(apart.displacement, precision == "double" ? 1e-9 : 1e-5);
    if (precision != "double") continue;
    EXPECT_LT(apart.velocity, 1e-9);
    samples::expect_same_contact(*start, two.front());
    samples::expect_same_energies(start->sample(), two.front().sample());
  }
}

/// The name of rank 0's device is the last word but one; "NVIDIA X" has the length of "emulated".
TEST(RankDevices, AnotherDeviceThanThatOfRank0IsRefused) {
  Told told;
  ToldRank rank_0(0, told);
  choose_devices(rank_0, "emulated");
  dismiss(rank_0);
  Told of_equals = told;
  ToldRank equal(1, of_equals);
  EXPECT_NO_THROW(follow(equal));

  const auto card = std::as_bytes(std::span<const char>("NVIDIA X", 8));
  told[told.size() - 2].assign(card.begin(), card.end());
  ToldRank other(1, told);
  EXPECT_EQ(
      samples::refusal<ResourceError>([&] { follow(other); }),
      "rank 1 has emulated, rank 0 has NVIDIA X; state --device gpu:N, or let CUDA_VISIBLE_DEVICES show "
      "equal cards");
  choose_device("cpu");
}

TEST(RankDevices, TractionOverCorrugation) {
  std::vector<std::string> overrides = corrugated(kTraction);
  overrides.emplace_back("corrugation.apply=nodes");
  expect_same_steps(tyre(overrides), {"double", "mixed", "single"}, 270);
}

TEST(RankDevices, MaxwellBranches) {
  expect_same_steps(
      [](const std::string& precision) {
        return samples::tyre_with_maxwell_branches(
            {"scene.element_size=10 mm", "motion.duration=0.5 ms", "scene.precision=" + precision});
      },
      {"double", "mixed"}, 270);
}

TEST(RankDevices, PlasticMaterialWithDamping) {
  expect_same_steps(tyre({"material.steel.law=j2", "material.steel.yield_stress=20 MPa",
                          "material.steel.isotropic_hardening=20 GPa",
                          "material.steel.damping={ kind = \"rayleigh_beta\", value = \"1e-8 s\" }"}),
                    {"double", "mixed"}, 270);
}

TEST(RankDevices, GuidedBoreAndFallingFriction) {
  expect_same_steps(
      tyre({"wheel.bore=guided", "motion.traction.torque=5 kN m", "motion.traction.ramp=0.05 ms",
            "contact.friction_law=falling", "contact.friction_memory=0.2 mm"}),
      {"double"}, 270);
}

TEST(RankDevices, HammerOnARailOnFastenings) {
  expect_same_steps(file("hammer", {}), {"double"}, 100);
}

TEST(RankDevices, WheelsetWithAVehicleOnASlab) {
  expect_same_steps(file("smooth", samples::kHalfWheelset), {"double", "mixed"}, 100);
}

}  // namespace
}  // namespace tread
