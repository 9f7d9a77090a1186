#pragma once
// A study before it runs: every point resolved, checked, its folder examined, its cost projected.

#include <cstdint>
#include <filesystem>
#include <vector>

#include "drivers/studies/study/finished_run.hpp"
#include "drivers/studies/study/planned_point.hpp"
#include "io/report/report.hpp"
#include "io/scene/study_reader.hpp"

namespace tread {

/// Resolves every point; `folder` will hold a folder for each. Throws ProblemsError with all errors, placed
/// in the study's file if a value of it is meant. Points with equal scenes are an error, too.
StudyPlan plan_study(const Study& study, const std::filesystem::path& folder);

/// Throws InputError if the folder holds runs, but none of the study's points.
void require_same_study(const StudyPlan& plan);

/// Looks into the points' folders. Throws InputError if one holds a run of another scene.
void look_into_folders(StudyPlan& plan);

/// Builds the models of the points that are to run, projects their cost with the plan's threads or one, and
/// fills their warnings. Determines until when points share their rolling and which of them keeps the state.
/// Throws ProblemsError if a model cannot be built.
void project_cost(StudyPlan& plan, bool retry);

/// Distinct warnings of the points that are to run, in order of appearance.
std::vector<SharedWarning> planned_warnings(const StudyPlan& plan);

/// Sums over the points with a cost.
struct StudyCost {
  double seconds = 0;       ///< time of all runs one after the other [s]
  double saved = 0;         ///< time saved by sharing rolling and preloads, one after the other [s]
  double wall = 0;          ///< time with plan.jobs at once [s]
  std::int64_t disk = 0;    ///< size of the results and of the checkpoints of the runs at once [B]
  std::int64_t memory = 0;  ///< memory of the largest runs at once [B]
};
StudyCost total_cost(const StudyPlan& plan);

/// StudyCost::disk without the files that lie in the folders of these points already, and that their runs go
/// on with or replace [B].
std::int64_t disk_still_needed(const StudyPlan& plan);

/// Table with the columns point, state, elements, steps, time, disk, and the beginning if rolling is shared.
Table plan_table(const StudyPlan& plan);

}  // namespace tread
