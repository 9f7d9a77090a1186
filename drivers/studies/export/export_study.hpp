#pragma once
// `tread export`: a scene's model as a file for another solver.

#include <filesystem>
#include <string>

#include "drivers/process/machine.hpp"
#include "drivers/studies/export/deck_options.hpp"
#include "io/scene/scene_reader.hpp"

namespace tread {

struct ExportOptions {
  std::string format = "k";
  std::string reader = "openradioss";  ///< or "ls-dyna"
  std::string ramp;                    ///< of gravity and static loads, "0.5 ms"; empty: none
  std::string overlap;                 ///< by which the wheel sits deeper, "20 um"; empty: none
  bool preload = false;                ///< start in the static state of the scene
  std::filesystem::path output;        ///< file
  ThreadOptions threads;
  bool quiet = false;   ///< no progress of the preload
  bool json = false;    ///< an object instead of text on stdout
  std::string program;  ///< name and version, for the file's head
};

/// Writes the file and prints its size, units and differences from the model. Errors leave as Error.
void export_scene(const ResolvedScene& resolved, const ExportOptions& options);

}  // namespace tread
