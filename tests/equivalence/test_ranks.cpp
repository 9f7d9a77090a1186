// Steps that several ranks share have the bits of one process. Ranks are threads here; copies of what another
// rank moves are NaN, so whoever reads them without fetching them is found out.

#include <gtest/gtest.h>

#include <algorithm>
#include <barrier>
#include <condition_variable>
#include <cstring>
#include <deque>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <variant>
#include <vector>

#include "core/parallel/parallel.hpp"
#include "core/parallel/ranks.hpp"
#include "drivers/engine/preload.hpp"
#include "drivers/engine/simulation.hpp"
#include "drivers/engine/static_system.hpp"
#include "drivers/results/run_results.hpp"
#include "tests/state_copies.hpp"
#include "tests/tyre_scene.hpp"

namespace tread {
namespace {

/// Bytes on their way from one thread to another.
class Mail {
 public:
  void put(int from, int to, std::span<const std::byte> bytes) {
    const std::lock_guard held(lock_);
    letters_[{from, to}].emplace_back(bytes.begin(), bytes.end());
    arrived_.notify_all();
  }
  std::vector<std::byte> take(int from, int to) {
    std::unique_lock held(lock_);
    auto& letters = letters_[{from, to}];
    arrived_.wait(held, [&] { return !letters.empty(); });
    std::vector<std::byte> letter = std::move(letters.front());
    letters.pop_front();
    return letter;
  }

 private:
  std::mutex lock_;
  std::condition_variable arrived_;
  std::map<std::pair<int, int>, std::deque<std::vector<std::byte>>> letters_;
};

/// Where threads of a process find one another.
struct Meeting {
  explicit Meeting(int count)
      : barrier(count), values(static_cast<std::size_t>(count)), sent(static_cast<std::size_t>(count)) {}
  Mail mail;
  std::barrier<> barrier;
  std::vector<std::byte*> values;
  std::vector<std::span<const RankSegment>> sent;
};

class ThreadRanks final : public Ranks {
 public:
  ThreadRanks(std::shared_ptr<Meeting> meeting, int rank) : meeting_(std::move(meeting)), rank_(rank) {}

  int rank() const override { return rank_; }
  int count() const override { return static_cast<int>(meeting_->values.size()); }
  bool spoils_copies() const override { return true; }
  void end_all(int code) override { std::exit(code); }

  void exchange(std::span<const RankSegment> sent, std::span<const RankSegment> received) override {
    meeting_->sent[static_cast<std::size_t>(rank_)] = sent;
    meeting_->barrier.arrive_and_wait();
    std::vector<std::size_t> next(meeting_->sent.size(), 0);
    for (const RankSegment& segment : received) {
      const std::span<const RankSegment> from = meeting_->sent[static_cast<std::size_t>(segment.rank)];
      std::size_t& at = next[static_cast<std::size_t>(segment.rank)];
      while (at < from.size() && from[at].rank != rank_) ++at;
      ASSERT_LT(at, from.size()) << "rank " << rank_ << " waits for more than rank " << segment.rank
                                 << " sends";
      ASSERT_EQ(from[at].bytes.size(), segment.bytes.size());
      std::memcpy(segment.bytes.data(), from[at++].bytes.data(), segment.bytes.size());
    }
    meeting_->barrier.arrive_and_wait();
  }

  void post(std::span<const RankSegment> sent) override {
    for (const RankSegment& segment : sent) meeting_->mail.put(rank_, segment.rank, segment.bytes);
  }
  void receive(std::span<const RankSegment> received) override {
    for (const RankSegment& segment : received) {
      const std::vector<std::byte> letter = meeting_->mail.take(segment.rank, rank_);
      ASSERT_EQ(letter.size(), segment.bytes.size());
      std::memcpy(segment.bytes.data(), letter.data(), letter.size());
    }
  }

  void broadcast(std::span<std::byte> bytes) override {
    meeting_->values[static_cast<std::size_t>(rank_)] = bytes.data();
    meeting_->barrier.arrive_and_wait();
    if (rank_ != 0) std::memcpy(bytes.data(), meeting_->values[0], bytes.size());
    meeting_->barrier.arrive_and_wait();
  }

 private:
  void gather_values(std::byte* values, int size, std::span<const std::int64_t> first) override {
    meeting_->values[static_cast<std::size_t>(rank_)] = values;
    meeting_->barrier.arrive_and_wait();
    for (std::size_t other = 0; other + 1 < first.size(); ++other) {
      if (other == static_cast<std::size_t>(rank_)) continue;
      const std::int64_t from = first[other] * size;
      if (first[other + 1] == first[other]) continue;
      std::memcpy(values + from, meeting_->values[other] + from,
                  static_cast<std::size_t>(first[other + 1] * size - from));
    }
    meeting_->barrier.arrive_and_wait();
  }

