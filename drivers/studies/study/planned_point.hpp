#pragma once
// The points of a study and their shared rolling.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "drivers/results/estimate.hpp"
#include "drivers/studies/study/point_folder.hpp"
#include "io/scene/study_reader.hpp"

namespace tread {

struct PlannedPoint {
  std::string name;
  std::vector<StudySetting> varied;
  std::vector<std::string> overrides;  ///< overrides as after --set, later ones first in rank
  ResolvedScene resolved;
  SceneContent content;
  std::string from = {};  ///< state with which the run begins, as in fork_from(); empty: its start
  std::filesystem::path folder;
  PointStatus status;
  std::optional<Estimate> cost;       ///< cost of a point that is not done
  double saved_seconds = 0;           ///< time that other points compute for it; not in the cost [s]
  std::vector<std::string> warnings;  ///< resolution_warnings() of a point that is to run
  std::optional<std::size_t> shared;  ///< index in StudyPlan::shared
  bool keeps_state = false;           ///< true if the others of its StudyPlan::shared begin with its state

  bool to_run(bool retry) const {
    return status.state != PointState::done && (status.state != PointState::failed || retry);
  }
  /// Returns true if nothing in the folder is of use to go on from.
  bool begins_anew() const {
    return status.state == PointState::waiting || (status.state == PointState::failed && status.anew);
  }
};

/// Points whose runs agree bit for bit until the patch reaches the first difference of their corrugations.
/// [long-runs.md, Fork]
struct SharedRolling {
  std::vector<std::size_t> points;  ///< indices in StudyPlan::points, in their order
  double from_x = 0;                ///< place from which corrugations differ [m]
  double deepest = 0;               ///< largest depth of the corrugations [m]
  std::optional<double> room;       ///< contact.depth_room, if the usual one is not enough [m]
  double until = 0;                 ///< time at which a state is kept; 0: not known [s]
};

struct StudyPlan {
  Study study;
  std::filesystem::path folder;
  std::vector<PlannedPoint> points;
  std::vector<SharedRolling> shared;
  int jobs = 1;        ///< number of runs at once
  int threads = 0;     ///< threads of one run; 0: its share of the cores that are idle when it begins
  std::string device;  ///< of all runs; empty: the processor
  int cards = 0;       ///< that the runs share, one run at a time each; 0: none, or those of `elsewhere`
  std::vector<std::string> launcher;  ///< program and arguments before the command of a run; may be empty
  std::string elsewhere;  ///< starts the runs on other machines, "srun -N1" or "Slurm"; empty: they run here

  /// Exit code of the first failed point's process; ExitCode::resources if a signal ended it.
  ExitCode failure_code() const;
};

}  // namespace tread
