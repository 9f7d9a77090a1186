#pragma once
// The folder of a development: passages as runs, their work and profiles as tables.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "drivers/process/progress.hpp"
#include "drivers/run/run_folder.hpp"
#include "drivers/studies/develop/development.hpp"
#include "io/scene/scene_reader.hpp"

namespace tread {

/// Folder of a development. Passage 0 rolls over the smooth rail and keeps the state with which the others
/// begin. Of the runs' folders only those of passage 0 and of the last passage stay.
class DevelopmentFolder {
 public:
  struct Options {
    std::string from;    ///< run with whose state all passages begin, as in fork_from(); empty: passage 0
    int threads = 0;     ///< threads of a passage; 0: all
    std::string device;  ///< takes the steps; empty: the processor
    std::vector<std::string> launcher;  ///< StudyPlan::launcher
    int passages = 0;                   ///< passages of the whole development, for progress lines
    std::optional<double> room;         ///< room_of_passage0(), where it is known
    std::string command;                ///< command as typed, for status.json
  };

  /// Makes and locks the folder and writes the scenes of the passages. Throws InputError if the folder holds
  /// a development of another scene.
  DevelopmentFolder(const std::filesystem::path& path, const ResolvedScene& resolved, Options options);

  /// Work of passage `number` over the profile of `before`, the passages before it (null for passage 0). Runs
  /// the passage unless its work is known. Throws InputError, NumericalError or ResourceError if the passage
  /// fails, and Interrupted. A warning of the run is said unless the passage before had it.
  SurfaceWork pass(int number, const Development* before, Progress& progress) const;

  /// Writes the profile after passage `number`, as a table or map for corrugation.file. The profile after
  /// passage 0 is the scene's own.
  void keep_profile(int number, const Development& development) const;

  const RunFolder& folder() const { return folder_; }

 private:
  std::filesystem::path profile_path(int number) const;
  std::filesystem::path work_path(int number) const;
  std::filesystem::path run_path(int number) const;
  std::filesystem::path rows_path(int number) const;
  std::vector<std::string> overrides(int number, const Development* before) const;
  void roll(int number, const Development* before, Progress& progress) const;
  void say_warnings(int number, const Progress& progress) const;

  RunFolder folder_;
  ResolvedScene resolved_;
  Options options_;
};

/// Work per area of a finished run over [first, last] [m]. Throws InputError if the run has not passed the
/// stretch.
SurfaceWork work_of_run(const std::filesystem::path& surface, double first, double last);

}  // namespace tread
