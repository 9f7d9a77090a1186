#pragma once
// `tread run`: a scene from mesh to report.

#include <filesystem>
#include <string>

#include "io/scene_reader.hpp"

namespace tread {

struct RunOptions {
  std::filesystem::path output;  ///< directory; created if missing
  int threads = 0;               ///< 0: as many as the machine has
  bool json = false;             ///< summary on stdout
  bool quiet = false;            ///< no progress on stderr
  std::string command;           ///< as typed, for the report
};

/// Runs the scene and leaves scene.resolved.toml, run.h5, histories.csv, summary.json and report.html in the
/// output directory. Errors leave as Error.
void run_scene(const ResolvedScene& resolved, const RunOptions& options);

}  // namespace tread
