// Times of ranks, and shares of the work that they ask for.

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <numeric>
#include <thread>
#include <vector>

#include "drivers/engine/ranks/rank_shares.hpp"
#include "drivers/run/rank_clock.hpp"
#include "tests/tyre_scene.hpp"

namespace tread {
namespace {

/// Ranks of these speeds; rank 0 has a contact that takes so long.
struct Machine {
  std::vector<double> speed;
  double contact;

  std::vector<double> seconds(const std::vector<double>& shares) const {
    std::vector<double> taken;
    for (std::size_t rank = 0; rank < shares.size(); ++rank)
      taken.push_back(shares[rank] / speed[rank] + (rank == 0 ? contact : 0));
    return taken;
  }
  /// After some comparisons of times.
  std::vector<double> evened(std::vector<double> shares, int times) const {
    for (; times > 0; --times) shares = evened_shares(shares, seconds(shares)).shares;
    return shares;
  }
};

double spread(const std::vector<double>& values) {
  const auto [least, most] = std::ranges::minmax(values);
  return most / least - 1;
}

double sum(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

TEST(RankShares, LikeRanksTakeAsLongAfterOneComparison) {
  const Machine machine{{2, 2, 2}, 0.03};
  const std::vector<double> shares = {0.2, 0.5, 0.3};
  const TimedShares evened = evened_shares(shares, machine.seconds(shares));
  const std::vector<double> seconds = machine.seconds(evened.shares);
  EXPECT_LT(spread(seconds), 1e-12);
  EXPECT_NEAR(evened.seconds, seconds[0], 1e-12);
  EXPECT_NEAR(sum(evened.shares), 1, 1e-12);
}

TEST(RankShares, UnlikeRanksTakeAsLongAfterSome) {
  for (const double first : {0.7, 1.0, 1.3})
    for (const double contact : {0.0, 0.02, 0.1}) {
      const std::vector<double> shares =
          Machine{{first, 1, 0.8, 1.1}, contact}.evened({0.25, 0.25, 0.3, 0.2}, 6);
      EXPECT_LT(spread(Machine{{first, 1, 0.8, 1.1}, contact}.seconds(shares)), 0.01)
          << first << ", " << contact;
      EXPECT_NEAR(sum(shares), 1, 1e-12);
    }
}

/// A rank 0 that is faster than the others keeps its own speed.
TEST(RankShares, FasterFirstRankIsNotOverrated) {
  const std::vector<double> shares = Machine{{3, 1}, 0}.evened({0.5, 0.5}, 1);
  EXPECT_NEAR(shares[0], 0.75, 1e-12);
}

TEST(RankShares, ContactLongerThanAShareLeavesAlmostNoElements) {
  const Machine machine{{1, 1, 1, 1}, 0.9};
  const std::vector<double> shares = {0.25, 0.25, 0.25, 0.25};
  const TimedShares evened = evened_shares(shares, machine.seconds(shares));
  EXPECT_NEAR(evened.shares[0], 0.005, 1e-12);
  EXPECT_NEAR(evened.shares[1], 0.995 / 3, 1e-12);
  EXPECT_NEAR(evened.seconds, 0.905, 1e-12);
}

/// The time of such a rank, its connectors', is no measure of its speed.
TEST(RankShares, ARankWithoutWorkGetsHardlyAny) {
  std::vector<double> shares(8, 1.0 / 7), seconds(8, 300e-6);
  shares.back() = 0;
  seconds.back() = 5e-6;
  const TimedShares evened = evened_shares(shares, seconds);
  EXPECT_NEAR(evened.shares.back(), 0.02 / 8, 1e-12);
  for (std::size_t rank = 0; rank < 7; ++rank) EXPECT_NEAR(evened.shares[rank], (1 - 0.02 / 8) / 7, 1e-12);
  EXPECT_NEAR(evened.seconds, (1 - 0.02 / 8) * 300e-6, 1e-12);
}

TEST(RankShares, RankZeroWithoutElementsHasTheContactAlone) {
  const TimedShares evened = evened_shares(std::vector{0.0, 0.5, 0.5}, std::vector{0.2, 0.5, 0.5});
  EXPECT_NEAR(evened.shares[0], (1 - 2 * 0.2) / 3, 1e-12);
  EXPECT_NEAR(evened.seconds, 0.4, 1e-12);
}

/// The second of two ranks, which rank 0 keeps waiting.
class WaitingRank final : public Ranks {
 public:
  int rank() const override { return 1; }
  int count() const override { return 2; }
  void exchange(std::span<const RankSegment> /*sent*/, std::span<const RankSegment> /*received*/) override {}
  void post(std::span<const RankSegment> /*sent*/) override {}
  void receive(std::span<const RankSegment> /*received*/) override {}
  [[noreturn]] void end_all(int code) override { std::exit(code); }

 private:
  void broadcast_bytes(std::span<std::byte> /*bytes*/) override {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  void gather_values(std::byte* /*values*/, int /*size*/, std::span<const std::int64_t> /*first*/) override {}
};

TEST(RankClock, WaitsForWhatRankZeroTellsAreNoWork) {
  WaitingRank ranks;
  RankClock clock;
  std::byte told{};
  for (int step = 0; step < 3; ++step) clock.time(ranks, [&] { ranks.broadcast({&told, 1}); });
  EXPECT_EQ(ranks.traffic.waits, 3);
  EXPECT_GE(ranks.traffic.seconds, 3 * 20e-3);
  EXPECT_LT(clock.take(ranks)[1], 10e-3);
}

/// Few pieces cannot be dealt out as wanted.
TEST(RankShares, DealtSharesAreThoseOfTheCutsPieces) {
  const Model model(samples::tyre_scene({"scene.element_size=20 mm"}));
  const std::vector<TileWork> work = tile_work(model, *model.internal);
  const auto cost_of = [&](const std::vector<TileStretch>& stretches) {
    double cost = 0;
    for (const TileStretch& stretch : stretches)
      for (std::size_t tile = stretch.first; tile < stretch.last; ++tile)
        cost += static_cast<double>(work[tile].cost);
    return cost;
  };
  const std::vector<double> wanted = {0.1, 0.3, 0.6};
  const RankCut cut(model, work, wanted);
  const std::vector<double> dealt = dealt_shares(cut, work);
  ASSERT_EQ(dealt.size(), 3U);
  EXPECT_NEAR(sum(dealt), 1, 1e-12);
  EXPECT_NE(dealt, wanted);
  const TileStretch all{0, work.size()};
  for (int rank = 0; rank < 3; ++rank)
    EXPECT_NEAR(dealt[index(rank)], cost_of(cut.stretches(rank)) / cost_of({all}), 1e-12);
  const std::vector<double> of_many(work.size(), 1.0 / static_cast<double>(work.size()));
  EXPECT_TRUE(dealt_shares(RankCut(model, work, of_many), work).empty());
}

}  // namespace
}  // namespace tread
