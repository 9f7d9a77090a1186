#pragma once
// A study before it runs: every point resolved, checked, its folder looked into, its cost projected.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "drivers/estimate.hpp"
#include "drivers/study/point_folder.hpp"
#include "io/report.hpp"
#include "io/study_reader.hpp"

namespace tread {

struct PlannedPoint {
  std::string name;
  std::vector<StudySetting> varied;
  std::vector<std::string> overrides;  ///< as after --set, later ones first in rank
  ResolvedScene resolved;
  SceneContent content;
  std::string from = {};  ///< state that the run begins with, as in fork_from(); empty: its start
  std::filesystem::path folder;
  PointStatus status;
  std::optional<Estimate> cost;       ///< of a point that is not done
  double saved_seconds = 0;           ///< that others compute for it; not in the cost
  std::optional<std::size_t> shared;  ///< its place in StudyPlan::shared
  bool keeps_state = false;           ///< the others of its StudyPlan::shared begin with its state

  bool to_run(bool retry) const {
    return status.state != PointState::done && (status.state != PointState::failed || retry);
  }
  /// Nothing in the folder is of use to go on from.
  bool begins_anew() const {
    return status.state == PointState::waiting || (status.state == PointState::failed && status.anew);
  }
};

/// Points that are the same run to the bit until the patch meets what tells their corrugations apart.
/// [reliability.md, Fork]
struct SharedRolling {
  std::vector<std::size_t> points;  ///< of StudyPlan::points, in their order
  double from_x = 0;                ///< corrugations differ from there on [m]
  double deepest = 0;               ///< corrugation [m]
  std::optional<double> room;       ///< contact.depth_room where the usual one is not enough [m]
  double until = 0;                 ///< a state is kept then; 0: not known [s]
};

struct StudyPlan {
  Study study;
  std::filesystem::path folder;
  std::vector<PlannedPoint> points;
  std::vector<SharedRolling> shared;
  int jobs = 1;     ///< runs at once
  int threads = 0;  ///< of one run; 0: its share of the cores that are idle when it begins

  /// What the first failed point's process exited with; resources where a signal ended it.
  ExitCode failure_code() const;
};

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
