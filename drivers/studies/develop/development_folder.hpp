#pragma once
// The folder of a development: passages as runs, their work and profiles as tables.

#include <filesystem>
#include <string>

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
    std::string from;  ///< run with whose state all passages begin, as in fork_from(); empty: passage 0
    int threads = 0;   ///< threads of a passage; 0: all
    int passages = 0;  ///< passages of the whole development, for progress lines
  };

  /// Makes and locks the folder and writes the scenes of the passages. Throws InputError if the folder holds
  /// a development of another scene.
  DevelopmentFolder(const std::filesystem::path& path, const ResolvedScene& resolved, Options options);

  /// Work of passage `number` over `profile` (null for passage 0). Runs the passage unless its work is known.
  /// Throws InputError, NumericalError or ResourceError if the passage fails, and Interrupted.
  PassageWork pass(int number, const WornProfile* profile, Progress& progress) const;

  /// Writes the profile after a passage, as a table for corrugation.file. The profile after passage 0 is the
  /// scene's own.
  void keep_profile(int number, const WornProfile& profile) const;

  const RunFolder& folder() const { return folder_; }

 private:
  std::filesystem::path profile_path(int number) const;
  std::filesystem::path work_path(int number) const;
  std::filesystem::path run_path(int number) const;
  std::vector<std::string> overrides(int number) const;
  void roll(int number, Progress& progress) const;

  RunFolder folder_;
  Scene scene_;
  Options options_;
};

/// Work per area of a finished run over [first, last] [m], averaged across the rail by the stretch's mean
/// work. Throws InputError if the run has not passed the stretch.
PassageWork work_of_run(const std::filesystem::path& surface, double first, double last);

}  // namespace tread
