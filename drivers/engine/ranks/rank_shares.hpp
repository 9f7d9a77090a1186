#pragma once
// Shares of the elements' work, so that all ranks take as long. [docs/records/ranks.md]

#include <cstdint>
#include <span>
#include <vector>

#include "drivers/engine/ranks/rank_cut.hpp"

namespace tread {

/// Cost of the contact, in the units of TileWork.
std::int64_t contact_cost(const Model& model);

/// Shares by rank, from the costs of elements, ties and contact.
std::vector<double> expected_shares(const Model& model, const std::vector<TileWork>& work, int ranks);

/// Shares of the work that a cut gives, by rank; none where it has no more pieces than ranks, each of which
/// gets one whatever the shares.
std::vector<double> dealt_shares(const RankCut& cut, const std::vector<TileWork>& work);

struct TimedShares {
  std::vector<double> shares;  ///< by rank
  double seconds;              ///< that the slowest rank takes with them
};

/// Shares with which all ranks would have taken as long. `shares`: dealt_shares(); `seconds`: that each of
/// them worked. Each rank keeps its speed; kContactRank has that of the others in the mean, and what it
/// worked beyond that is the contact's time. Others without work have no speed, and get hardly any.
TimedShares evened_shares(std::span<const double> shares, std::span<const double> seconds);

}  // namespace tread
