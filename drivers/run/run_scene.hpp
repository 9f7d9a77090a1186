#pragma once
// `tread run` and `tread resume`: a scene from mesh to report.

#include "drivers/run/run_options.hpp"
#include "io/scene/scene_reader.hpp"

namespace tread {

/// Runs the scene and leaves scene.resolved.toml, run.h5, histories.csv, summary.json and report.html in the
/// output directory. While it lasts, and where it ends before its time, status.json and checkpoint/ are
/// there. Errors leave as Error; Interrupted where it can be resumed.
void run_scene(const ResolvedScene& resolved, const RunOptions& options);

/// Goes on with the run in options.output from its last sound checkpoint; the files become those of a run
/// that was never stopped. Says so where the run is finished. InputError where there is none.
void resume_run(const RunOptions& options);

}  // namespace tread
