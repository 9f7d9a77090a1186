#pragma once
// A model cut for ranks that are not there: what each would hold, send and compute in a step.
// [docs/records/ranks.md]

#include <cstdint>
#include <vector>

#include "drivers/engine/model/model.hpp"
#include "drivers/engine/ranks/rank_cut.hpp"
#include "drivers/engine/ranks/shared_groups.hpp"

namespace tread {

/// A rank's part of the work.
struct RankPart {
  std::int64_t elements = 0;
  std::int64_t cost = 0;                ///< of its tiles, against others
  std::int64_t contact = 0;             ///< cost of the contact, in the same units
  std::int64_t own = 0, halo = 0;       ///< groups of kLanes slots of its tiles, and others that it holds
  int neighbours = 0;                   ///< ranks that it sends forces to, or gets them from
  std::int64_t sent = 0, received = 0;  ///< forces in a step
  std::int64_t sent_motion = 0, received_motion = 0;  ///< displacements in a step, and as many velocities
};

/// By rank. `groups`: follows the patch.
std::vector<RankPart> rank_parts(const Model& model, const RankCut& cut, const std::vector<TileWork>& work,
                                 const SharedGroups& groups);

}  // namespace tread
