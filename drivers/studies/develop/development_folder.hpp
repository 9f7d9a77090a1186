#pragma once
// The folder of a development: passages as runs, their work and profiles as tables.

#include <filesystem>
#include <string>

#include "drivers/process/progress.hpp"
#include "drivers/run/run_folder.hpp"
#include "drivers/studies/develop/development.hpp"
#include "io/scene/scene_reader.hpp"

namespace tread {

/// Passage 0 rolls over the smooth rail and keeps the state that the others begin with. Of the runs' folders
/// only that one and the last stay.
class DevelopmentFolder {
 public:
  struct Options {
    std::string from;  ///< a run whose state all passages begin with, as in fork_from(); empty: passage 0
    int threads = 0;   ///< of a passage; 0: all
  };

  /// Makes the folder and takes it; leaves the scenes that the passages roll through. InputError where it
  /// holds a development of another scene.
  DevelopmentFolder(const std::filesystem::path& path, const ResolvedScene& resolved, Options options);

  /// What passage `number` left on the rail, `profile` being what it rolls over (nothing for passage 0); runs
  /// it where that is not known yet. InputError, NumericalError, ResourceError where it fails; Interrupted.
  PassageWork pass(int number, const WornProfile* profile, Progress& progress) const;

  /// Writes the profile after a passage, as a table for corrugation.file; that of 0 is the scene's own.
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

/// Work per area of a finished run over [first, last], averaged across the rail by the stretch's mean work.
/// InputError where the run has not passed it.
PassageWork work_of_run(const std::filesystem::path& surface, double first, double last);

}  // namespace tread