  std::shared_ptr<Meeting> meeting_;
  int rank_;
};

constexpr std::int64_t kSampling = 70;

/// A scene from its preload on.
class Case {
 public:
  explicit Case(const Scene& scene) : scene_(scene), model_(scene) {
    preload_ = solve_preload(model_, steady_motion(model_), [](const std::string& /*text*/) {});
    if (scene.corrugation) {
      deepest_ = preload_.contact.pressure_peak.y;
      model_.apply_corrugation(*deepest_);
    }
    dt_ = scene.motion->step_safety * step_limit(model_).stable_step;
    one_.emplace(model_, preload_, dt_);
    one_->set_sampling_interval(kSampling);
  }

  /// Steps on `count` ranks are those of one process; all fields are compared at these steps. `shares`: of
  /// the work, by rank; none: the expected ones.
  void expect_same_steps(int count, const std::vector<std::int64_t>& looks,
                         const std::vector<double>& shares = {}) {
    const auto meeting = std::make_shared<Meeting>(count);
    std::vector<std::unique_ptr<Model>> models;
    Simulations shared;
    for (int rank = 0; rank < count; ++rank) {
      models.push_back(std::make_unique<Model>(scene_, deepest_));
      const auto ranks = std::make_shared<ThreadRanks>(meeting, rank);
      ranks->shares = shares;
      choose_ranks(ranks);
      shared.push_back(std::make_unique<Simulation>(*models.back(), preload_.contact.centre.y, dt_));
      choose_ranks(nullptr);
      shared.back()->set_sampling_interval(kSampling);
      samples::copy(one_->state(), shared.back()->state());
      models.back()->keep_masses(shared.back()->groups_with_mass());
      if (rank > 0) spoil(shared.back()->unshared_state());
    }
    on_threads(shared, [](Simulation& simulation) {
      simulation.spread();
      simulation.fields();  // as at the checkpoint before the first step
    });
    for (const std::int64_t look : looks) {
      const std::int64_t steps = one_->steps() + look;
      on_threads(shared, [steps](Simulation& simulation) {
        while (simulation.steps() < steps) simulation.step();
        simulation.fields();
      });
      while (one_->steps() < steps) one_->step();
      EXPECT_EQ(samples::differences(one_->state(), shared.front()->state()), "")
          << count << " ranks, " << steps;
      for (const auto& simulation : shared)
        EXPECT_EQ(history_row(model_, one_->sample()), history_row(model_, simulation->sample()));
    }
  }

 private:
  using Simulations = std::vector<std::unique_ptr<Simulation>>;

  template <class Call>
  static void on_threads(const Simulations& ranks, const Call& call) {
    std::vector<std::thread> threads;
    for (const auto& simulation : ranks) threads.emplace_back([&call, &simulation] { call(*simulation); });
    for (std::thread& thread : threads) thread.join();
  }
  static void spoil(const StateList& list) {
    for (const StateList::Field& field : list.fields())
      std::visit(
          [](auto values) {
            std::fill(values.begin(), values.end(), std::numeric_limits<double>::quiet_NaN());
          },
          field.values);
  }

  Scene scene_;
  Model model_;
  Preload preload_;
  std::optional<double> deepest_;
  double dt_ = 0;
  std::optional<Simulation> one_;
};

/// The runs of all numbers of ranks follow one another. The wheel is anchored after 256 steps.
void expect_same_bits(const Scene& scene, const std::vector<std::int64_t>& looks = {1, 63, 36, 170}) {
  Case of(scene);
  for (const int count : {2, 3, 4, 7}) of.expect_same_steps(count, looks);
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
    expect_same_bits(
        tyre(precision,
             {"motion.traction.torque=13.8 kN m", "motion.traction.ramp=0.05 ms", "corrugation.kind=sine",
              "corrugation.wavelength=20 mm", "corrugation.depth=0.04 mm", "corrugation.width=30 mm",
              "corrugation.start=5 mm", "corrugation.length=40 mm", "corrugation.apply=nodes"}));
}

TEST(Ranks, MaxwellBranches) {
  for (const char* precision : kPrecisions)
    expect_same_bits(samples::tyre_with_maxwell_branches(
        {"scene.element_size=10 mm", "motion.duration=0.5 ms", std::string("scene.precision=") + precision}));
}

TEST(Ranks, PlasticMaterialWithDamping) {
  for (const char* precision : kPrecisions)
    expect_same_bits(
        tyre(precision, {"material.steel.law=j2", "material.steel.yield_stress=300 MPa",
                         "material.steel.isotropic_hardening=20 GPa",
                         "material.steel.damping={ kind = \"rayleigh_beta\", value = \"1e-8 s\" }"}));
}

TEST(Ranks, GuidedBoreAndFallingFriction) {
  expect_same_bits(
      tyre("double", {"wheel.bore=guided", "motion.traction.torque=5 kN m", "motion.traction.ramp=0.05 ms",
                      "contact.friction_law=falling", "contact.friction_memory=0.2 mm"}));
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

/// A tile more or less for a rank does not show, and ranks without a tile are idle.
TEST(Ranks, MoreRanksThanTiles) {
  Case of(tyre("double", {"scene.element_size=20 mm"}));
  of.expect_same_steps(40, {1, 20});
}

}  // namespace
}  // namespace tread
