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

/// Measured times by element; 0: not measured yet [s].
struct ElementTimes {
  double stiffness = 0;  ///< an application in double, as the preload applies it
  double step = 0;       ///< force and motion of a step
};

/// Estimate for the processor with the threads in use, from a few measured applications of the model's
/// stiffness. Applies the scene's corrugation. `files`: file_bytes() of the scene. `times`: those of a model
/// with the same elements; this one's where they are not measured yet.
Estimate estimate(Model& model, std::int64_t files, ElementTimes& times);
Estimate estimate(Model& model, std::int64_t files = 0);

}  // namespace tread
