#pragma once
// `tread check`: what a scene would compute and cost, before anything runs.

#include "io/scene_reader.hpp"

namespace tread {

struct CheckOptions {
  int threads = 0;    ///< 0: as many as the machine has
  bool json = false;  ///< the figures as JSON on stdout instead of tables
};

/// Builds the model and prints counts, stable step with its reason, steps, memory, disk, time, and the phases
/// and fields that the scene pays for. Errors leave as Error.
void check_scene(const ResolvedScene& resolved, const CheckOptions& options);

}  // namespace tread
