#pragma once
// What a user may ask of a run beside its scene.

#include <filesystem>
#include <string>
#include <vector>

#include "drivers/process/machine.hpp"
#include "io/files/checkpoint_folder.hpp"

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

}  // namespace tread
