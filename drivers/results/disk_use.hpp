#pragma once
// What a run will take on the disk.

#include <cstdint>

#include "drivers/engine/model.hpp"

namespace tread {

struct DiskUse {
  std::int64_t rows = 0;         ///< of the histories
  std::int64_t results = 0;      ///< other files that stay [B]
  std::int64_t forks = 0;        ///< of the results: a state that is kept for other runs [B]
  std::int64_t frames = 0;       ///< of ParaView, and their mesh, which stay too [B]
  std::int64_t checkpoints = 0;  ///< while it lasts: two, and the one that is being written [B]

  std::int64_t total() const { return results + frames + checkpoints; }
};

/// Of a run with step `dt` [s], 0: of its statics alone.
DiskUse disk_use(const Model& model, double dt);

}  // namespace tread
