#pragma once
// The common course of sweep, paper and dial: check, project, run, compare.

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "drivers/report/provenance.hpp"
#include "drivers/studies/study/study_plan.hpp"

namespace tread {

struct StudyOptions {
  std::filesystem::path output;        ///< output directory; may be empty with `list`
  std::string quality;                 ///< quality of all points; empty: the scene's
  std::vector<std::string> overrides;  ///< overrides of all points
  int jobs = 0;                        ///< runs at once; 0: the study's, or as cores and memory allow
  int threads = 0;                     ///< threads of one run; 0: the study's, or 1
  std::string device;                  ///< takes the steps of all runs; empty: the processor
  std::string launcher;                ///< words that start a run elsewhere, "srun -N1"; empty: here
  std::filesystem::path slurm;         ///< job script to write in place of runs; may be empty
  bool retry = false;                  ///< true to run failed points, too
  bool no_share = false;               ///< true if every point rolls from the start
  bool list = false;                   ///< true for points and cost alone
  bool json = false;                   ///< true for JSON in place of a table
  bool quiet = false;
  Provenance origin;
};

/// Words of --launcher: a program and its arguments.
std::vector<std::string> launcher_words(const std::string& text);

/// Sentence on a launcher whose program this machine lacks; "" without one.
std::string missing_launcher(const std::vector<std::string>& launcher);

/// Adds the options' overrides and `no_share` to the study. Throws InputError if a point varies an overridden
/// key.
void add_overrides(Study& study, const StudyOptions& options);

/// Checks the whole study, prints its cost, runs the points that are not done and calls `leave` with the plan
/// for the folder's results. The end names the runs' warnings. With options.list it ends before the runs.
/// Throws errors of the study before anything runs. Returns the error of points that did not come to their
/// end: resumable if the study or a run was stopped, with the first failed point's code if one failed.
std::optional<Error> run_study(const Study& study, const StudyOptions& options,
                               const std::function<void(const StudyPlan&)>& leave);

}  // namespace tread
