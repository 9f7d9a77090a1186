#pragma once
// `tread run` and `tread resume`: a scene from mesh to report.

#include <filesystem>
#include <string>
#include <vector>

#include "drivers/machine.hpp"
#include "io/checkpoint_folder.hpp"
#include "io/scene_reader.hpp"

namespace tread {

struct RunOptions {
  std::filesystem::path output;  ///< directory; created if missing
  ThreadOptions threads;
  bool json = false;   ///< summary on stdout
  bool quiet = false;  ///< no progress on stderr
  /// The run begins with the state of another one: "DIR" or "DIR@TIME", as in fork_from().
  std::string from;
  std::string cache = "off";  ///< place of the preload cache, as in preload_cache()
  bool overwrite = false;     ///< an unfinished run in the directory may be thrown away
  std::string command;        ///< as typed, for the report
  /// Of `tread resume`: other values of motion.duration, output and stop.
  std::vector<std::string> overrides;
  CheckpointObserver observer;  ///< told of each stage of each checkpoint, by the thread that writes it
};

/// Runs the scene and leaves scene.resolved.toml, run.h5, histories.csv, summary.json and report.html in the
/// output directory. While it lasts, and where it ends before its time, status.json and checkpoint/ are
/// there. Errors leave as Error; Interrupted where it can be resumed.
void run_scene(const ResolvedScene& resolved, const RunOptions& options);

/// Goes on with the run in options.output from its last sound checkpoint; the files become those of a run
/// that was never stopped. Says so where the run is finished. InputError where there is none.
void resume_run(const RunOptions& options);

}  // namespace tread
