#pragma once
// Estimated cost of a run, before it starts.

#include <cstdint>

#include "drivers/engine/model/model.hpp"
#include "drivers/engine/start/step_limit.hpp"
#include "drivers/results/disk_use.hpp"

namespace tread {

struct Estimate {
  std::int64_t elements = 0;
  StepLimit limit;
  double dt = 0;  ///< [s]
  std::int64_t steps = 0;
  std::int64_t memory = 0;  ///< [B]
  DiskUse disk;
  double preload_seconds = 0;
  double rolling_seconds = 0;

  double seconds() const { return preload_seconds + rolling_seconds; }
};

/// Estimate with the threads in use, from a few measured applications of the model's stiffness. Applies the
/// scene's corrugation. `files`: file_bytes() of the scene.
Estimate estimate(Model& model, std::int64_t files = 0);

}  // namespace tread
