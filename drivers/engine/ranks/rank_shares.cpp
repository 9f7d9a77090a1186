#include "drivers/engine/ranks/rank_shares.hpp"

#include <algorithm>
#include <numeric>

#include "core/contract.hpp"
#include "core/index.hpp"

namespace tread {

namespace {

/// Cost of search and tractions for each point that the search has room for. [ranks.md, What is shared]
constexpr double kPointOfRoom = 16;
/// Part of an even share: METIS leaves no rank without any work.
constexpr double kFewElements = 0.02;

}  // namespace

std::int64_t contact_cost(const Model& model) {
  if (!model.contact) return 0;
  return static_cast<std::int64_t>(kPointOfRoom * static_cast<double>(model.contact->searching().capacity()));
}

std::vector<double> expected_shares(const Model& model, const std::vector<TileWork>& work, int ranks) {
  const double elements =
      std::accumulate(work.begin(), work.end(), 0.0,
                      [](double sum, const TileWork& tile) { return sum + static_cast<double>(tile.cost); });
  const auto contact = static_cast<double>(contact_cost(model));
  const double even = 1.0 / ranks;
  const double own = std::max((even * (elements + contact) - contact) / elements, kFewElements * even);
  std::vector<double> shares(index(ranks), (1 - own) / std::max(ranks - 1, 1));
  shares[kContactRank] = ranks > 1 ? own : 1;
  return shares;
}

std::vector<double> dealt_shares(const RankCut& cut, const std::vector<TileWork>& work) {
  std::vector<double> shares(index(cut.ranks()), 0.0);
  std::int64_t pieces = 0, all = 0;
  for (std::size_t tile = 0; tile < work.size(); ++tile) {
    if (!work[tile].with_next) ++pieces;
    all += work[tile].cost;
    shares[index(cut.rank_of(tile))] += static_cast<double>(work[tile].cost);
  }
  if (pieces <= cut.ranks()) return {};
  for (double& share : shares) share /= static_cast<double>(all);
  return shares;
}

TimedShares evened_shares(std::span<const double> shares, std::span<const double> seconds) {
  TREAD_EXPECT(shares.size() == seconds.size() && shares.size() > 1);
  static_assert(kContactRank == 0);
  const double least = kFewElements / static_cast<double>(shares.size());
  std::vector<double> speed(shares.size(), 0.0);  // share of the work that a rank does in a second
  for (std::size_t rank = 0; rank < shares.size(); ++rank)
    if (shares[rank] > 0) speed[rank] = shares[rank] / seconds[rank];
  double work_of_others = 0, seconds_of_others = 0, rest = 1;
  for (std::size_t rank = 1; rank < shares.size(); ++rank)
    if (shares[rank] > 0) {
      work_of_others += shares[rank];
      seconds_of_others += seconds[rank];
    } else {
      rest -= least;
    }
  if (work_of_others == 0) return {{shares.begin(), shares.end()}, std::ranges::max(seconds)};
  const double speed_of_others = work_of_others / seconds_of_others;
  const double contact = std::max(seconds[0] - shares[0] / speed_of_others, 0.0);
  if (contact > 0 || shares[0] == 0) speed[0] = speed_of_others;

  const auto sum = [](std::span<const double> values) { return std::reduce(values.begin(), values.end()); };
  double time = (rest + speed[0] * contact) / sum(speed);
  const double own = std::max((time - contact) * speed[0], least);
  if (own == least) time = (rest - least) / sum(std::span(speed).subspan(1));
  TimedShares evened{{own}, std::max(time, contact + own / speed[0])};
  for (std::size_t rank = 1; rank < shares.size(); ++rank)
    evened.shares.push_back(speed[rank] > 0 ? time * speed[rank] : least);
  return evened;
}

}  // namespace tread
