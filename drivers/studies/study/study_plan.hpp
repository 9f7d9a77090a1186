#pragma once
// A study before it runs: every point resolved, checked, its folder looked into, its cost projected.

#include <cstdint>
#include <filesystem>

#include "drivers/studies/study/planned_point.hpp"
#include "io/report/report.hpp"
#include "io/scene/study_reader.hpp"

namespace tread {

/// Cores of the machine [-] and its memory [B].
int machine_cores();
std::int64_t machine_memory();

/// Resolves every point; `folder` will hold a folder for each. Throws ProblemsError with all that is wrong,
/// placed in the study's file where a value of it is meant; points that are the same scene are wrong, too.
StudyPlan plan_study(const Study& study, const std::filesystem::path& folder);

/// Looks into the points' folders. InputError where one holds a run of another scene.
void look_into_folders(StudyPlan& plan);

/// Builds the model of every point that is to run, says until when points share their rolling and which one
/// of them keeps the state, and projects the cost with the plan's threads or one; ProblemsError where a model
/// cannot be built.
void project_cost(StudyPlan& plan, bool retry);

/// Sums over the points with a cost.
struct StudyCost {
  double seconds = 0;       ///< of all runs one after the other
  double saved = 0;         ///< by sharing rolling and preloads, one after the other [s]
  double wall = 0;          ///< with plan.jobs at once [s]
  std::int64_t disk = 0;    ///< that the results take and the checkpoints of the runs at once [B]
  std::int64_t memory = 0;  ///< of the largest runs at once [B]
};
StudyCost total_cost(const StudyPlan& plan);

/// Columns: point, state, elements, steps, time, disk, and how it begins where rolling is shared.
Table plan_table(const StudyPlan& plan);

}  // namespace tread
