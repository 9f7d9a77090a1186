#pragma once
// What `tread sweep` and `tread paper` do alike: check, project, run, compare.

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "drivers/studies/study/study_plan.hpp"

namespace tread {

struct StudyOptions {
  std::filesystem::path output;        ///< directory; may be empty with `list`
  std::string quality;                 ///< of all points; empty: the scene's
  std::vector<std::string> overrides;  ///< of all points
  int jobs = 0;                        ///< runs at once; 0: the study's, or as many as cores and memory allow
  int threads = 0;                     ///< of one run; 0: the study's, or 1
  bool retry = false;                  ///< failed points, too
  bool no_share = false;               ///< every point rolls from the start
  bool list = false;                   ///< points and cost alone
  bool json = false;                   ///< instead of a table
  bool quiet = false;
  std::string command;  ///< as typed, for the report
};

/// Adds the options' overrides to the study, and that nothing is shared. InputError where a point varies the
/// same key.
void add_overrides(Study& study, const StudyOptions& options);

/// Checks the whole study, prints what it will cost, runs the points that are not done and calls `leave` with
/// what then stands in the folder. With options.list it ends before the runs. Throws what is wrong before
/// anything runs. Returns what is to be said of points that did not come to their end: resumable where it was
/// stopped or a run was, with the first failed point's code where one failed.
std::optional<Error> run_study(const Study& study, const StudyOptions& options,
                               const std::function<void(const StudyPlan&)>& leave);

}  // namespace tread
