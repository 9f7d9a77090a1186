#pragma once
// `tread check`: what a scene would compute and cost, before anything runs.

#include "drivers/process/machine.hpp"
#include "drivers/studies/dial/dial_advice.hpp"
#include "io/scene/scene_reader.hpp"

namespace tread {

struct CheckOptions {
  ThreadOptions threads;
  bool json = false;  ///< the figures as JSON on stdout instead of tables
  AdviceOptions advice;
};

/// Builds the model and prints counts, stable step with its reason, steps, memory, disk, time, and the phases
/// and fields that the scene pays for; where an error is wanted, the cheapest setting that is known to be as
/// near. Errors leave as Error.
void check_scene(const ResolvedScene& resolved, const CheckOptions& options);

}  // namespace tread
