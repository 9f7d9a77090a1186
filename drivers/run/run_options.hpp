#pragma once
// Options of a run besides its scene.

#include <filesystem>
#include <string>
#include <vector>

#include "drivers/process/machine.hpp"
#include "io/files/checkpoint_folder.hpp"

namespace tread {

struct RunOptions {
  std::filesystem::path output;  ///< output directory; created if missing
  ThreadOptions threads;
  std::string device;  ///< takes the steps; empty: the processor [choose_device]
  bool json = false;   ///< true for a summary on stdout
  bool quiet = false;  ///< true for no progress on stderr
  /// Run with whose state this one begins: "DIR" or "DIR@TIME", as in fork_from().
  std::string from;
  std::string cache = "off";  ///< place of the preload cache, as in preload_cache()
  bool overwrite = false;     ///< true if a run in the directory may be thrown away
  std::string program;        ///< name, version and commit, for the report
  std::string command;        ///< command as typed, for the report
  /// Overrides of `tread resume`: other values of motion.duration, output and stop.
  std::vector<std::string> overrides;
  CheckpointObserver observer;  ///< called at each stage of each checkpoint by the thread that writes it
};

}  // namespace tread
